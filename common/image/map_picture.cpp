#include "common/image/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>

#include "common/image/map_layers.hpp"
#include "common/image/topology_layer.hpp"

namespace seeker::image {
namespace {

constexpr int kPanelWidth_px = 330;
constexpr int kPad_px = 18;
constexpr double kText_px = 9.5;
constexpr double kLine_px = 21.0;
constexpr Colour kPanelColour{246, 247, 249};

/// Shortens a text to a width, with two dots where something is missing.
std::string shortened(std::string text, double size_px, double width_px) {
  if (text_width_px(text, size_px) <= width_px) {
    return text;
  }
  while (!text.empty() && text_width_px(text + "..", size_px) > width_px) {
    text.pop_back();
  }
  return text + "..";
}

/// One entry of the legend: draws its sign with the middle at a point.
struct LegendEntry {
  std::string label;
  std::function<void(Canvas&, const Point2&)> draw;
};

LegendEntry swatch(std::string label, Colour colour) {
  return {std::move(label), [colour](Canvas& canvas, const Point2& at) {
            canvas.fill_rect({at.x() - 11.0, at.y() - 6.0, 22.0, 12.0}, colour);
            canvas.rect({at.x() - 11.0, at.y() - 6.0, 22.0, 12.0}, {kGrey, 1.0});
          }};
}

LegendEntry line_sample(std::string label, Stroke stroke) {
  return {std::move(label), [stroke](Canvas& canvas, const Point2& at) {
            canvas.line(at - Point2(13.0, 0.0), at + Point2(13.0, 0.0), stroke);
          }};
}

LegendEntry cell_sample(std::string label, Stroke stroke, bool cross) {
  return {std::move(label), [stroke, cross](Canvas& canvas, const Point2& at) {
            constexpr double kSide_px = 14.0;
            draw_cell(canvas, at, kSide_px, stroke, cross);
          }};
}

void add_map_entries(std::vector<LegendEntry>& entries, const MapScene& scene) {
  if (scene.occupancy) {
    entries.push_back(swatch("free floor", look::kFree));
    entries.push_back(swatch("wall or obstacle", look::kWall));
    entries.push_back(swatch("unknown", look::kUnknown));
  }
  if (!scene.trajectory.empty()) {
    entries.push_back(line_sample("path of the robot", look::kTrajectory));
  }
  if (!scene.planned_path.empty()) {
    entries.push_back(line_sample("planned path", look::kPlan));
  }
  if (scene.bound) {
    entries.push_back(line_sample("bound of the search", look::kBound));
  }
  if (!scene.keep_out.empty()) {
    entries.push_back(line_sample("keep-out area", look::kKeepOut));
  }
}

/// The signs in grey: each robot has a colour of its own.
void add_topology_entries(std::vector<LegendEntry>& entries, const std::vector<RobotTopology>& topologies) {
  const auto any = [&](auto has) {
    return std::any_of(topologies.begin(), topologies.end(), [&](const RobotTopology& robot) {
      return std::any_of(robot.topology.nodes.begin(), robot.topology.nodes.end(), has);
    });
  };
  if (any([](const TopologyNode& /*node*/) { return true; })) {
    entries.push_back(
        {"node of the topology", [](Canvas& canvas, const Point2& at) { draw_topology_node(canvas, at, kGrey); }});
  }
  if (any([](const TopologyNode& node) { return !node.goals.empty(); })) {
    entries.push_back(
        {"goal still to visit", [](Canvas& canvas, const Point2& at) { draw_topology_goal(canvas, at, kGrey); }});
  }
}

std::vector<LegendEntry> legend_of(const MapScene& scene) {
  std::vector<LegendEntry> entries;
  if (scene.robot || !scene.topologies.empty()) {
    entries.push_back({"robot", [](Canvas& canvas, const Point2& at) {
                         MapView view;
                         view.low = Point2(-at.x(), at.y());
                         view.high = Point2(0.0, at.y());
                         draw_robot(canvas, view, Pose2{0.0, 0.0, 0.0}, 0.0);
                       }});
  }
  if (!scene.detections.empty()) {
    entries.push_back(
        {"target found, with 2 sigma", [](Canvas& canvas, const Point2& at) { draw_pin(canvas, at, 12.0); }});
  }
  add_map_entries(entries, scene);
  if (scene.space_tree) {
    entries.push_back(line_sample("space tree", look::kSpaceTree));
  }
  add_topology_entries(entries, scene.topologies);
  if (!scene.searched.empty()) {
    entries.push_back(cell_sample("searched cell", look::kSearched, false));
  }
  if (!scene.unsearched.empty()) {
    entries.push_back(cell_sample("cell still to search", look::kUnsearched, false));
  }
  if (!scene.unreachable.empty()) {
    entries.push_back(cell_sample("cell without a way to it", look::kUnreachable, true));
  }
  return entries;
}

/// Writes the panel from top to bottom.
class Panel {
 public:
  Panel(Canvas& canvas, double left_px) : canvas_(canvas), left_(left_px) {
    canvas_.fill_rect({left_, 0.0, kPanelWidth_px, static_cast<double>(canvas_.height_px())}, kPanelColour);
    canvas_.line(Point2(left_, 0.0), Point2(left_, canvas_.height_px()), {kLightGrey, 2.0});
  }

