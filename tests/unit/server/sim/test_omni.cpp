#include <algorithm>

#include <gtest/gtest.h>

#include "server/sim/omni_renderer.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

using namespace std::chrono_literals;
using testing::make;
using testing::square_room;

/// A bright room, so that a black target is the only dark thing between deck and rim.
World bright_room() {
  World world = square_room(10.0);
  for (Wall& wall : world.walls) {
    wall.surface = {0.9, 0.0, 0.1, 0};
  }
  world.floor = {0.8, 0.0, 0.1, 0};
  world.lighting.directional = 0.0;
  world.lighting.exposure_jitter = 0.0;
  world.lighting.flicker = 0.0;
  return world;
}

Target black_target(const Point2& p, double heading_rad) {
  Target target;
  target.name = "black";
  target.world_T_target = {p.x(), p.y(), heading_rad};
  target.picture = Image(8, 16, 1, 0);
  return target;
}

constexpr int kDark = 70;

struct Blob {
  int pixels = 0;
  double bearing_rad = 0.0;
};

/// Mean direction of the dark pixels outside the robot's own deck.
Blob dark_blob(const Image& image, double inner_px) {
  Blob blob;
  double x = 0.0;
  double y = 0.0;
  for (int v = 0; v < image.height_px(); ++v) {
    for (int u = 0; u < image.width_px(); ++u) {
      const double left = 315.0 - u;
      const double up = 240.0 - v;
      const double radius = std::hypot(left, up);
      if (radius > inner_px && radius < 233.0 && *image.at(u, v) < kDark) {
        ++blob.pixels;
        x += up / radius;
        y += left / radius;
      }
    }
  }
  blob.bearing_rad = std::atan2(y, x);
  return blob;
}

TEST(Omni, MirrorProfileAndItsInverseAgree) {
  const OmniModel model;
  double before = -10.0;
  for (double r = 1.0; r < model.rim_px; r += 1.0) {
    const double e = mirror_elevation_rad(model, r);
    EXPECT_NEAR(model.gain_px * std::cos(e) / (model.shape - std::sin(e)), r, 1e-9);
    EXPECT_GT(e, before);
    before = e;
  }
  EXPECT_GT(before, deg_to_rad(15.0));
}

TEST(Omni, TargetAppearsUnderItsTrueBearingInAllDirections) {
  for (int k = 0; k < 8; ++k) {
    for (const double heading : {0.0, 1.1}) {
      World world = bright_room();
      const double bearing = k * kPi / 4.0 + 0.1;
      const double map = bearing + heading;
      world.starts = {Pose2{0.3, -0.2, heading}};
      const Point2 p = world.starts[0].translation() + 2.0 * Point2(std::cos(map), std::sin(map));
      world.targets.push_back(black_target(p, map));
      Simulation s = make(world, without_errors(RobotModel{}));
      const Blob blob = dark_blob(s.omni_image(), 80.0);
      EXPECT_GT(blob.pixels, 300);
      EXPECT_LT(std::abs(rad_to_deg(wrap_angle(blob.bearing_rad - bearing))), 1.0) << "direction " << k;
    }
  }
}

TEST(Omni, FurnitureHidesTheTargetWhenItIsHighEnough) {
  World world = bright_room();
  world.targets.push_back(black_target({3.0, 0.0}, 0.0));
  Simulation open = make(world, without_errors(RobotModel{}));
  const int seen = dark_blob(open.omni_image(), 80.0).pixels;
  ASSERT_GT(seen, 100);
  world.boxes.push_back({Pose2{1.5, 0.0, 0.0}, 0.4, 1.2, 0.0, 0.3, {0.9, 0.0, 0.1, 0}});
  Simulation low = make(world, without_errors(RobotModel{}));
  const int part = dark_blob(low.omni_image(), 80.0).pixels;
  EXPECT_GT(part, seen / 4);
  EXPECT_LT(part, seen);
  world.boxes[0].z_max_m = 1.2;
  Simulation high = make(world, without_errors(RobotModel{}));
  EXPECT_EQ(dark_blob(high.omni_image(), 80.0).pixels, 0);
}

TEST(Omni, FarThingsAreNearTheHorizonAndNearFloorIsInside) {
  World world = bright_room();
  world.targets.push_back(black_target({1.0, 0.0}, 0.0));
  world.targets.push_back(black_target({-4.0, 0.0}, 0.0));
  Simulation s = make(world, without_errors(RobotModel{}));
  const Image image = s.omni_image();
  int lowest_near = 0;
  int lowest_far = 0;
  for (int r = 80; r < 230; ++r) {
    lowest_near = lowest_near == 0 && *image.at(315, 240 - r) < kDark ? r : lowest_near;
    lowest_far = lowest_far == 0 && *image.at(315, 240 + r) < kDark ? r : lowest_far;
  }
  EXPECT_GT(lowest_near, 80);
  EXPECT_GT(lowest_far, lowest_near + 20);
}

TEST(Omni, PicturesHaveTheNoiseOfTheModel) {
  World world = bright_room();
  RobotModel model = without_errors(RobotModel{});
  model.omni.noise_sigma = 2.0;
  Simulation s = make(world, model);
  const Image a = s.omni_image();
  const Image b = s.omni_image();
  double sum2 = 0.0;
  int count = 0;
  for (int v = 40; v < 70; ++v) {  // a piece of wall
    for (int u = 300; u < 330; ++u) {
      const double d = *a.at(u, v) - *b.at(u, v);
      sum2 += d * d;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(sum2 / count / 2.0), 2.0, 0.3);
}

TEST(Omni, TexturedWallsDoNotRepeat) {
  World world = bright_room();
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    world.walls[i].surface = {0.6, 0.3, 0.15, static_cast<std::uint32_t>(i)};
  }
  const Image image = make(world, without_errors(RobotModel{})).omni_image();
  // The same place of the four walls, seen from the middle, looks different.
  int equal = 0;
  for (int d = -40; d <= 40; ++d) {
    const int ahead = *image.at(315 + d, 240 - 170);
    const int behind = *image.at(315 - d, 240 + 170);
    const int left = *image.at(315 - 170, 240 + d);
    equal += std::abs(ahead - behind) < 3 ? 1 : 0;
    equal += std::abs(ahead - left) < 3 ? 1 : 0;
  }
  EXPECT_LT(equal, 60);
}

TEST(Omni, SamePicturesFromTheSameSeedAndOthersFromAnother) {
  World world = bright_room();
  world.targets.push_back(black_target({2.0, 1.0}, 0.4));
  const auto play = [&](std::uint64_t seed) {
    Simulation s = make(world, RobotModel{}, seed);
    s.command({0.3, 0.2});
    s.advance(1s);
    return s.omni_image();
  };
  EXPECT_EQ(play(3), play(3));
  EXPECT_NE(play(3), play(4));
}

}  // namespace
}  // namespace seeker::sim
