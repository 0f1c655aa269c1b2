#include "tests/support/fake_robot.hpp"

namespace seeker::testing {

FakeRobotValues default_fake_values() {
  FakeRobotValues v;
  v.info.robot_id = "fake";
  v.info.software_version = "0.1.0";
  v.info.capabilities = {"search", "goto", "camera:omni"};
  v.info.robot_radius_m = 0.25;
  v.status.stamp = robot_time_s(1.0);
  v.status.pose.map_T_base = {1.0, 2.0, 0.5};
  v.status.pose.quality = LocalisationQuality::kLocalised;
  v.components.push_back({"base",
                          "driver",
                          "fake",
                          api::ComponentState::kActive,
                          10.0,
                          "",
                          {{"odometry", "Odometry", true, {"pose.odometry"}, 10.0, std::chrono::milliseconds(20)},
                           {"velocity", "Twist2", false, {}, 0.0, std::nullopt}},
                          api::ComponentLink{48'211, 960, 1043, 3, 12, 2}});
  v.settings["base"] = {{"timeout_s", "0.5", "loop.base_timeout_s", api::SettingEffect::kNow},
                        {"period_s", "0.1", "loop.period_s", api::SettingEffect::kRestart}};
  v.tiles.revision = 4;
  for (int k = 0; k < 4; ++k) {
    OccupancyTile tile;
    tile.index = {k % 2, k / 2};
    tile.revision = static_cast<std::uint64_t>(k) + 1;
    tile.cells.fill(static_cast<std::uint8_t>(k * 80));
    v.tiles.tiles.push_back(tile);
  }
  api::Detection detection;
  detection.id = 1;
  detection.target = "exit-sign";
  detection.score = 0.9;
  detection.position = Point2(3.0, 4.0);
  v.detections.push_back(detection);
  v.trajectory = {
      {robot_time_s(0.1), {0.0, 0.0, 0.0}}, {robot_time_s(0.5), {0.5, 0.0, 0.0}}, {robot_time_s(1.0), {1.0, 2.0, 0.5}}};
  constexpr int kSide_px = 32;
  api::ImageFrame frame;
  frame.camera = "omni";
  frame.frame.image = Image(kSide_px, kSide_px, 1, 128);
  v.cameras.emplace("omni", frame);
  return v;
}

}  // namespace seeker::testing
