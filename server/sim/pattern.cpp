#include "server/sim/pattern.hpp"

#include <algorithm>
#include <cmath>

#include "server/sim/mix.hpp"

namespace seeker::sim {
namespace {

constexpr double kFinest_m = 0.0006;  ///< a pixel of the stereo camera at half a metre
constexpr float kFirstAmplitude = 0.6F;
constexpr float kPersistence = 0.65F;     ///< amplitude of an octave over that of the next coarser one
constexpr std::size_t kMaxTiles = 16384;  ///< 70 MB
constexpr float kCode = 127.0F;           ///< a tile stores values in 1/127

float uniform(std::uint64_t bits) {
  constexpr float kScale = 2.0F / 16777216.0F;  // 24 bits
  return static_cast<float>(bits >> 40U) * kScale - 1.0F;
}

float smooth(float f) { return f * f * (3.0F - 2.0F * f); }

}  // namespace

PatternScale PatternScale::make(std::uint64_t seed, double feature_m) {
  PatternScale scale;
  scale.seed = seed;
  scale.octaves = std::max(1, static_cast<int>(std::ceil(std::log2(feature_m / kFinest_m))));
  scale.texels_per_m = std::ldexp(1.0, scale.octaves) / feature_m;
  return scale;
}

int PatternScale::level_of(double footprint_m) const {
  const double texels = footprint_m * texels_per_m;
  return texels < 2.0 ? 0 : std::min(std::ilogb(texels), octaves - 1);
}

std::size_t Pattern::KeyHash::operator()(const Key& key) const {
  const auto place =
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(key.i)) << 32U) | static_cast<std::uint32_t>(key.j);
  return static_cast<std::size_t>(mix(mix(place) ^ key.seed ^ static_cast<std::uint64_t>(key.level)));
}

Pattern::Pattern() : sum_(std::size_t{kStride} * kStride) {}

float Pattern::at(const PatternScale& scale, double x_m, double y_m, int level) {
  const double per_m = std::ldexp(scale.texels_per_m, -level);
  const double x = x_m * per_m;
  const double y = y_m * per_m;
  const double left = std::floor(x);
  const double low = std::floor(y);
  const auto i = static_cast<std::int64_t>(left);
  const auto j = static_cast<std::int64_t>(low);
  static_assert(kTile_texels == 64);
  constexpr int kTileShift = 6;
  const Key key{scale.seed, static_cast<std::int32_t>(i >> kTileShift), static_cast<std::int32_t>(j >> kTileShift),
                level};
  const Tile& t = tile(key, scale);
  const auto fx = static_cast<float>(x - left);
  const auto fy = static_cast<float>(y - low);
  const std::int8_t* v = t.data() + (j & (kTile_texels - 1)) * kStride + (i & (kTile_texels - 1));
  const float below = static_cast<float>(v[0]) * (1.0F - fx) + static_cast<float>(v[1]) * fx;
  const float above = static_cast<float>(v[kStride]) * (1.0F - fx) + static_cast<float>(v[kStride + 1]) * fx;
  return (below * (1.0F - fy) + above * fy) * (1.0F / kCode);
}

const Pattern::Tile& Pattern::tile(const Key& key, const PatternScale& scale) {
  if (key == last_) {
    return tiles_[last_tile_];
  }
  auto found = index_.find(key);
  if (found == index_.end()) {
    if (tiles_.size() >= kMaxTiles) {
      tiles_.clear();
      index_.clear();
    }
    tiles_.emplace_back();
    make_tile(key, scale, tiles_.back());
    found = index_.emplace(key, tiles_.size() - 1).first;
  }
  last_ = key;
  last_tile_ = found->second;
  return tiles_[last_tile_];
}

void Pattern::make_tile(const Key& key, const PatternScale& scale, Tile& out) {
  std::fill(sum_.begin(), sum_.end(), 0.0F);
  float amplitude = kFirstAmplitude;
  // Octave 0 is the coarsest; the finest of this level has knots two texels apart, as fine as its texels can show.
  for (int step_log2 = scale.octaves - key.level; step_log2 >= 1; --step_log2) {
    add_octave(key, scale.octaves - key.level - step_log2, step_log2, amplitude);
    amplitude *= kPersistence;
  }
  for (std::size_t n = 0; n < sum_.size(); ++n) {
    out[n] = static_cast<std::int8_t>(std::lround(kCode * std::clamp(sum_[n], -1.0F, 1.0F)));
  }
}

void Pattern::add_octave(const Key& key, int octave, int step_log2, float amplitude) {
  const std::int64_t step = std::int64_t{1} << step_log2;
  const std::int64_t x0 = std::int64_t{key.i} * kTile_texels;
  const std::int64_t y0 = std::int64_t{key.j} * kTile_texels;
  const std::int64_t i0 = x0 >> step_log2;
  const std::int64_t j0 = y0 >> step_log2;
  const auto columns = static_cast<std::size_t>(((x0 + kTile_texels) >> step_log2) - i0 + 2);
  const auto rows = static_cast<std::size_t>(((y0 + kTile_texels) >> step_log2) - j0 + 2);
  knots_.resize(columns * rows);
  const std::uint64_t salt = mix(key.seed + static_cast<std::uint64_t>(octave));
  for (std::size_t r = 0; r < rows; ++r) {
    const std::uint64_t row_salt = mix(salt ^ static_cast<std::uint64_t>(j0 + static_cast<std::int64_t>(r)));
    for (std::size_t c = 0; c < columns; ++c) {
      knots_[r * columns + c] =
          amplitude * uniform(mix(row_salt ^ static_cast<std::uint64_t>(i0 + static_cast<std::int64_t>(c))));
    }
  }
  std::array<float, kStride> weight{};
  std::array<std::size_t, kStride> column{};
  for (int x = 0; x < kStride; ++x) {
    const std::int64_t at = x0 + x - (i0 << step_log2);
    column[static_cast<std::size_t>(x)] = static_cast<std::size_t>(at >> step_log2);
    weight[static_cast<std::size_t>(x)] = smooth(static_cast<float>(at & (step - 1)) / static_cast<float>(step));
  }
  std::vector<float> line(columns);
  for (int y = 0; y < kStride; ++y) {
    const std::int64_t at = y0 + y - (j0 << step_log2);
    const float w = smooth(static_cast<float>(at & (step - 1)) / static_cast<float>(step));
    const float* lower = knots_.data() + static_cast<std::size_t>(at >> step_log2) * columns;
    for (std::size_t c = 0; c < columns; ++c) {
      line[c] = lower[c] + w * (lower[c + columns] - lower[c]);
    }
    float* out = sum_.data() + static_cast<std::size_t>(y) * kStride;
    for (std::size_t x = 0; x < std::size_t{kStride}; ++x) {
      const float* knot = line.data() + column[x];
      out[x] += knot[0] + weight[x] * (knot[1] - knot[0]);
    }
  }
}

}  // namespace seeker::sim
