#include "common/image/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <cairo-ft.h>
#include <cairo-svg.h>
#include <cairo.h>

#include "common/core/angle.hpp"
#include "common/image/utf8.hpp"

namespace seeker::image {
namespace {

/// Longer lines are drawn without dashes: their ends are far outside of any image.
constexpr double kMaxDashedLength_px = 1e5;
/// What lies farther away is moved to here: Cairo's fixed-point numbers end at 2^23 pixels.
constexpr double kFarthest_px = 1e6;
constexpr int kMaxSide_px = 32767;

Point2 reachable(const Point2& p) {
  return p.cwiseMax(Point2::Constant(-kFarthest_px)).cwiseMin(Point2::Constant(kFarthest_px));
}

std::vector<double> dash_pattern(const Stroke& stroke) {
  const double unit = std::max(1.0, stroke.width_px);
  switch (stroke.style) {
    case LineStyle::kSolid: return {};
    case LineStyle::kDashed: return {4.0 * unit, 3.5 * unit};
    case LineStyle::kDashDot: return {5.0 * unit, 3.0 * unit, 0.1 * unit, 3.0 * unit};
    case LineStyle::kDotted: return {0.1 * unit, 2.5 * unit};
  }
  return {};
}

/// Adds the finite points to the path. Gives its length in pixels; nothing where no point is finite.
std::optional<double> add_path(cairo_t* pen, std::span<const Point2> points) {
  std::optional<Point2> last;
  double length = 0.0;
  for (const Point2& point : points) {
    if (!point.allFinite()) {
      continue;
    }
    const Point2 p = reachable(point);
    if (last) {
      cairo_line_to(pen, p.x(), p.y());
      length += (p - *last).norm();
    } else {
      cairo_move_to(pen, p.x(), p.y());
    }
    last = p;
  }
  if (!last) {
    return std::nullopt;
  }
  cairo_line_to(pen, last->x(), last->y());  // a single point becomes a dot
  return length;
}

void set_colour(cairo_t* pen, Colour colour, double alpha) {
  constexpr double kFull = 255.0;
  cairo_set_source_rgba(pen, colour.red / kFull, colour.green / kFull, colour.blue / kFull, alpha);
}

/// Cairo's pixels: alpha, red, green and blue from the highest byte of a word to the lowest.
std::uint32_t word_of(Colour colour) {
  return 0xFF000000U | static_cast<std::uint32_t>(colour.red) << 16U | static_cast<std::uint32_t>(colour.green) << 8U |
         colour.blue;
}

std::uint8_t* word_at(cairo_surface_t* surface, int u, int v) {
  return cairo_image_surface_get_data(surface) +
         static_cast<std::ptrdiff_t>(cairo_image_surface_get_stride(surface)) * v +
         static_cast<std::ptrdiff_t>(sizeof(std::uint32_t)) * u;
}

Colour colour_at(cairo_surface_t* surface, int u, int v) {
  std::uint32_t word = 0;
  std::memcpy(&word, word_at(surface, u, v), sizeof(word));
  return {static_cast<std::uint8_t>(word >> 16U), static_cast<std::uint8_t>(word >> 8U),
          static_cast<std::uint8_t>(word)};
}

/// Fills a surface of pixels; a word of 0 is transparent.
template <class WordAt>
void fill_words(cairo_surface_t* surface, WordAt word_of_pixel) {
  for (int v = 0; v < cairo_image_surface_get_height(surface); ++v) {
    for (int u = 0; u < cairo_image_surface_get_width(surface); ++u) {
      const std::uint32_t word = word_of_pixel(u, v);
      std::memcpy(word_at(surface, u, v), &word, sizeof(word));
    }
  }
  cairo_surface_mark_dirty(surface);
}

/// DejaVu Sans as Debian's fonts-dejavu-core has it, or the file that SEEKER_FONT names; else the strokes that Cairo
/// brings, which know ASCII. Not by fontconfig: pictures are the same on every machine, and none waits for its cache.
cairo_font_face_t* font_face() {
  static cairo_font_face_t* const face = [] {
    const char* named = std::getenv("SEEKER_FONT");
    const char* file = named != nullptr ? named : "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    FT_Library library = nullptr;
    FT_Face loaded = nullptr;
    if (FT_Init_FreeType(&library) == 0 && FT_New_Face(library, file, 0, &loaded) == 0) {
      return cairo_ft_font_face_create_for_ft_face(loaded, FT_LOAD_NO_HINTING);
    }
    FT_Done_FreeType(library);
    return cairo_toy_font_face_create("@cairo:", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  }();
  return face;
}

/// Of one size in pixels, for a whole em.
struct Font {
  explicit Font(double em_px) {
    cairo_matrix_t size;
    cairo_matrix_t identity;
    cairo_matrix_init_scale(&size, em_px, em_px);
    cairo_matrix_init_identity(&identity);
    cairo_font_options_t* options = cairo_font_options_create();
    // Letters as the font has them: a text is as wide on paper as in pixels.
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    scaled = cairo_scaled_font_create(font_face(), &size, &identity, options);
    cairo_font_options_destroy(options);
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font() { cairo_scaled_font_destroy(scaled); }

  [[nodiscard]] cairo_text_extents_t extents(const std::string& text) const {
    cairo_text_extents_t extents;
    cairo_scaled_font_text_extents(scaled, text.c_str(), &extents);
    return extents;
  }

  cairo_scaled_font_t* scaled;
};

/// The size of the font whose capitals are so high.
double em_px_of(double capital_px) {
  static const double em_per_capital = [] {
    constexpr double kEm_px = 1000.0;
    const double capital = Font(kEm_px).extents("H").height;
    constexpr double kUsual = 0.72;
    return 1.0 / (capital > 0.0 ? capital / kEm_px : kUsual);
  }();
  return capital_px * em_per_capital;
}

struct SurfaceCloser {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct PenCloser {
  void operator()(cairo_t* pen) const { cairo_destroy(pen); }
};

using Surface = std::shared_ptr<cairo_surface_t>;

Surface new_pixels(cairo_format_t format, int width_px, int height_px) {
  SEEKER_ASSERT(width_px >= 0 && height_px >= 0 && width_px <= kMaxSide_px && height_px <= kMaxSide_px);
  return {cairo_image_surface_create(format, width_px, height_px), SurfaceCloser()};
}

cairo_status_t append(void* document, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(document)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct Canvas::Drawing {
  Drawing(std::shared_ptr<std::string> text, Surface target, int width, int height)
      : document(std::move(text)),
        surface(std::move(target)),
        pen(cairo_create(surface.get())),
        width_px(width),
        height_px(height) {
    cairo_set_line_cap(pen.get(), CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(pen.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_fill_rule(pen.get(), CAIRO_FILL_RULE_EVEN_ODD);
  }

  std::shared_ptr<std::string> document;  ///< of shapes; outlives the surface that writes it
  Surface surface;
  std::unique_ptr<cairo_t, PenCloser> pen;
  int width_px;
  int height_px;
};

Canvas::Canvas(std::unique_ptr<Drawing> drawing) : drawing_(std::move(drawing)) {}
Canvas::Canvas(Canvas&& other) noexcept = default;
Canvas& Canvas::operator=(Canvas&& other) noexcept = default;
Canvas::~Canvas() = default;

Canvas::Canvas(int width_px, int height_px, Colour background)
    : drawing_(std::make_unique<Drawing>(nullptr, new_pixels(CAIRO_FORMAT_RGB24, width_px, height_px), width_px,
                                         height_px)) {
  set_colour(drawing_->pen.get(), background, 1.0);
  cairo_paint(drawing_->pen.get());
}

Canvas::Canvas(const Image& picture) : Canvas(picture.width_px(), picture.height_px(), kBlack) {
  cairo_surface_flush(drawing_->surface.get());
  const bool grey = picture.channels() == 1;
  fill_words(drawing_->surface.get(), [&](int u, int v) {
    const std::uint8_t* p = picture.at(u, v);
    return word_of({p[0], p[grey ? 0 : 1], p[grey ? 0 : 2]});
  });
}

Canvas Canvas::vector(int width_px, int height_px, Colour background) {
  auto document = std::make_shared<std::string>();
  Surface surface(cairo_svg_surface_create_for_stream(append, document.get(), width_px, height_px), SurfaceCloser());
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  Canvas canvas(std::make_unique<Drawing>(std::move(document), std::move(surface), width_px, height_px));
  canvas.fill_rect({0.0, 0.0, static_cast<double>(width_px), static_cast<double>(height_px)}, background);
  return canvas;
}

Canvas Canvas::window(const Rect& part) {
  auto drawing =
      std::make_unique<Drawing>(drawing_->document, drawing_->surface, static_cast<int>(std::lround(part.width_px)),
                                static_cast<int>(std::lround(part.height_px)));
  cairo_matrix_t place;
  cairo_get_matrix(drawing_->pen.get(), &place);
  cairo_t* pen = drawing->pen.get();
  cairo_set_matrix(pen, &place);
  cairo_rectangle(pen, part.x_px, part.y_px, part.width_px, part.height_px);
  cairo_clip(pen);
  cairo_translate(pen, part.x_px, part.y_px);
  return Canvas(std::move(drawing));
}

int Canvas::width_px() const { return drawing_->width_px; }
int Canvas::height_px() const { return drawing_->height_px; }

Image Canvas::image() const {
  SEEKER_ASSERT(drawing_->document == nullptr);
  cairo_surface_t* surface = drawing_->surface.get();
  cairo_surface_flush(surface);
  Image image(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), 3);
  for (int v = 0; v < image.height_px(); ++v) {
    for (int u = 0; u < image.width_px(); ++u) {
      const Colour colour = colour_at(surface, u, v);
      std::uint8_t* to = image.at(u, v);
      to[0] = colour.red;
      to[1] = colour.green;
      to[2] = colour.blue;
    }
  }
  return image;
}

Colour Canvas::pixel(int u, int v) const {
  cairo_surface_flush(drawing_->surface.get());
  return colour_at(drawing_->surface.get(), u, v);
}

std::string Canvas::svg() {
  SEEKER_ASSERT(drawing_->document != nullptr);
  cairo_surface_finish(drawing_->surface.get());
  return *drawing_->document;
}

void Canvas::picture(int left_px, int top_px, int width_px, int height_px, const PixelColours& colour_at,
                     double alpha) {
  const Surface pixels = new_pixels(CAIRO_FORMAT_ARGB32, width_px, height_px);
  fill_words(pixels.get(), [&](int u, int v) {
    const std::optional<Colour> colour = colour_at(u, v);
    return colour ? word_of(*colour) : 0U;
  });
  cairo_t* pen = drawing_->pen.get();
  cairo_set_source_surface(pen, pixels.get(), left_px, top_px);
  cairo_pattern_set_filter(cairo_get_source(pen), CAIRO_FILTER_NEAREST);
  cairo_paint_with_alpha(pen, alpha);
}

void Canvas::outline(const Stroke& stroke, double length_px) {
  cairo_t* pen = drawing_->pen.get();
  const std::vector<double> dashes = length_px < kMaxDashedLength_px ? dash_pattern(stroke) : std::vector<double>();
  cairo_set_dash(pen, dashes.data(), static_cast<int>(dashes.size()), 0.0);
  cairo_set_line_width(pen, stroke.width_px);
  set_colour(pen, stroke.colour, stroke.alpha);
  cairo_stroke(pen);
}

void Canvas::polyline(std::span<const Point2> points, const Stroke& stroke) {
  if (const std::optional<double> length_px = add_path(drawing_->pen.get(), points)) {
    outline(stroke, *length_px);
  }
}

void Canvas::polygon(std::span<const Point2> corners, const Stroke& stroke) {
  if (const std::optional<double> length_px = add_path(drawing_->pen.get(), corners)) {
    cairo_close_path(drawing_->pen.get());
    outline(stroke, *length_px);
  }
}

void Canvas::fill_polygon(std::span<const Point2> corners, Colour colour, double alpha) {
  if (add_path(drawing_->pen.get(), corners)) {
    set_colour(drawing_->pen.get(), colour, alpha);
    cairo_fill(drawing_->pen.get());
  }
}

void Canvas::fill_circle(const Point2& centre, double radius_px, Colour colour, double alpha) {
  if (!centre.allFinite() || !(radius_px >= 0.0)) {
    return;
  }
  const Point2 at = reachable(centre);
  cairo_t* pen = drawing_->pen.get();
  cairo_arc(pen, at.x(), at.y(), std::min(radius_px, kFarthest_px), 0.0, kTwoPi);
  set_colour(pen, colour, alpha);
  cairo_fill(pen);
}

void Canvas::ellipse(const Point2& centre, const Matrix2& covariance_px2, double sigmas, const Stroke& stroke) {
  if (!centre.allFinite() || !covariance_px2.allFinite() || !(sigmas >= 0.0)) {
    return;
  }
  // Eigenvalues and axes of a symmetric 2x2 matrix in closed form.
  const double mean = (covariance_px2(0, 0) + covariance_px2(1, 1)) / 2.0;
  const double half = (covariance_px2(0, 0) - covariance_px2(1, 1)) / 2.0;
  const double spread = std::hypot(half, covariance_px2(0, 1));
  const double axis_rad = 0.5 * std::atan2(covariance_px2(0, 1), half);
  // Cairo refuses a scale of 0 for good.
  constexpr double kNarrowest_px = 1e-2;
  const auto semi_axis_px = [&](double variance) {
    return std::clamp(sigmas * std::sqrt(std::max(0.0, variance)), kNarrowest_px, kFarthest_px);
  };
  const double major_px = semi_axis_px(mean + spread);
  cairo_t* pen = drawing_->pen.get();
  cairo_save(pen);
  const Point2 at = reachable(centre);
  cairo_translate(pen, at.x(), at.y());
  cairo_rotate(pen, axis_rad);
  cairo_scale(pen, major_px, semi_axis_px(mean - spread));
  cairo_arc(pen, 0.0, 0.0, 1.0, 0.0, kTwoPi);
  cairo_close_path(pen);
  cairo_restore(pen);
  outline(stroke, kTwoPi * major_px);
}

void Canvas::text(const Point2& at, std::string_view text, const TextStyle& style) {
  const std::string valid = valid_utf8(text);
  if (valid.empty() || !at.allFinite() || !(style.size_px > 0.0)) {
    return;
  }
  const Font font(em_px_of(style.size_px));
  const double width_px = font.extents(valid).x_advance;
  const double shift =
      style.anchor == Anchor::kLeft ? 0.0 : (style.anchor == Anchor::kCentre ? width_px / 2.0 : width_px);
  cairo_t* pen = drawing_->pen.get();
  cairo_save(pen);
  const Point2 start = reachable(at);
  cairo_translate(pen, start.x(), start.y());
  cairo_rotate(pen, style.vertical ? -kPi / 2.0 : 0.0);
  cairo_set_scaled_font(pen, font.scaled);
  cairo_move_to(pen, -shift, 0.0);
  cairo_text_path(pen, valid.c_str());
  if (style.halo) {
    constexpr double kHaloAlpha = 0.85;
    constexpr double kHaloWidth = 0.43;
    cairo_path_t* letters = cairo_copy_path(pen);
    outline({*style.halo, kHaloWidth * style.size_px, LineStyle::kSolid, kHaloAlpha}, 0.0);
    cairo_append_path(pen, letters);
    cairo_path_destroy(letters);
  }
  set_colour(pen, style.colour, 1.0);
  cairo_set_fill_rule(pen, CAIRO_FILL_RULE_WINDING);  // strokes of a letter may lie over each other
  cairo_fill(pen);
  cairo_restore(pen);
}

double text_width_px(std::string_view text, double size_px) {
  const std::string valid = valid_utf8(text);
  return valid.empty() || !(size_px > 0.0) ? 0.0 : Font(em_px_of(size_px)).extents(valid).x_advance;
}

}  // namespace seeker::image
