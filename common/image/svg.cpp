#include "common/image/svg.hpp"

#include <array>
#include <cstdio>

namespace seeker::image {
namespace {

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string attribute(std::string_view name, const std::string& value) {
  return " " + std::string(name) + "=\"" + value + "\"";
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default:
        // XML 1.0 has no way to write the other control characters.
        if (static_cast<unsigned char>(c) >= ' ' || c == '\t' || c == '\n') {
          out += c;
        }
    }
  }
  return out;
}

std::string stroke_attributes(const Stroke& stroke) {
  if (stroke.width_px <= 0.0) {
    return attribute("stroke", "none");
  }
  std::string text = attribute("stroke", hex(stroke.colour).data()) +
                     attribute("stroke-width", number(stroke.width_px)) +
                     attribute("stroke-opacity", number(stroke.alpha)) + attribute("stroke-linecap", "round") +
                     attribute("stroke-linejoin", "round");
  const double w = stroke.width_px;
  switch (stroke.style) {
    case LineStyle::kSolid: break;
    case LineStyle::kDashed: text += attribute("stroke-dasharray", number(4 * w) + " " + number(3.5 * w)); break;
    case LineStyle::kDashDot:
      text += attribute("stroke-dasharray",
                        number(5 * w) + " " + number(3 * w) + " " + number(0.1 * w) + " " + number(3 * w));
      break;
    case LineStyle::kDotted: text += attribute("stroke-dasharray", number(0.1 * w) + " " + number(2.5 * w)); break;
  }
  return text;
}

std::string fill_attributes(Colour fill, double alpha) {
  return alpha > 0.0 ? attribute("fill", hex(fill).data()) + attribute("fill-opacity", number(alpha))
                     : attribute("fill", "none");
}

std::string points_attribute(std::span<const Point2> points) {
  std::string text;
  for (const Point2& p : points) {
    if (p.allFinite()) {
      text += (text.empty() ? "" : " ") + number(p.x()) + "," + number(p.y());
    }
  }
  return attribute("points", text);
}

}  // namespace

Svg::Svg(double width, double height, Colour background) : width_(width), height_(height) {
  rect({0.0, 0.0, width, height}, background, 1.0, {kBlack, 0.0});
}

void Svg::line(const Point2& a, const Point2& b, const Stroke& stroke) {
  polyline(std::array<Point2, 2>{a, b}, stroke);
}

void Svg::polyline(std::span<const Point2> points, const Stroke& stroke) {
  body_ += "<polyline" + points_attribute(points) + fill_attributes(kBlack, 0.0) + stroke_attributes(stroke) + "/>\n";
}

void Svg::polygon(std::span<const Point2> corners, Colour fill, double fill_alpha, const Stroke& stroke) {
  body_ +=
      "<polygon" + points_attribute(corners) + fill_attributes(fill, fill_alpha) + stroke_attributes(stroke) + "/>\n";
}

void Svg::circle(const Point2& centre, double radius, Colour fill, double fill_alpha, const Stroke& stroke) {
  if (!centre.allFinite()) {
    return;
  }
  body_ += "<circle" + attribute("cx", number(centre.x())) + attribute("cy", number(centre.y())) +
           attribute("r", number(radius)) + fill_attributes(fill, fill_alpha) + stroke_attributes(stroke) + "/>\n";
}

void Svg::rect(const Rect& rect, Colour fill, double fill_alpha, const Stroke& stroke) {
  body_ += "<rect" + attribute("x", number(rect.x_px)) + attribute("y", number(rect.y_px)) +
           attribute("width", number(rect.width_px)) + attribute("height", number(rect.height_px)) +
           fill_attributes(fill, fill_alpha) + stroke_attributes(stroke) + "/>\n";
}

void Svg::text(const Point2& at, std::string_view text, const TextStyle& style) {
  if (!at.allFinite()) {
    return;
  }
  // Capitals are about 0.72 of the font size in the common sans-serif fonts.
  constexpr double kCapitalShare = 0.72;
  const std::string anchor =
      style.anchor == Anchor::kLeft ? "start" : (style.anchor == Anchor::kCentre ? "middle" : "end");
  std::string place = attribute("x", number(at.x())) + attribute("y", number(at.y()));
  if (style.vertical) {
    place += attribute("transform", "rotate(-90 " + number(at.x()) + " " + number(at.y()) + ")");
  }
  body_ += "<text" + place + attribute("font-family", "sans-serif") +
           attribute("font-size", number(style.size_px / kCapitalShare)) + attribute("text-anchor", anchor) +
           attribute("fill", hex(style.colour).data()) + ">" + escaped(text) + "</text>\n";
}

std::string Svg::str() const {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"" +
         attribute("width", number(width_)) + attribute("height", number(height_)) +
         attribute("viewBox", "0 0 " + number(width_) + " " + number(height_)) + ">\n" + body_ + "</svg>\n";
}

}  // namespace seeker::image