  void title(const std::string& text) {
    constexpr double kTitle_px = 13.0;
    y_ += kTitle_px;
    canvas_.text(Point2(left_ + kPad_px, y_), shortened(text, kTitle_px, width()), {kBlack, kTitle_px});
    y_ += kLine_px / 2.0;
  }
  void heading(const std::string& text) {
    y_ += 1.6 * kLine_px;
    canvas_.text(Point2(left_ + kPad_px, y_), text, {kGrey, kText_px});
    canvas_.line(Point2(left_ + kPad_px, y_ + 6.5), Point2(left_ + kPad_px + width(), y_ + 6.5), {kLightGrey, 1.0});
    y_ += 4.0;
  }
  void fact(const std::string& name, const std::string& value) {
    y_ += kLine_px;
    const double value_width = text_width_px(value, kText_px);
    const std::string label = shortened(name, kText_px, std::max(0.0, width() - value_width - 10.0));
    canvas_.text(Point2(left_ + kPad_px, y_), label, {kGrey, kText_px});
    canvas_.text(Point2(left_ + kPad_px + width(), y_), shortened(value, kText_px, width()),
                 {kBlack, kText_px, Anchor::kRight});
  }
  void entry(const LegendEntry& entry) {
    y_ += kLine_px + 2.0;
    entry.draw(canvas_, Point2(left_ + kPad_px + 14.0, y_ - kText_px / 2.0));
    canvas_.text(Point2(left_ + kPad_px + 38.0, y_), shortened(entry.label, kText_px, width() - 38.0),
                 {kBlack, kText_px});
  }
  void evidence_bar() {
    heading("seen if it were there");
    y_ += kLine_px / 2.0;
    for (int u = 0; u < static_cast<int>(width()); ++u) {
      const Colour colour = mix(look::kFree, red_to_green(u / width()), 2.0 * look::kEvidenceAlpha);
      canvas_.fill_rect({left_ + kPad_px + u, y_, 1.0, 12.0}, colour);
    }
    y_ += 13.0 + kLine_px * 0.75;
    canvas_.text(Point2(left_ + kPad_px, y_), "0", {kBlack, kText_px});
    canvas_.text(Point2(left_ + kPad_px + width() / 2.0, y_), "0.5", {kBlack, kText_px, Anchor::kCentre});
    canvas_.text(Point2(left_ + kPad_px + width(), y_), "1", {kBlack, kText_px, Anchor::kRight});
  }
  void gaps(const std::vector<GapMark>& listed) {
    heading("gaps: " + std::to_string(listed.size()));
    for (const auto& [name, area] : gap_rows(listed)) {
      fact(name, area);
    }
  }
  [[nodiscard]] double bottom_px() const { return y_ + kPad_px; }

 private:
  [[nodiscard]] static double width() { return kPanelWidth_px - 2.0 * kPad_px; }

