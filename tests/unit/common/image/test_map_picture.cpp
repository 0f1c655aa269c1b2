#include "common/image/map_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/image/canvas.hpp"
#include "common/image/map_server.hpp"
#include "common/image/map_view.hpp"
#include "common/image/pgm.hpp"
#include "common/image/plot.hpp"
#include "common/image/png.hpp"

namespace seeker::image {
namespace {

constexpr std::uint8_t kFloor = 6;
constexpr std::uint8_t kWallValue = 250;
constexpr std::uint8_t kNothing = 255;

void fill(Grid<std::uint8_t>& grid, const Point2& low, const Point2& high, std::uint8_t value) {
  const CellIndex a = grid.frame().cell_of(low);
  const CellIndex b = grid.frame().cell_of(high);
  for (int j = a.j; j < b.j; ++j) {
    for (int i = a.i; i < b.i; ++i) {
      grid[{i, j}] = value;
    }
  }
}

/// Two rooms joined by a door, 12 m x 7 m, in a larger unknown grid.
MapScene two_rooms() {
  Grid<std::uint8_t> map({Point2(-5.0, -4.0), 0.05}, 384, 320, kNothing);
  fill(map, {-0.1, -0.1}, {12.1, 7.1}, kWallValue);
  fill(map, {0.0, 0.0}, {5.9, 7.0}, kFloor);
  fill(map, {6.05, 0.0}, {12.0, 7.0}, kFloor);
  fill(map, {5.9, 3.0}, {6.05, 4.2}, kFloor);
  fill(map, {8.0, 5.2}, {9.6, 6.0}, kWallValue);
  Grid<std::uint8_t> seen({Point2(0.0, 0.0), 0.2}, 60, 35, kNothing);
  for (std::size_t n = 0; n < seen.cells().size(); ++n) {
    const Point2 p = seen.frame().centre_of(seen.cell(n));
    if (map[map.frame().cell_of(p)] == kFloor) {
      const double share = std::clamp(1.25 - 0.25 * (p - Point2(7.0, 2.5)).norm() + (p.x() < 6 ? 0.6 : 0.0), 0.0, 1.0);
      seen.cells()[n] = static_cast<std::uint8_t>(std::lround(254 * share));
    }
  }
  MapScene scene;
  scene.title = "Search: poster-a";
  scene.facts = {{"outcome", "TARGET_FOUND"}, {"covered", "71.4 of 80.2 m\xC2\xB2"}, {"path", "38.2 m"}};
  scene.occupancy = map;
  scene.evidence = seen;
  scene.gaps = {{Point2(11.4, 6.4), 1.9, "not seen"}, {Point2(8.8, 6.5), 0.6, "unreachable"}};
  scene.searched = {{1.2, 1.2}, {2.0, 1.2}, {2.8, 2.0}, {3.6, 2.8}, {4.4, 3.6}, {5.2, 3.6}, {6.8, 3.6}, {7.6, 2.8}};
  scene.unsearched = {{8.4, 2.8}, {8.4, 2.0}, {7.6, 2.0}};
  scene.unreachable = {{8.4, 5.6}};
  for (int i = 0; i <= 60; ++i) {
    const double x = 1.2 + i * 0.11;
    scene.trajectory.push_back({x, 1.2 + 2.4 * std::pow(std::sin(i * 0.028), 2) - (x > 6 ? 0.2 * (x - 6) : 0), 0.2});
  }
  scene.planned_path = {scene.trajectory.back().translation(), Point2(8.6, 2.6), Point2(9.2, 1.6)};
  scene.robot = Pose2{scene.trajectory.back().x_m, scene.trajectory.back().y_m, -0.6};
  scene.keep_out = {{{9.5, 0.2}, {11.8, 0.2}, {11.8, 1.2}, {9.5, 1.2}}};
  scene.bound = Polygon{{-0.05, -0.05}, {12.05, -0.05}, {12.05, 7.05}, {-0.05, 7.05}};
  Matrix2 covariance;
  covariance << 0.04, 0.015, 0.015, 0.02;
  scene.detections = {{"poster-a", Point2(10.6, 3.4), covariance, scene.robot->translation(), 0.2},
                      {"box", std::nullopt, Matrix2::Zero(), Point2(3.6, 2.8), 2.2}};
  return scene;
}

/// Kept where SEEKER_KEEP_PICTURES names a folder, to be looked at.
void keep(const Image& image, const std::string& name) {
  if (const char* folder = std::getenv("SEEKER_KEEP_PICTURES"); folder != nullptr) {
    EXPECT_TRUE(write_png(std::filesystem::path(folder) / name, image));
  }
}

TEST(MapPicture, ShowsFloorWallsUnknownAndTheMarks) {
  const MapScene scene = two_rooms();
  const auto picture = draw_map(scene);
  ASSERT_TRUE(picture) << picture.error().message;
  keep(*picture, "map.png");
  const auto view = fit_view(scene, {});
  ASSERT_TRUE(view);
  EXPECT_NEAR(view->low.x(), -0.5, 0.06);
  EXPECT_NEAR(view->high.y(), 7.5, 0.06);
  const Canvas canvas(*picture);
  const double above = (picture->height_px() - view->height_px) / 2;
  const auto colour_at = [&](double x, double y) {
    const Point2 p = view->to_px(Point2(x, y));
    return canvas.pixel(static_cast<int>(p.x()), static_cast<int>(p.y() + above));
  };
  EXPECT_LT(colour_at(5.98, 1.0).red, 60);                   // wall between the rooms
  EXPECT_EQ(colour_at(-0.3, 7.4), (Colour{222, 225, 229}));  // outside: unknown
  const Colour well_seen = colour_at(6.5, 1.9);
  const Colour not_seen = colour_at(11.7, 5.4);
  EXPECT_GT(well_seen.green, well_seen.red);
  EXPECT_GT(not_seen.red, not_seen.green);
  EXPECT_EQ(colour_at(10.6, 3.4), (Colour{214, 0, 110}));  // the pin of the target
}

TEST(MapPicture, IsADrawingOfTheSameSizeAndShapes) {
  const MapScene scene = two_rooms();
  const auto picture = draw_map(scene);
  const auto drawing = map_svg(scene);
  ASSERT_TRUE(picture && drawing);
  const auto size = [](int px) { return "=\"" + std::to_string(px) + "px\""; };
  EXPECT_NE(drawing->find("width" + size(picture->width_px()) + " height" + size(picture->height_px())),
            std::string::npos);
  EXPECT_NE(drawing->find("<image"), std::string::npos) << "the grids";
  EXPECT_NE(drawing->find("stroke:rgb(0%,39.215686%,69.803922%)"), std::string::npos) << "the path of the robot";
  EXPECT_NE(drawing->find("fill:rgb(83.921569%,0%,43.137255%)"), std::string::npos) << "the pin of the target";
  EXPECT_EQ(map_svg({}).error().code, Errc::kNotReady);
}

/// In a process of its own: a font is loaded once.
TEST(MapPictureDeathTest, IsDrawnWithTextWhereTheMachineHasNoFont) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto draw_without_fonts = [] {
    ::setenv("SEEKER_FONT", "/nowhere/font.ttf", 1);
    Canvas canvas(100, 30, kWhite);
    canvas.text(Point2(5, 25), "Map", {kBlack, 14.0});
    int letters_px = 0;
    for (int u = 0; u < canvas.width_px(); ++u) {
      letters_px += canvas.pixel(u, 20) == kWhite ? 0 : 1;
    }
    const bool legible = text_width_px("Map", 14.0) > 20.0 && letters_px > 5;
    std::exit(legible && draw_map(two_rooms()) ? 0 : 1);
  };
  EXPECT_EXIT(draw_without_fonts(), ::testing::ExitedWithCode(0), "");
}

TEST(MapPicture, GapsAreNumberedFromTheLargestAndTheRestIsCounted) {
  std::vector<GapMark> gaps{{Point2(1, 1), 0.04, "not seen"}, {Point2(2, 2), 0.5, "cut off"}};
  for (int n = 0; n < 11; ++n) {
    gaps.push_back({Point2(n, 0), 1.0 + n, "not seen"});
  }
  const std::vector<GapMark> listed = listed_gaps(gaps);
  ASSERT_EQ(listed.size(), 12U) << "0.0 m2 is no gap";
  EXPECT_DOUBLE_EQ(listed.front().area_m2, 11.0);
  EXPECT_EQ(listed.back().reason, "cut off");
  const auto rows = gap_rows(listed);
  ASSERT_EQ(rows.size(), 10U);
  EXPECT_EQ(rows.front(), (std::pair<std::string, std::string>("1  not seen", "11.0 m\xC2\xB2")));
  EXPECT_EQ(rows.back().first, "and 3 more");
  EXPECT_EQ(gap_rows({gaps[1]}).size(), 1U);
}

TEST(MapPicture, BareMapAndBareTrackCanBeDrawn) {
  MapScene track;
  track.trajectory = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
  const auto picture = draw_map(track);
  ASSERT_TRUE(picture);
  MapScene map;
  map.occupancy = two_rooms().occupancy;
  EXPECT_TRUE(draw_map(map));
}

TEST(MapPicture, ThinWallsStayWhenTheMapIsDrawnSmall) {
  MapScene scene;
  Grid<std::uint8_t> map({Point2(0.0, 0.0), 0.05}, 1200, 1200, kFloor);
  for (int j = 0; j < 1200; ++j) {
    map[{601, j}] = kWallValue;
  }
  scene.occupancy = map;
  MapPictureOptions options;
  options.largest_side_px = 300;
  const auto picture = draw_map(scene, options);
  ASSERT_TRUE(picture);
  const auto view = fit_view(scene, options);
  ASSERT_TRUE(view);
  const Canvas canvas(*picture);
  const int v = picture->height_px() / 2;
  int dark = 0;
  for (int u = 0; u < view->width_px; ++u) {
    dark += canvas.pixel(u, v).red < 60 ? 1 : 0;
  }
  EXPECT_GE(dark, 1);
}

TEST(MapPicture, NothingToDrawAndAbsurdExtentsAreTypedErrors) {
  const auto nothing = draw_map({});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, Errc::kNotReady);
  MapScene far;
  far.trajectory = {{0, 0, 0}, {1e7, 0, 0}};
  EXPECT_EQ(draw_map(far).error().code, Errc::kTooLarge);
}

