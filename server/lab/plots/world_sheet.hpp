/// \file
/// A sheet with a simulated world seen from above: a header of text, the world to scale, and below it a legend and a
/// scale bar.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/image/canvas.hpp"
#include "common/image/map_view.hpp"
#include "server/sim/world.hpp"

namespace seeker::lab {

struct LegendEntry {
  std::string label;
  image::Stroke stroke;
};

class WorldSheet {
 public:
  struct Layout {
    int largest_side_px = 1400;
    double margin_m = 0.4;  ///< around the world
    int header_px = 72;
  };

  WorldSheet(const sim::World& world, const Layout& layout);
  /// Of the part of a world between two corners.
  WorldSheet(const Point2& min_corner, const Point2& max_corner, const Layout& layout);

  [[nodiscard]] image::Canvas& canvas() { return canvas_; }
  [[nodiscard]] double px_per_m() const { return view_.px_per_m; }
  [[nodiscard]] Point2 px(const Point2& p_world) const { return view_.to_px(p_world) + Point2(0.0, header_px_); }
  [[nodiscard]] Matrix2 px2(const Matrix2& covariance_m2) const { return view_.to_px2(covariance_m2); }
  /// Lays colours over the whole part of the world; none where the sheet stays as it is.
  void paint(const std::function<std::optional<image::Colour>(const Point2& p_world)>& colour_at);
  void line(const Point2& a_world, const Point2& b_world, const image::Stroke& stroke) {
    canvas_.line(px(a_world), px(b_world), stroke);
  }
  void polyline(const std::vector<Point2>& path_world, const image::Stroke& stroke);
  /// Draws the title and the lines below it; the caller makes the header high enough.
  void head(const std::string& title, const std::vector<std::string>& facts);
  /// Draws the meanings of the strokes in one row below the world, and a scale bar of a round length below that.
  void foot(const std::vector<LegendEntry>& legend);

 private:
  int header_px_;
  image::MapView view_;
  image::Canvas canvas_;
};

}  // namespace seeker::lab