  Canvas& canvas_;
  double left_;
  double y_ = kPad_px;
};

double write_panel(Canvas& canvas, double left_px, const MapScene& scene) {
  Panel panel(canvas, left_px);
  panel.title(scene.title.empty() ? "Map" : scene.title);
  for (const auto& [name, value] : scene.facts) {
    panel.fact(name, value);
  }
  panel.heading("legend");
  for (const LegendEntry& entry : legend_of(scene)) {
    panel.entry(entry);
  }
  if (scene.evidence) {
    panel.evidence_bar();
  }
  if (const std::vector<GapMark> listed = listed_gaps(scene.gaps); !listed.empty()) {
    panel.gaps(listed);
  }
  return panel.bottom_px();
}

/// The map with its marks; what lies outside of the view is clipped.
void draw_layers(Canvas& canvas, const MapView& view, const MapScene& scene) {
  if (scene.occupancy) {
    draw_occupancy(canvas, view, *scene.occupancy);
  }
  if (scene.evidence) {
    draw_evidence(canvas, view, *scene.evidence);
  }
  draw_areas(canvas, view, scene);
  draw_cells(canvas, view, scene);
  draw_paths(canvas, view, scene);
  draw_gaps(canvas, view, scene.gaps);
  if (scene.space_tree) {
    draw_space_tree(canvas, view, *scene.space_tree);
  }
  draw_topologies(canvas, view, scene.topologies, scene.robot_radius_m);
  draw_detections(canvas, view, scene.detections);
  if (scene.robot) {
    draw_robot(canvas, view, *scene.robot, scene.robot_radius_m);
  }
  draw_scale_bar(canvas, view);
}

/// The map beside its panel, on the canvas that `new_canvas` makes in the size that both need.
Result<Canvas> draw_scene(const MapScene& scene, const MapPictureOptions& options,
                          Canvas (*new_canvas)(int width_px, int height_px)) {
  const Result<MapView> view = fit_view(scene, options);
  if (!view) {
    return tl::unexpected(view.error());
  }
  // The panel is measured on a canvas of one pixel first: drawing clips, the layout does not.
  Canvas measure(1, 1, kWhite);
  const int panel_px = static_cast<int>(write_panel(measure, 0.0, scene));
  const int height_px = std::max(view->height_px, panel_px);
  Canvas canvas = new_canvas(view->width_px + kPanelWidth_px, height_px);
  const int top_px = (height_px - view->height_px) / 2;
  Canvas map = canvas.window(
      {0.0, static_cast<double>(top_px), static_cast<double>(view->width_px), static_cast<double>(view->height_px)});
  draw_layers(map, *view, scene);
  write_panel(canvas, view->width_px, scene);
  return canvas;
}

}  // namespace

std::vector<GapMark> listed_gaps(std::vector<GapMark> gaps) {
  constexpr double kSmallest_m2 = 0.05;
  std::erase_if(gaps, [](const GapMark& gap) { return !(gap.area_m2 >= kSmallest_m2); });
  std::stable_sort(gaps.begin(), gaps.end(), [](const GapMark& a, const GapMark& b) { return a.area_m2 > b.area_m2; });
  return gaps;
}

std::vector<std::pair<std::string, std::string>> gap_rows(const std::vector<GapMark>& listed) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (std::size_t n = 0; n < std::min(listed.size(), kNumberedGaps); ++n) {
    std::array<char, 32> area{};
    std::snprintf(area.data(), area.size(), "%.1f m\xC2\xB2", listed[n].area_m2);
    rows.emplace_back(std::to_string(n + 1) + "  " + listed[n].reason, area.data());
  }
  if (listed.size() > kNumberedGaps) {
    rows.emplace_back("and " + std::to_string(listed.size() - kNumberedGaps) + " more", "");
  }
  return rows;
}

Result<Image> draw_map(const MapScene& scene, const MapPictureOptions& options) {
  const auto pixels = [](int width_px, int height_px) { return Canvas(width_px, height_px, look::kUnknown); };
  return draw_scene(scene, options, pixels).map([](const Canvas& canvas) { return canvas.image(); });
}

Result<std::string> map_svg(const MapScene& scene, const MapPictureOptions& options) {
  const auto shapes = [](int width_px, int height_px) { return Canvas::vector(width_px, height_px, look::kUnknown); };
  return draw_scene(scene, options, shapes).map([](Canvas&& canvas) { return canvas.svg(); });
}

}  // namespace seeker::image
