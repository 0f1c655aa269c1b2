/// \file
/// What the stereo camera sees painted on surfaces: multi-octave noise without end, so that no patch of a building
/// looks like another (vision.md 4.5). Made in tiles, at the resolution at which they are looked at, and kept.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace seeker::sim {

/// One surface's pattern: which noise, and how large its blotches are.
struct PatternScale {
  std::uint64_t seed = 0;
  double texels_per_m = 0.0;  ///< of level 0
  int octaves = 0;            ///< level 0 has as many; each further level has one less and texels twice as large

  /// Level 0 is fine enough for pictures from kNearest_m on.
  [[nodiscard]] static PatternScale make(std::uint64_t seed, double feature_m);
  /// Level with texels of at most `footprint_m`, as far as there is one.
  [[nodiscard]] int level_of(double footprint_m) const;
};

/// Cache of tiles. Not for two threads at once.
class Pattern {
 public:
  Pattern();

  /// Value in [-1, 1] at a place of the surface, interpolated between the texels of a level from level_of().
  [[nodiscard]] float at(const PatternScale& scale, double x_m, double y_m, int level);

 private:
  static constexpr int kTile_texels = 64;
  static constexpr int kStride = kTile_texels + 1;  ///< a tile holds its neighbours' first texels too
  using Tile = std::array<std::int8_t, std::size_t{kStride} * kStride>;
  struct Key {
    std::uint64_t seed = 0;
    std::int32_t i = 0;
    std::int32_t j = 0;
    std::int32_t level = -1;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  [[nodiscard]] const Tile& tile(const Key& key, const PatternScale& scale);
  void make_tile(const Key& key, const PatternScale& scale, Tile& out);
  void add_octave(const Key& key, int octave, int step_log2, float amplitude);

  std::unordered_map<Key, std::size_t, KeyHash> index_;
  std::vector<Tile> tiles_;
  Key last_;  ///< neighbouring pixels ask for the same tile
  std::size_t last_tile_ = 0;
  std::vector<float> sum_;
  std::vector<float> knots_;
};

}  // namespace seeker::sim
