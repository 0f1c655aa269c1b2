#include <cmath>

#include "common/image/canvas.hpp"
#include "common/image/coverage.hpp"
#include "common/image/font.hpp"

namespace seeker::image {
namespace {

/// Rows between the middle of a capital's top and bottom dots, plus one dot for the width of the strokes.
constexpr double kCapitalRows = 7.0;
constexpr double kStrokeRadius_dots = 0.52;
constexpr int kBaselineRow = 6;

struct Placement {
  Point2 origin;  ///< middle of the first glyph's dot (0, kBaselineRow)
  double dot_px = 1.0;
  bool vertical = false;

  [[nodiscard]] Point2 at(double column, double row) const {
    const double along = column * dot_px;
    const double down = (row - kBaselineRow) * dot_px;
    return vertical ? origin + Point2(down, -along) : origin + Point2(along, down);
  }
};

/// Joins neighbouring dots by strokes, so that the 5x7 dots become smooth letters at any size.
void add_glyph(Coverage& coverage, const Glyph& glyph, int first_column, const Placement& place, double radius_px) {
  for (int row = 0; row < kGlyphRows; ++row) {
    for (int column = 0; column < kGlyphColumns; ++column) {
      if (!dot(glyph, column, row)) {
        continue;
      }
      const Point2 here = place.at(first_column + column, row);
      coverage.add_capsule(here, here, radius_px);
      const bool right = dot(glyph, column + 1, row);
      const bool below = dot(glyph, column, row + 1);
      const bool left = dot(glyph, column - 1, row);
      if (right) {
        coverage.add_capsule(here, place.at(first_column + column + 1, row), radius_px);
      }
      if (below) {
        coverage.add_capsule(here, place.at(first_column + column, row + 1), radius_px);
      }
      if (!right && !below && dot(glyph, column + 1, row + 1)) {
        coverage.add_capsule(here, place.at(first_column + column + 1, row + 1), radius_px);
      }
      if (!left && !below && dot(glyph, column - 1, row + 1)) {
        coverage.add_capsule(here, place.at(first_column + column - 1, row + 1), radius_px);
      }
    }
  }
}

Coverage draw_glyphs(const Image& image, const std::vector<Glyph>& glyphs, const Placement& place, double radius_px) {
  const double columns = static_cast<double>(glyphs.size()) * kGlyphAdvance;
  const Point2 a = place.at(-1.0, -1.0);
  const Point2 b = place.at(columns, kGlyphRows);
  const Point2 margin = Point2::Constant(radius_px + 1.0);
  Coverage coverage(image, a.cwiseMin(b) - margin, a.cwiseMax(b) + margin);
  int column = 0;
  for (const Glyph& glyph : glyphs) {
    add_glyph(coverage, glyph, column, place, radius_px);
    column += kGlyphAdvance;
  }
  return coverage;
}

}  // namespace

double text_width_px(std::string_view text, double size_px) {
  const auto count = static_cast<double>(glyphs_of(text).size());
  return count > 0.0 ? (count * kGlyphAdvance - 1.0) * size_px / kCapitalRows : 0.0;
}

void Canvas::text(const Point2& at, std::string_view text, const TextStyle& style) {
  const std::vector<Glyph> glyphs = glyphs_of(text);
  if (glyphs.empty() || !at.allFinite()) {
    return;
  }
  Placement place{at, style.size_px / kCapitalRows, style.vertical};
  const double width = text_width_px(text, style.size_px);
  const double shift = style.anchor == Anchor::kLeft ? 0.0 : (style.anchor == Anchor::kCentre ? width / 2.0 : width);
  // The point is the corner of the first dot, the placement its middle.
  place.origin += style.vertical ? Point2(-0.5 * place.dot_px, shift - 0.5 * place.dot_px)
                                 : Point2(0.5 * place.dot_px - shift, -0.5 * place.dot_px);
  const double radius = kStrokeRadius_dots * place.dot_px;
  if (style.halo) {
    constexpr double kHaloAlpha = 0.85;
    draw_glyphs(image_, glyphs, place, radius + 1.5 * place.dot_px).blend_onto(image_, *style.halo, kHaloAlpha);
  }
  draw_glyphs(image_, glyphs, place, radius).blend_onto(image_, style.colour, 1.0);
}

}  // namespace seeker::image
