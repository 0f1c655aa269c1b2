// Measured with the feature detector that others use: pictures must not be easier than real ones (vision.md 4.5).
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/features2d.hpp>

#include "server/options/world_options.hpp"
#include "server/sim/placement.hpp"
#include "tests/support/data.hpp"
#include "tests/support/quantile.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

Features detect(Image image) {
  constexpr double kContrast = 0.04;
  Features f;
  const cv::Mat picture(image.height_px(), image.width_px(), CV_8U, image.data().data());
  cv::SIFT::create(0, 3, kContrast)->detectAndCompute(picture, {}, f.points, f.descriptors);
  return f;
}

TEST(StereoRealism, KeypointsAreAsManyAsInRealRooms) {
  Result<World> world = options::load_world(seeker::testing::source_file("config/worlds/laboratory.yaml"));
  ASSERT_TRUE(world) << world.error().message;
  Rng rng(7);
  PlacementParams params;
  params.robot_height_m = 1.0;
  World views = *world;
  for (int i = 0; i < 5; ++i) {
    World tried = *world;
    views.starts.push_back(place_start(tried, rng, params).value());
  }
  std::vector<std::size_t> counts;
  for (std::size_t i = 1; i < views.starts.size(); ++i) {
    auto simulation = Simulation::create(views, RobotModel{}, i, i);
    ASSERT_TRUE(simulation) << simulation.error().message;
    counts.push_back(detect(simulation->stereo_pair().left).points.size());
  }
  std::sort(counts.begin(), counts.end());
  EXPECT_LE(counts.back(), 1900U);
  EXPECT_LE(counts[counts.size() / 2], 900U);
  EXPECT_GE(counts[counts.size() / 2], 300U);
}

/// A wall, 5 m ahead of the origin, seen from 2.5 m and from 2.0 m, 8 degrees turned and 0.35 m aside.
World wall_seen_twice(std::uint32_t pattern) {
  World world = testing::square_room(10.0);
  for (Wall& wall : world.walls) {
    wall.z_max_m = 6.0;
    wall.surface = {0.5, 0.4, 0.05, pattern};
  }
  world.starts = {Pose2{2.5, 0.0, 0.0}, Pose2{3.0, 0.35, deg_to_rad(-8.0)}};
  return world;
}

TEST(StereoRealism, MatchesBetweenTwoViewsOfAWallAreAsHardAsMeasured) {
  int visible = 0;
  std::vector<double> errors_px;
  for (std::uint32_t pattern = 1; pattern <= 1; ++pattern) {
    const World world = wall_seen_twice(pattern);
    RobotModel model;
    model.stereo.base_T_left_eye = {};
    const StereoGeometry& g = model.stereo.geometry;
    const Features a = detect(Simulation::create(world, model, pattern, 0)->stereo_pair().left);
    const Features b = detect(Simulation::create(world, model, pattern + 9U, 1)->stereo_pair().left);
    for (std::size_t i = 0; i < a.points.size(); ++i) {
      constexpr double kShift_px = 0.25;  // of this detector (vision.md 1.1)
      constexpr double kRange_m = 2.5;
      const double y = kRange_m * (g.centre_u_px - (a.points[i].pt.x - kShift_px)) / g.focal_px;
      const double z = kRange_m * (g.centre_v_px - (a.points[i].pt.y - kShift_px)) / g.focal_px;
      const Point2 p = inverse(world.starts[1]) * Point2(5.0, y);
      const double u = g.centre_u_px - g.focal_px * p.y() / p.x();
      const double v = g.centre_v_px - g.focal_px * z / p.x();
      constexpr double kBorder_px = 8.0;
      if (u < kBorder_px || v < kBorder_px || u > g.width_px - kBorder_px || v > g.height_px - kBorder_px) {
        continue;
      }
      ++visible;
      double best = 1e9;
      double second = 1e9;
      std::size_t match = 0;
      for (std::size_t j = 0; j < b.points.size(); ++j) {
        const double d = cv::norm(a.descriptors.row(static_cast<int>(i)), b.descriptors.row(static_cast<int>(j)));
        second = std::min(second, std::max(d, best));
        match = d < best ? j : match;
        best = std::min(best, d);
      }
      const double off = std::hypot(b.points[match].pt.x - kShift_px - u, b.points[match].pt.y - kShift_px - v);
      if (best < 0.8 * second && off < 3.0) {
        errors_px.push_back(off);
      }
    }
  }
  ASSERT_GT(visible, 500);
  // The table of vision.md 4.5: 0.70 of the visible key points are matched rightly, 0.20 px apart.
  EXPECT_LT(static_cast<double>(errors_px.size()) / visible, 0.75);
  EXPECT_GT(static_cast<double>(errors_px.size()) / visible, 0.4);
  EXPECT_GT(seeker::testing::quantile(errors_px, 0.5), 0.18);
}

}  // namespace
}  // namespace seeker::sim
