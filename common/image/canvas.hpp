/// \file
/// Anti-aliased drawing on a colour image. Coordinates are pixels: x is the column, y the row, (0, 0) the corner
/// of the first pixel and (0.5, 0.5) its centre. What lies outside is clipped; what is not finite is left out.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/image/colour.hpp"

namespace seeker::image {

enum class LineStyle : std::uint8_t { kSolid, kDashed, kDashDot, kDotted };

/// How a line looks.
struct Stroke {
  Colour colour = kBlack;
  double width_px = 1.0;
  LineStyle style = LineStyle::kSolid;
  double alpha = 1.0;  ///< 0 invisible .. 1 opaque
};

enum class Anchor : std::uint8_t { kLeft, kCentre, kRight };

/// How text looks and how it lies to its point.
struct TextStyle {
  Colour colour = kBlack;
  double size_px = 11.0;  ///< height of a capital letter
  Anchor anchor = Anchor::kLeft;
  bool vertical = false;                      ///< reads upwards
  std::optional<Colour> halo = std::nullopt;  ///< outline that keeps it readable on a picture
};

struct Rect {
  double x_px = 0.0;
  double y_px = 0.0;
  double width_px = 0.0;
  double height_px = 0.0;
};

class Canvas {
 public:
  Canvas(int width_px, int height_px, Colour background);
  /// Draws on a picture; a grey one is made a colour one.
  explicit Canvas(const Image& picture);

  [[nodiscard]] const Image& image() const { return image_; }
  [[nodiscard]] int width_px() const { return image_.width_px(); }
  [[nodiscard]] int height_px() const { return image_.height_px(); }

  void set_pixel(int u, int v, Colour colour);
  [[nodiscard]] Colour pixel(int u, int v) const;
  /// Lays `colour` over one pixel; outside the image nothing happens.
  void blend(int u, int v, Colour colour, double alpha);

  void fill_rect(const Rect& rect, Colour colour, double alpha = 1.0);
  void rect(const Rect& rect, const Stroke& stroke);
  void line(const Point2& a, const Point2& b, const Stroke& stroke);
  void polyline(std::span<const Point2> points, const Stroke& stroke);
  /// Closed outline.
  void polygon(std::span<const Point2> corners, const Stroke& stroke);
  /// Even-odd filling.
  void fill_polygon(std::span<const Point2> corners, Colour colour, double alpha = 1.0);
  void circle(const Point2& centre, double radius_px, const Stroke& stroke);
  void fill_circle(const Point2& centre, double radius_px, Colour colour, double alpha = 1.0);
  /// A line with a filled head at `to`.
  void arrow(const Point2& from, const Point2& to, const Stroke& stroke, double head_px = 8.0);
  /// The curve of `sigmas` standard deviations of a Gaussian with this covariance in pixels^2.
  void ellipse(const Point2& centre, const Matrix2& covariance_px2, double sigmas, const Stroke& stroke);
  /// One line of text with its baseline's left end, middle or right end at `at`.
  void text(const Point2& at, std::string_view text, const TextStyle& style);

 private:
  Image image_;
};

/// Length of a text as Canvas::text() draws it.
[[nodiscard]] double text_width_px(std::string_view text, double size_px);

}  // namespace seeker::image
