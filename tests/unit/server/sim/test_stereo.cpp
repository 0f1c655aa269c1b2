#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "server/sim/eye_view.hpp"
#include "server/sim/pattern.hpp"
#include "tests/unit/server/sim/pixel_patch.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

using namespace std::chrono_literals;
using testing::make;
using testing::patch_of;
using testing::PixelPatch;
using testing::square_room;

constexpr int kDark = 60;

/// White walls, so that dark boxes can be found in the picture.
World white_room() {
  World world = square_room(10.0);
  for (Wall& wall : world.walls) {
    wall.surface = {0.9, 0.0, 0.1, 0};
    wall.z_max_m = 8.0;
  }
  world.floor = {0.8, 0.0, 0.1, 0};
  world.lighting = Lighting{};
  world.lighting.directional = world.lighting.exposure_jitter = world.lighting.flicker = 0.0;
  return world;
}

World painted_room() {
  World world = white_room();
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    world.walls[i].surface = {0.5, 0.8, 0.15, static_cast<std::uint32_t>(i)};
  }
  world.floor = {0.5, 0.5, 0.2, 9};
  return world;
}

PixelPatch dark_patch(const Image& image) {
  return patch_of(image, [](std::uint8_t level) { return level < kDark; });
}

/// Camera coordinates (left, up, ahead) of a place, by spec S2.3 solved for them; independent of the renderer.
struct InEye {
  double left = 0.0;
  double up = 0.0;
  double ahead = 0.0;
};
InEye in_eye(const Pose2& world_T_base, const StereoModel& m, double right_by_m, double x, double y, double z) {
  const double heading = world_T_base.theta_rad + m.base_T_left_eye.theta_rad;
  const double ex = m.base_T_left_eye.x_m;
  const double ey = m.base_T_left_eye.y_m;
  const double c = std::cos(world_T_base.theta_rad);
  const double s = std::sin(world_T_base.theta_rad);
  const double eye_x = world_T_base.x_m + c * ex - s * ey + right_by_m * std::sin(heading);
  const double eye_y = world_T_base.y_m + s * ex + c * ey - right_by_m * std::cos(heading);
  const double dx = x - eye_x;
  const double dy = y - eye_y;
  return {-dx * std::sin(heading) + dy * std::cos(heading), z - m.height_m,
          dx * std::cos(heading) + dy * std::sin(heading)};
}

TEST(StereoCamera, ShowsASmallBoxWhereAPinholeDoes) {
  for (const double heading : {0.0, 2.3, -1.1}) {
    for (const double bearing : {-0.35, 0.0, 0.3}) {
      World world = white_room();
      const Pose2 start{0.4, -0.3, heading};
      world.starts = {start};
      const double x = start.x_m + 3.0 * std::cos(heading + bearing);
      const double y = start.y_m + 3.0 * std::sin(heading + bearing);
      world.boxes.push_back({Pose2{x, y, heading + bearing}, 0.02, 0.1, 1.2, 1.3, {0.0, 0.0, 0.1, 0}, {}});
      Simulation s = make(world, without_errors(RobotModel{}));
      const StereoModel& m = s.model().stereo;
      const StereoFrame frame = s.stereo_pair();
      for (const auto& [image, right_by_m] : {std::pair{&frame.left, 0.0}, {&frame.right, m.geometry.baseline_m}}) {
        const PixelPatch patch = dark_patch(*image);
        ASSERT_GT(patch.pixels, 400);
        const InEye p = in_eye(start, m, right_by_m, x, y, 1.25);
        const double f = m.geometry.focal_px;
        EXPECT_NEAR(patch.u_px, m.geometry.centre_u_px - f * p.left / p.ahead, 0.6) << heading << " " << bearing;
        EXPECT_NEAR(patch.v_px, m.geometry.centre_v_px - f * p.up / p.ahead, 0.6) << heading << " " << bearing;
      }
    }
  }
}

