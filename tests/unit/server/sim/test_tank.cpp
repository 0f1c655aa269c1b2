#include <cmath>

#include "server/sim/tank_renderer.hpp"
#include "tests/unit/server/sim/pixel_patch.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

using testing::make;
using testing::patch_of;
using testing::PixelPatch;
using testing::square_room;

/// A tank of 6 x 6 m with clear water, the robot in its middle and these solids.
World tank(std::vector<TankSolid> solids) {
  World world = square_room(6.0);
  world.solids = std::move(solids);
  world.water.noise = 0.0;
  world.water.beam = 0.0;
  return world;
}

RobotModel with_tank_camera() {
  RobotModel model = without_errors(RobotModel{});
  model.camera = CameraKind::kTank;
  model.lidar.height_m = 0.07;
  return model;
}

/// The pixels that are brighter than floor and walls.
PixelPatch bright(const Image& image) {
  constexpr int kBright = 110;
  return patch_of(image, [](std::uint8_t level) { return level > kBright; });
}

constexpr TankSolid sphere_at(double x_m, double y_m) { return {SolidKind::kSphere, {x_m, y_m, 0.0}, 0.1, 1.0, 0.9}; }

TEST(TankCamera, ShowsASolidWhereItsGeometrySays) {
  Simulation simulation = make(tank({sphere_at(1.0, 0.2)}), with_tank_camera());
  const Image image = simulation.camera_image();
  ASSERT_EQ(image.width_px(), kTankWidth_px);
  ASSERT_EQ(image.height_px(), kTankHeight_px);
  const PixelPatch patch = bright(image);
  ASSERT_GT(patch.pixels, 2000);
  // By hand: the middle of the sphere is 1.0 m ahead, 0.2 m to the left and 0.7 m below a camera tilted by 40 degrees.
  const double along = std::cos(deg_to_rad(40.0)) + 0.7 * std::sin(deg_to_rad(40.0));
  const double below = 0.7 * std::cos(deg_to_rad(40.0)) - std::sin(deg_to_rad(40.0));
  // The lamp lights its upper side more than its lower one, so that the bright part is not centred on it.
  const double radius_px = kTankFocal_px * 0.1 / along;
  EXPECT_NEAR(patch.u_px, 320.0 - kTankFocal_px * 0.2 / along, 0.25 * radius_px);
  EXPECT_NEAR(patch.v_px, 240.0 + kTankFocal_px * below / along, 0.25 * radius_px);
}

TEST(TankCamera, ShowsTheEmptyFloorWhereNoSolidIsInView) {
  Simulation behind = make(tank({sphere_at(-1.0, 0.0)}), with_tank_camera());
  EXPECT_EQ(bright(behind.camera_image()).pixels, 0);
}

TEST(TankCamera, AWallHidesWhatStandsBehindIt) {
  World world = tank({sphere_at(1.0, 0.0)});
  World empty = tank({});
  EXPECT_NE(make(world, with_tank_camera()).camera_image(), make(empty, with_tank_camera()).camera_image());
  Wall screen;
  screen.a = {0.6, -1.0};
  screen.b = {0.6, 1.0};
  screen.z_max_m = 1.0;
  world.walls.push_back(screen);
  empty.walls.push_back(screen);
  EXPECT_EQ(make(world, with_tank_camera()).camera_image(), make(empty, with_tank_camera()).camera_image());
}

TEST(TankCamera, NoiseIsThatOfTheRobotsSeed) {
  World world = tank({sphere_at(1.0, 0.0)});
  world.water.noise = 4.0;
  const auto picture = [&](std::uint64_t seed) { return make(world, with_tank_camera(), seed).camera_image(); };
  EXPECT_EQ(picture(1), picture(1));
  EXPECT_NE(picture(1), picture(2));
}

TEST(TankSolids, AreBodiesForLidarSonarAndBase) {
  Simulation simulation = make(tank({sphere_at(1.0, 0.0)}), with_tank_camera());
  const LaserScan scan = simulation.scan();
  const double ahead_m = scan.ranges_m[scan.ranges_m.size() / 2] + scan.base_T_laser.x_m;
  EXPECT_NEAR(ahead_m, 0.9, 0.01);
  simulation.command({0.3, 0.0});
  simulation.advance(std::chrono::seconds(10));
  EXPECT_EQ(simulation.truth().contacts, 1);
  EXPECT_LT(simulation.truth().world_T_base.x_m, 0.9 - simulation.model().radius_m + 0.02);
}

TEST(TankSolids, OutlinesAreTheSolidsOwn) {
  for (const SolidKind shape : kSolidKinds) {
    const TankSolid solid{shape, {2.0, 1.0, 0.5}, 0.2, 1.5, 0.7};
    double signed_area = 0.0;
    const std::vector<Point2> corners = outline(solid);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point2& a = corners[i];
      const Point2& b = corners[(i + 1) % corners.size()];
      signed_area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    const double expected[] = {kPi * 0.04, std::sqrt(3.0) / 4.0 * 0.04, 0.04, kPi * 0.04 * 1.5};
    EXPECT_NEAR(signed_area, expected[static_cast<std::size_t>(shape)],
                0.02 * expected[static_cast<std::size_t>(shape)])
        << to_string(shape) << ": counter-clockwise, and as large as it is";
  }
}

}  // namespace
}  // namespace seeker::sim
