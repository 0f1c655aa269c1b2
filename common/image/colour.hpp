/// \file
/// Colours and colour maps of the figures. The palette keeps its order of lightness in greyscale and is distinguishable
/// with the common colour deficiencies (after Okabe and Ito, "Color Universal Design", 2008).
#pragma once

#include <cstddef>
#include <cstdint>

namespace seeker::image {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

inline constexpr Colour kBlack{20, 22, 26};
inline constexpr Colour kWhite{255, 255, 255};
inline constexpr Colour kGrey{120, 124, 130};
inline constexpr Colour kLightGrey{214, 216, 219};
inline constexpr Colour kBlue{0, 100, 178};
inline constexpr Colour kOrange{224, 135, 0};
inline constexpr Colour kGreen{0, 140, 104};
inline constexpr Colour kRed{204, 51, 17};
inline constexpr Colour kPurple{163, 64, 140};
inline constexpr Colour kSky{72, 164, 218};

/// Colours of series in order; the seventh is the first again.
[[nodiscard]] Colour series_colour(std::size_t index);
/// Blend of a (t = 0) and b (t = 1); t is clamped.
[[nodiscard]] Colour mix(Colour a, Colour b, double t);
/// The perceptually even map viridis: dark blue (0) over green to yellow (1); t is clamped.
[[nodiscard]] Colour viridis(double t);
/// Red (0) over pale yellow (0.5) to green (1): what is missing and what is done; t is clamped.
[[nodiscard]] Colour red_to_green(double t);

}  // namespace seeker::image