TEST(StereoCamera, TopsFloorsAndUndersidesHaveTheirPlaces) {
  World world = white_room();
  // A dark table top below the eyes: its far edge at 3.5 m, its near edge at 2.5 m.
  world.boxes.push_back({Pose2{3.0, 0.0, 0.0}, 1.0, 1.0, 0.69, 0.70, {0.0, 0.0, 0.1, 0}, {}});
  Simulation s = make(world, without_errors(RobotModel{}));
  const StereoModel& m = s.model().stereo;
  const Image left = s.stereo_pair().left;
  int first = 0;
  int last = 0;
  for (int v = 0; v < left.height_px(); ++v) {
    if (*left.at(512, v) < kDark) {
      first = first == 0 ? v : first;
      last = v;
    }
  }
  const double drop_px = m.geometry.focal_px * (m.height_m - 0.70);
  EXPECT_NEAR(first, m.geometry.centre_v_px + drop_px / (3.5 - 0.15), 1.0);
  EXPECT_NEAR(last, m.geometry.centre_v_px + m.geometry.focal_px * (m.height_m - 0.69) / (2.5 - 0.15), 1.5);
}

/// Shift of the right picture, to the left, under which a row piece fits best; sub-pixel by a parabola.
double disparity_px(const StereoFrame& frame, int u, int v, int max_px) {
  constexpr int kHalf = 20;
  std::vector<double> cost;
  for (int d = 0; d <= max_px; ++d) {
    double sum = 0.0;
    for (int dv = -kHalf; dv <= kHalf; ++dv) {
      for (int du = -kHalf; du <= kHalf; ++du) {
        const double e = *frame.left.at(u + du, v + dv) - *frame.right.at(u + du - d, v + dv);
        sum += e * e;
      }
    }
    cost.push_back(sum);
  }
  const auto best = static_cast<std::size_t>(std::min_element(cost.begin() + 1, cost.end() - 1) - cost.begin());
  const double curvature = cost[best - 1] - 2.0 * cost[best] + cost[best + 1];
  return static_cast<double>(best) + 0.5 * (cost[best - 1] - cost[best + 1]) / curvature;
}

TEST(StereoCamera, DisparityOfAWallIsFocalLengthTimesBaselineOverRange) {
  for (const double x : {0.0, 2.0, 3.5}) {
    World world = painted_room();
    world.starts = {Pose2{x, 0.0, 0.0}};
    Simulation s = make(world, without_errors(RobotModel{}));
    const StereoGeometry& g = s.model().stereo.geometry;
    const double range_m = 5.0 - x - s.model().stereo.base_T_left_eye.x_m;
    const StereoFrame frame = s.stereo_pair();
    EXPECT_NEAR(disparity_px(frame, 512, 300, 90), g.focal_px * g.baseline_m / range_m, 0.2);
  }
}

TEST(StereoCamera, NearThingsHideFarOnes) {
  World world = white_room();
  world.boxes.push_back({Pose2{4.0, 0.0, 0.0}, 0.1, 0.5, 0.0, 1.5, {0.0, 0.0, 0.1, 0}, {}});
  Simulation open = make(world, without_errors(RobotModel{}));
  EXPECT_GT(dark_patch(open.stereo_pair().left).pixels, 10000);
  world.boxes.push_back({Pose2{2.0, 0.0, 0.0}, 0.1, 1.0, 0.0, 2.0, {0.9, 0.0, 0.1, 0}, {}});
  Simulation hidden = make(world, without_errors(RobotModel{}));
  EXPECT_EQ(dark_patch(hidden.stereo_pair().left).pixels, 0);
}

TEST(StereoCamera, SamePicturesFromTheSameSeedAndOthersFromAnother) {
  const World world = painted_room();
  const auto play = [&](std::uint64_t seed) {
    Simulation s = make(world, RobotModel{}, seed);
    s.command({0.3, 0.2});
    s.advance(1s);
    return s.stereo_pair();
  };
  EXPECT_EQ(play(3), play(3));
  EXPECT_NE(play(3), play(4));
}

TEST(StereoCamera, OtherSensorsDoNotNoticeThatPicturesAreTaken) {
  const World world = painted_room();
  Simulation with = make(world);
  Simulation without = make(world);
  (void)with.stereo_pair();
  EXPECT_EQ(with.scan(), without.scan());
  EXPECT_EQ(with.omni_image(), without.omni_image());
}

