#include "common/image/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace seeker::image {
namespace {

/// Piecewise linear through evenly spaced anchors.
Colour through(std::span<const Colour> anchors, double t) {
  const double last = static_cast<double>(anchors.size() - 1);
  const double position = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) * last : 0.0;
  const auto index = std::min(static_cast<std::size_t>(position), anchors.size() - 2);
  return mix(anchors[index], anchors[index + 1], position - static_cast<double>(index));
}

}  // namespace

Colour series_colour(std::size_t index) {
  constexpr std::array<Colour, 6> kSeries{kBlue, kOrange, kGreen, kRed, kPurple, kSky};
  return kSeries[index % kSeries.size()];
}

Colour mix(Colour a, Colour b, double t) {
  const double weight = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.0;
  const auto channel = [weight](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * weight));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

Colour viridis(double t) {
  constexpr std::array<Colour, 10> kAnchors{{{68, 1, 84},
                                             {72, 40, 120},
                                             {62, 74, 137},
                                             {49, 104, 142},
                                             {38, 130, 142},
                                             {31, 158, 137},
                                             {53, 183, 121},
                                             {109, 205, 89},
                                             {180, 222, 44},
                                             {253, 231, 37}}};
  return through(kAnchors, t);
}

Colour red_to_green(double t) {
  constexpr std::array<Colour, 5> kAnchors{
      {{215, 72, 50}, {244, 150, 86}, {250, 222, 140}, {150, 206, 130}, {46, 150, 96}}};
  return through(kAnchors, t);
}

}  // namespace seeker::image
