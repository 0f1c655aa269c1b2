/// \file
/// Patterns that the stereo camera sees on surfaces: multi-octave noise without repetition, so that no part of a
/// building looks like another (vision.md 4.5). The noise is made in tiles at the resolution at which it is seen, and
/// cached.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace seeker::sim {

/// Pattern of one surface: its noise and the size of its blotches.
struct PatternScale {
  std::uint64_t seed = 0;
  double texels_per_m = 0.0;  ///< texels per metre of level 0
  int octaves = 0;            ///< octaves of level 0; each further level has one octave less and texels twice as large

  /// A scale whose level 0 is fine enough for pictures taken from kNearest_m or farther.
  [[nodiscard]] static PatternScale make(std::uint64_t seed, double feature_m);
  /// The coarsest level with texels of at most `footprint_m`, or level 0.
  [[nodiscard]] int level_of(double footprint_m) const;
};

/// Cache of tiles. It must not be used by two threads at once.
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
  Key last_;  ///< key of the last tile, because neighbouring pixels use the same one
  std::size_t last_tile_ = 0;
  std::vector<float> sum_;
  std::vector<float> knots_;
};

}  // namespace seeker::sim