TEST(StereoCamera, NoiseHasTheModelsSizeAndTheEyesDoNotShareIt) {
  World world = white_room();
  RobotModel model = without_errors(RobotModel{});
  model.stereo.noise_sigma = 2.0;
  Simulation s = make(world, model);
  const StereoFrame a = s.stereo_pair();
  const StereoFrame b = s.stereo_pair();
  double left2 = 0.0;
  double right2 = 0.0;
  double product = 0.0;
  int count = 0;
  for (int v = 100; v < 300; ++v) {
    for (int u = 100; u < 900; ++u) {
      const double l = *a.left.at(u, v) - *b.left.at(u, v);
      const double r = *a.right.at(u, v) - *b.right.at(u, v);
      left2 += l * l;
      right2 += r * r;
      product += l * r;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(left2 / count / 2.0), 2.0, 0.2);
  EXPECT_NEAR(std::sqrt(right2 / count / 2.0), 2.0, 0.2);
  EXPECT_LT(std::abs(product) / std::sqrt(left2 * right2), 0.02);
}

TEST(StereoCamera, ErrorsOfAnEyeShiftAndDarkenItsPicture) {
  World world = white_room();
  world.boxes.push_back({Pose2{3.0, 0.0, 0.0}, 0.02, 0.4, 0.7, 1.1, {0.0, 0.0, 0.1, 0}, {}});
  RobotModel model = without_errors(RobotModel{});
  const StereoFrame straight = make(world, model).stereo_pair();
  model.stereo.left.shift_u_px = 3.0;
  model.stereo.left.shift_v_px = -2.0;
  model.stereo.left.vignetting = 0.3;
  const StereoFrame off = make(world, model).stereo_pair();
  EXPECT_EQ(off.right, straight.right);
  EXPECT_NEAR(dark_patch(off.left).u_px - dark_patch(straight.left).u_px, 3.0, 0.1);
  EXPECT_NEAR(dark_patch(off.left).v_px - dark_patch(straight.left).v_px, -2.0, 0.1);
  EXPECT_NEAR(*off.left.at(5, 5) / static_cast<double>(*straight.left.at(5, 5)), 0.7, 0.02);
}

TEST(Pattern, IsTheSameFromEveryTileAndOtherEverywhereElse) {
  Pattern once;
  Pattern again;
  const PatternScale scale = PatternScale::make(5, 0.1);
  const PatternScale other = PatternScale::make(6, 0.1);
  double alike = 0.0;
  double shifted = 0.0;
  double power = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double x = 0.013 * n - 20.0;
    const double y = 0.0071 * n - 3.0;
    const double value = static_cast<double>(once.at(scale, x, y, 1));
    power += value * value;
    alike += value * static_cast<double>(once.at(other, x, y, 1));
    shifted += value * static_cast<double>(once.at(scale, x + 7.68, y, 1));
  }
  for (int n = 3999; n >= 0; n -= 7) {  // in another order
    EXPECT_EQ(once.at(scale, 0.013 * n, 0.0071 * n, 1), again.at(scale, 0.013 * n, 0.0071 * n, 1));
  }
  EXPECT_GT(power / 4000, 0.05);
  EXPECT_LT(std::abs(alike), 0.1 * power);
  EXPECT_LT(std::abs(shifted), 0.1 * power);
}

TEST(Pattern, LevelsAreTheSamePictureLessItsFinestDetail) {
  Pattern pattern;
  const PatternScale scale = PatternScale::make(5, 0.1);
  double finest = 0.0;
  double coarser = 0.0;
  double power = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double x = 0.0131 * n;
    const double y = 2.0 + 0.0071 * n;
    const auto at = [&](int level) { return static_cast<double>(pattern.at(scale, x, y, level)); };
    power += at(0) * at(0);
    finest += (at(0) - at(1)) * (at(0) - at(1));
    coarser += (at(0) - at(3)) * (at(0) - at(3));
  }
  EXPECT_LT(finest, 0.05 * power);
  EXPECT_LT(coarser, 0.3 * power);
  EXPECT_GT(coarser, finest);
}

TEST(Pattern, ResolvesThePixelsOfANearWall) {
  const PatternScale scale = PatternScale::make(1, 0.25);
  EXPECT_EQ(scale.level_of(0.0006), 0);
  EXPECT_LE(1.0 / scale.texels_per_m, 0.0006);
  for (const double footprint_m : {0.0012, 0.003, 0.01}) {
    const double texel_m = std::ldexp(1.0 / scale.texels_per_m, scale.level_of(footprint_m));
    EXPECT_LE(texel_m, footprint_m);
    EXPECT_GT(texel_m, footprint_m / 2.0);
  }
}

}  // namespace
}  // namespace seeker::sim
