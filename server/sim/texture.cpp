#include "server/sim/texture.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/rng.hpp"

namespace seeker::sim {
namespace {

constexpr std::size_t kSide = NoiseTexture::kSide_texels;
constexpr std::uint64_t kTextureSeed = 20051117;

/// Adds one octave: random values every `step` texels, interpolated smoothly, with wrap-around.
void add_octave(std::vector<float>& out, std::size_t step, float amplitude, Rng& rng) {
  const std::size_t knots = kSide / step;
  std::vector<float> values(knots * knots);
  for (float& v : values) {
    v = static_cast<float>(rng.uniform(-1.0, 1.0));
  }
  for (std::size_t y = 0; y < kSide; ++y) {
    const std::size_t j0 = y / step;
    const std::size_t j1 = (j0 + 1) % knots;
    const float fy = static_cast<float>(y % step) / static_cast<float>(step);
    const float wy = fy * fy * (3.0F - 2.0F * fy);
    for (std::size_t x = 0; x < kSide; ++x) {
      const std::size_t i0 = x / step;
      const std::size_t i1 = (i0 + 1) % knots;
      const float fx = static_cast<float>(x % step) / static_cast<float>(step);
      const float wx = fx * fx * (3.0F - 2.0F * fx);
      const float low = values[j0 * knots + i0] * (1.0F - wx) + values[j0 * knots + i1] * wx;
      const float high = values[j1 * knots + i0] * (1.0F - wx) + values[j1 * knots + i1] * wx;
      out[y * kSide + x] += amplitude * (low * (1.0F - wy) + high * wy);
    }
  }
}

std::vector<float> halve_wrapped(const std::vector<float>& fine, std::size_t side) {
  const std::size_t half = side / 2;
  std::vector<float> coarse(half * half);
  for (std::size_t y = 0; y < half; ++y) {
    for (std::size_t x = 0; x < half; ++x) {
      const std::size_t at = 2 * y * side + 2 * x;
      coarse[y * half + x] = 0.25F * (fine[at] + fine[at + 1] + fine[at + side] + fine[at + side + 1]);
    }
  }
  return coarse;
}

}  // namespace

const NoiseTexture& NoiseTexture::instance() {
  static const NoiseTexture texture;
  return texture;
}

NoiseTexture::NoiseTexture() {
  Rng rng(kTextureSeed);
  std::vector<float> base(kSide * kSide, 0.0F);
  float amplitude = 0.55F;
  for (std::size_t step = static_cast<std::size_t>(kCoarsest_texels); step >= 1; step /= 2) {
    add_octave(base, step, amplitude, rng);
    amplitude *= 0.7F;
  }
  for (float& v : base) {
    v = std::clamp(v, -1.0F, 1.0F);
  }
  levels_.push_back(std::move(base));
  std::size_t side = kSide;
  for (int level = 1; level < kLevels; ++level) {
    levels_.push_back(halve_wrapped(levels_.back(), side));
    side /= 2;
  }
}

float NoiseTexture::at(double u_texel, double v_texel, int level) const {
  const auto mask = static_cast<std::int64_t>((kSide >> level) - 1U);
  const double scale = 1.0 / static_cast<double>(std::int64_t{1} << level);
  // Texel coordinates are positive (see Face::texture_u0), so that truncation is the floor.
  const auto i = static_cast<std::int64_t>(u_texel * scale) & mask;
  const auto j = static_cast<std::int64_t>(v_texel * scale) & mask;
  return levels_[static_cast<std::size_t>(level)][static_cast<std::size_t>(j * (mask + 1) + i)];
}

int mip_level(double footprint_texels, int levels) {
  int level = 0;
  // The next level halves the resolution: taken once the footprint exceeds 1.5 of the present texels.
  constexpr double kSwitch = 1.5;
  while (level + 1 < levels && footprint_texels > kSwitch) {
    footprint_texels *= 0.5;
    ++level;
  }
  return level;
}

PictureTexture::PictureTexture(const Image& picture) {
  const Image grey = to_grey(picture);
  SEEKER_ASSERT(!grey.empty());
  Level base{grey.width_px(), grey.height_px(), {}};
  constexpr float kWhite = 255.0F;
  for (const std::uint8_t value : grey.data()) {
    base.values.push_back(static_cast<float>(value) / kWhite);
  }
  levels_.push_back(std::move(base));
  while (std::min(levels_.back().width, levels_.back().height) > 1) {
    levels_.push_back(halve(levels_.back()));
  }
}

PictureTexture::Level PictureTexture::halve(const Level& fine) {
  Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  for (int y = 0; y < coarse.height; ++y) {
    const int y0 = y * fine.height / coarse.height;
    const int y1 = std::max(y0 + 1, (y + 1) * fine.height / coarse.height);
    for (int x = 0; x < coarse.width; ++x) {
      const int x0 = x * fine.width / coarse.width;
      const int x1 = std::max(x0 + 1, (x + 1) * fine.width / coarse.width);
      float sum = 0.0F;
      for (int j = y0; j < y1; ++j) {
        for (int i = x0; i < x1; ++i) {
          sum += fine.values[static_cast<std::size_t>(j * fine.width + i)];
        }
      }
      coarse.values.push_back(sum / static_cast<float>((y1 - y0) * (x1 - x0)));
    }
  }
  return coarse;
}

float PictureTexture::at(double s, double t, int level) const {
  const Level& l = levels_[static_cast<std::size_t>(level)];
  const double x = std::clamp(s * l.width - 0.5, 0.0, l.width - 1.0);
  const double y = std::clamp(t * l.height - 0.5, 0.0, l.height - 1.0);
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, l.width - 1);
  const int y1 = std::min(y0 + 1, l.height - 1);
  const auto value = [&](int i, int j) { return l.values[static_cast<std::size_t>(j * l.width + i)]; };
  const auto fx = static_cast<float>(x - x0);
  const auto fy = static_cast<float>(y - y0);
  return (value(x0, y0) * (1.0F - fx) + value(x1, y0) * fx) * (1.0F - fy) +
         (value(x0, y1) * (1.0F - fx) + value(x1, y1) * fx) * fy;
}

}  // namespace seeker::sim
