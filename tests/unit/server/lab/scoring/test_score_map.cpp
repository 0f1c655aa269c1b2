#include "server/lab/scoring/score_map.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/image/map_server.hpp"
#include "server/lab/scoring/score_walls.hpp"
#include "server/lab/slam/slam_command.hpp"
#include "tests/support/data.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

class ScoreMap : public LabFiles {};

/// Two rooms of different size with a passage: looks like itself in one pose only.
const std::vector<std::pair<Point2, Point2>> kBuilding = {
    {{0.0, 0.0}, {8.0, 0.0}}, {{8.0, 0.0}, {8.0, 3.0}}, {{8.0, 3.0}, {5.0, 3.0}}, {{5.0, 3.0}, {5.0, 7.0}},
    {{5.0, 7.0}, {0.0, 5.0}}, {{0.0, 5.0}, {0.0, 0.0}}, {{3.0, 0.0}, {3.0, 2.0}}};

/// The building as occupancy, 5 cm cells, with unknown space around it.
Grid<std::uint8_t> building_map() {
  GridFrame frame;
  frame.origin = {-2.0, -3.0};
  Grid<std::uint8_t> map(frame, 260, 260, 255);
  for (double x = 0.1; x < 4.9; x += 0.05) {
    for (double y = 0.1; y < 4.9; y += 0.05) {
      map[frame.cell_of({x, y})] = 0;
    }
  }
  Walls walls;
  walls.segments = kBuilding;
  for (const Point2& point : sample_walls(walls, 0.01)) {
    map[frame.cell_of(point)] = 254;
  }
  return map;
}