TEST(MapPicture, ChartsForTheFigures) {
  Chart chart;
  chart.title = "Bearing error over 20 seeds";
  chart.x_label = "range of the target in m";
  chart.y_label = "error in degrees";
  Series mean{"mean", {}, {}, SeriesStyle::kLineAndPoints};
  Series limit{"limit", {0, 10}, {5, 5}, SeriesStyle::kLine, kRed, LineStyle::kDashed};
  for (int i = 1; i <= 18; ++i) {
    mean.x.push_back(0.5 * i);
    mean.y.push_back(1.2 + 0.25 * i * std::abs(std::sin(i)));
  }
  chart.series = {mean, limit};
  const Image image = draw_chart(chart);
  keep(image, "chart.png");
  EXPECT_EQ(image.width_px(), 900);
  Chart bars;
  bars.title = "Share of floor covered";
  bars.y_label = "share";
  bars.x_names = {"rooms", "office", "loop"};
  bars.series = {{"search", {0, 1, 2}, {0.99, 0.97, 0.95}, SeriesStyle::kBars},
                 {"spiral", {0, 1, 2}, {0.81, 0.62, 0.7}, SeriesStyle::kBars}};
  keep(draw_chart(bars), "bars.png");
}

TEST(MapServer, FilesParseBackToTheSameMap) {
  const MapScene scene = two_rooms();
  const auto prefix = std::filesystem::path(::testing::TempDir()) / ("seeker_map_server_" + std::to_string(::getpid()));
  ASSERT_TRUE(write_map_server(prefix, *scene.occupancy));
  const auto pgm = read_pgm(prefix.string() + ".pgm");
  ASSERT_TRUE(pgm) << pgm.error().message;
  std::ifstream file(prefix.string() + ".yaml");
  std::stringstream yaml;
  yaml << file.rdbuf();
  EXPECT_NE(yaml.str().find("image: '" + prefix.filename().string() + ".pgm'"), std::string::npos);
  EXPECT_NE(yaml.str().find("resolution: 0.05\n"), std::string::npos);
  EXPECT_NE(yaml.str().find("origin: [-5, -4, 0.0]\n"), std::string::npos);
  EXPECT_NE(yaml.str().find("occupied_thresh: 0.65\nfree_thresh: 0.196\n"), std::string::npos);
  // As map_server reads it: p = (255 - grey) / 255; first row on top.
  for (int j = 0; j < pgm->height_px(); ++j) {
    for (int i = 0; i < pgm->width_px(); ++i) {
      const double p = (255 - *pgm->at(i, pgm->height_px() - 1 - j)) / 255.0;
      const std::uint8_t cell = (*scene.occupancy)[{i, j}];
      ASSERT_EQ(p > 0.65, cell == kWallValue);
      ASSERT_EQ(p < 0.196, cell == kFloor);
    }
  }
  std::filesystem::remove(prefix.string() + ".pgm");
  std::filesystem::remove(prefix.string() + ".yaml");
}

