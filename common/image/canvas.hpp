/// \file
/// Anti-aliased drawing by Cairo, as pixels or as a vector drawing (SVG): what is drawn is the same. Coordinates are
/// pixels: x is the column, y the row, (0, 0) the corner of the first pixel and (0.5, 0.5) its centre. What lies
/// outside is clipped; what is not finite is left out.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

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
  /// Of pixels; at most 32767 a side.
  Canvas(int width_px, int height_px, Colour background);
  /// Draws on a picture; a grey one is made a colour one.
  explicit Canvas(const Image& picture);
  /// Of shapes, which svg() gives as a document.
  [[nodiscard]] static Canvas vector(int width_px, int height_px, Colour background);
  Canvas(Canvas&& other) noexcept;
  Canvas& operator=(Canvas&& other) noexcept;
  ~Canvas();

  /// A part of this canvas that clips what is drawn on it; its (0, 0) is the corner of `part`.
  [[nodiscard]] Canvas window(const Rect& part);

  /// The picture; of a canvas of pixels.
  [[nodiscard]] Image image() const;
  [[nodiscard]] Colour pixel(int u, int v) const;
  /// The document; of a canvas of shapes, on which nothing can be drawn afterwards.
  [[nodiscard]] std::string svg();
  [[nodiscard]] int width_px() const;
  [[nodiscard]] int height_px() const;

  /// Colours of a picture by column and row; none where it is transparent.
  using PixelColours = std::function<std::optional<Colour>(int u, int v)>;
  /// Lays a picture over whole pixels with its upper left corner at column `left`, row `top`.
  void picture(int left_px, int top_px, int width_px, int height_px, const PixelColours& colour_at, double alpha = 1.0);

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
  /// One line of text with its baseline's left end, middle or right end at `at`. Bytes that are not UTF-8 are skipped.
  void text(const Point2& at, std::string_view text, const TextStyle& style);

 private:
  struct Drawing;
  explicit Canvas(std::unique_ptr<Drawing> drawing);
  void outline(const Stroke& stroke, double length_px);

  std::unique_ptr<Drawing> drawing_;
};

/// Length of a text as Canvas::text() draws it: in DejaVu Sans (Debian package fonts-dejavu-core), in the font whose
/// file the environment variable SEEKER_FONT names, or, where there is no such file, in plain strokes.
[[nodiscard]] double text_width_px(std::string_view text, double size_px);

}  // namespace seeker::image