TEST(Walls, OfGeoJsonAreTakenWhereverTheyStand) {
  const auto walls = parse_geojson_walls(R"({"type": "FeatureCollection", "name": "map", "features": [
    {"type": "Feature", "properties": {"id": 1}, "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 0], [1, 2.5]]}},
    {"type": "Feature", "properties": null, "geometry": null},
    {"type": "Feature", "geometry": {"type": "MultiLineString", "coordinates": [[[5, 5], [6, 6]], [[7, 7], [8, 8]]]}},
    {"type": "Feature", "geometry": {"type": "Point", "coordinates": [3, 4, 0.5]}},
    {"type": "Feature", "geometry": {"type": "LineString", "coordinates": [[0, "x"], [1, 0]]}},
    {"type": "GeometryCollection", "geometries": [{"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [0, 1], [0, 0]]]}]}]})");
  ASSERT_TRUE(walls) << walls.error().message;
  EXPECT_EQ(walls->segments.size(), 2U + 2U + 3U);
  EXPECT_EQ(walls->segments[1].second, Point2(1.0, 2.5));
  EXPECT_EQ(walls->points, (std::vector<Point2>{{3.0, 4.0}}));
  EXPECT_EQ(walls->bad.count, 1U);
  EXPECT_EQ(walls->bad.examples.front().number, 5U);
}

TEST(Walls, WhatIsNoGeoJsonIsRefused) {
  for (const char* text :
       {"", "{", "[1, 2]", "{}", R"({"type": "Feature"})", R"({"type": "LineString", "coordinates": 5})",
        R"({"type": "LineString", "coordinates": [[1e9, 0], [0, 0]]})", R"({"type": "Topology", "coordinates": []})"}) {
    EXPECT_EQ(parse_geojson_walls(text).error().code, Errc::kParse) << text;
  }
}

TEST(Walls, OfLinesArePointsAndSegmentsAndBadOnesAreCounted) {
  const Walls walls = parse_csv_walls("# x,y\n1,2\n\n0,0,3,4\n1,2,3\nrubbish\n1,nan\n-1, -2.5\r\n");
  EXPECT_EQ(walls.points, (std::vector<Point2>{{1.0, 2.0}, {-1.0, -2.5}}));
  ASSERT_EQ(walls.segments.size(), 1U);
  EXPECT_EQ(walls.bad.count, 3U);
  EXPECT_EQ(walls.bad.examples.front().number, 5U);
  const std::vector<Point2> points = sample_walls(walls, 0.5);
  EXPECT_EQ(points.size(), 2U + 11U);
  EXPECT_EQ(points.back(), Point2(3.0, 4.0));
}

TEST_F(ScoreMap, FindsTheBuildingFromAnywhereAndMeasuresIt) {
  ASSERT_TRUE(image::write_map_server(folder() / "building", building_map()));
  const auto reference = read_ros_map(folder() / "building.yaml");
  ASSERT_TRUE(reference) << reference.error().message;
  const Pose2 reference_T_map{12.0, -4.0, 2.0};
  Walls walls;
  for (const auto& [a, b] : kBuilding) {
    walls.segments.emplace_back(inverse(reference_T_map) * a, inverse(reference_T_map) * b);
  }
  const auto score = score_map(sample_walls(walls, 0.05), *reference);
  ASSERT_TRUE(score) << score.error().message;
  EXPECT_THAT(score->reference_T_map, testing::Pose2Near(reference_T_map, 0.05, 0.01));
  EXPECT_LT(score->median_m, 0.03);
  EXPECT_GT(score->near_share, 0.95);
}

TEST_F(ScoreMap, SeesAWallThatIsOff) {
  const RosMap reference = [] {
    const Grid<std::uint8_t> map = building_map();
    RosMap value{Grid<std::uint8_t>(map.frame(), map.width(), map.height()),
                 Grid<std::uint8_t>(map.frame(), map.width(), map.height(), 1)};
    for (std::size_t k = 0; k < map.cells().size(); ++k) {
      value.occupied.cells()[k] = map.cells()[k] == 254 ? 1 : 0;
    }
    return value;
  }();
  Walls truth;
  truth.segments = kBuilding;
  Walls walls = truth;
  for (auto& [a, b] : walls.segments) {
    a.y() *= 1.06;  // stretched: 7 m are 42 cm too long
    b.y() *= 1.06;
  }
  MapScoreParams params;
  params.initial = Pose2{};
  const auto right = score_map(sample_walls(truth, 0.05), reference, params);
  const auto wrong = score_map(sample_walls(walls, 0.05), reference, params);
  ASSERT_TRUE(right && wrong);
  EXPECT_GT(wrong->p90_m, 0.1);
  EXPECT_GT(wrong->p90_m, 3.0 * right->p90_m);
  EXPECT_EQ(score_map({}, reference).error().code, Errc::kInvalidArgument);
}

TEST_F(ScoreMap, RefusesWhatIsNoMap) {
  EXPECT_EQ(read_ros_map(folder() / "none.yaml").error().code, Errc::kNotFound);
  EXPECT_EQ(read_ros_map(write("a.yaml", "image: none.pgm\n")).error().code, Errc::kNotFound);
  EXPECT_FALSE(read_ros_map(write("b.yaml", "resolution: 0.05\n")));
  (void)write("white.pgm", std::string("P5\n2 2\n255\n") + std::string(4, '\xff'));
  EXPECT_EQ(read_ros_map(write("c.yaml", "image: white.pgm\n")).error().code, Errc::kNotReady);
  EXPECT_FALSE(read_ros_map(write("d.yaml", "image: white.pgm\norigin: [0, 0, 1.5]\n")));
  EXPECT_EQ(read_walls(write("empty.csv", "# nothing\n")).error().code, Errc::kParse);
}

TEST_F(ScoreMap, TheWallsOfARealRunLieOnTheMapOfTheirBuilding) {
  SEEKER_REQUIRE_DATA(log, "lidar/rplidar_a1/scans.csv.gz");
  SEEKER_REQUIRE_DATA(yaml, "lidar/rplidar_a1/mac_1st_floor_final.yaml");
  SlamOptions slam;
  slam.log = log;
  slam.out = folder() / "out";
  slam.config = testing::source_file("config");
  std::ostringstream out;
  ASSERT_TRUE(run_slam_command(slam, out));
  ScoreMapOptions options;
  options.walls = slam.out / "walls.csv";
  options.map_yaml = yaml;
  options.params.initial = Pose2{6.9, -8.3, 1.75};
  options.json = true;
  std::ostringstream score;
  const Status done = run_score_map(options, score, out);
  ASSERT_TRUE(done) << done.error().message;
  const std::string text = score.str();
  const std::size_t at = text.find("\"median_m\": ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(std::stod(text.substr(at + 12)), 0.08);
}

}  // namespace
}  // namespace seeker::lab