TEST(MapServer, EmptyMapIsRefused) {
  EXPECT_EQ(write_map_server("/tmp/never", Grid<std::uint8_t>()).error().code, Errc::kNotReady);
}

RobotTopology robot_with_goal(const std::string& id, const Point2& p_map, const Point2& goal_map) {
  RobotTopology robot;
  robot.robot_id = id;
  robot.map_T_base = {p_map.x(), p_map.y(), 0.0};
  TopologyNode first;
  first.id = 1;
  first.map_T_base = {p_map.x(), p_map.y() + 2.0, 0.0};
  TopologyNode second;
  second.id = 2;
  second.map_T_base = robot.map_T_base;
  second.goals = {{1, goal_map, 2}};
  robot.topology.nodes = {first, second};
  robot.topology.edges = {{1, 2}, {2, 77}};  // one leads to a node that is not there
  robot.target_map = goal_map;
  return robot;
}

TEST(MapPicture, ShowsTheTopologyOfEveryRobotInAColourOfItsOwn) {
  MapScene scene;
  scene.occupancy = two_rooms().occupancy;
  scene.topologies = {robot_with_goal("main", {2.0, 2.0}, {4.0, 2.0}), robot_with_goal("r1", {9.0, 2.0}, {11.0, 2.0})};
  const auto picture = draw_map(scene);
  ASSERT_TRUE(picture) << picture.error().message;
  const Canvas canvas(*picture);
  const auto view = fit_view(scene, {});
  ASSERT_TRUE(view);
  const double top_px = (picture->height_px() - view->height_px) / 2;  // whole pixels, as the map is laid
  for (std::size_t k = 0; k < scene.topologies.size(); ++k) {
    const Point2 node = view->to_px(scene.topologies[k].topology.nodes[0].map_T_base.translation());
    EXPECT_EQ(canvas.pixel(static_cast<int>(node.x()), static_cast<int>(node.y() + top_px)), series_colour(k)) << k;
  }
  const auto drawing = map_svg(scene);
  ASSERT_TRUE(drawing);
  EXPECT_NE(drawing->find("<svg"), std::string::npos);
}

TEST(MapPicture, OfATopologyAloneIsDrawnToo) {
  MapScene scene;
  scene.topologies = {robot_with_goal("main", {2.0, 2.0}, {4.0, 2.0})};
  EXPECT_TRUE(draw_map(scene));
}

}  // namespace
}  // namespace seeker::image
