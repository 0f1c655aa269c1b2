/// \file
/// The built-in font: 5x7 dots with one row for descenders, ASCII and the signs of degree, plus-minus and square.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace seeker::image {

inline constexpr int kGlyphColumns = 5;
inline constexpr int kGlyphRows = 8;
/// Columns from one character to the next.
inline constexpr int kGlyphAdvance = 6;

/// One byte a column, left to right; bit 0 is the top row, bit 7 the descender.
using Glyph = std::array<std::uint8_t, kGlyphColumns>;

/// The glyphs of a UTF-8 text; what the font does not have becomes a box.
[[nodiscard]] std::vector<Glyph> glyphs_of(std::string_view text);

[[nodiscard]] constexpr bool dot(const Glyph& glyph, int column, int row) {
  return column >= 0 && row >= 0 && column < kGlyphColumns && row < kGlyphRows &&
         ((static_cast<unsigned>(glyph[static_cast<std::size_t>(column)]) >> static_cast<unsigned>(row)) & 1U) != 0;
}

}  // namespace seeker::image
