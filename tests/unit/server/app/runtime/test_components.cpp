// The registry of components: lifecycle, ports, rates and ages.

#include <gtest/gtest.h>

#include "server/app/runtime/components.hpp"

namespace seeker::app {
namespace {

using api::ComponentState;

class ComponentsTest : public ::testing::Test {
 protected:
  ComponentsTest() {
    components.add("lidar", "driver", "fake", {}, {{"scan", "LaserScan", true}});
    components.add("camera", "driver", "fake", {[this] { return camera; }, [this] { ++stops; }, nullptr},
                   {{"picture", "CameraFrame", true}});
    components.add("pose", "estimator", "fake", {}, {{"scan", "LaserScan", false}, {"pose", "PoseEstimate", true}});
    components.connect("lidar.scan", "pose.scan");
  }
  [[nodiscard]] api::ComponentInfo info(const std::string& name, RobotTime now = robot_time_s(1.0)) const {
    for (api::ComponentInfo& one : components.list(now)) {
      if (one.name == name) {
        return std::move(one);
      }
    }
    return {};
  }

  Components components;
  Status camera;
  int stops = 0;
};

TEST_F(ComponentsTest, OneThatFailsToActivateLeavesTheRestRunning) {
  EXPECT_EQ(info("camera").state, ComponentState::kCreated);
  camera = fail(Errc::kIo, "no such device");
  components.activate_all();
  EXPECT_EQ(info("camera").state, ComponentState::kError);
  EXPECT_EQ(info("camera").last_error, "no such device");
  EXPECT_TRUE(components.stopped("camera"));
  EXPECT_TRUE(components.active("lidar"));
  EXPECT_TRUE(components.active("pose"));
  EXPECT_EQ(components.restart("camera").error().code, Errc::kInternal);
  camera = {};
  ASSERT_TRUE(components.restart("camera"));
  EXPECT_EQ(info("camera").state, ComponentState::kActive);
  EXPECT_EQ(info("camera").last_error, "");
}

TEST_F(ComponentsTest, ADeactivatedOneIsInactiveUntilItIsActivated) {
  components.activate_all();
  ASSERT_TRUE(components.deactivate("camera"));
  EXPECT_EQ(info("camera").state, ComponentState::kInactive);
  EXPECT_EQ(stops, 1);
  ASSERT_TRUE(components.activate("camera"));
  EXPECT_TRUE(components.active("camera"));
  EXPECT_NE(components.activate("radar").error().message.find("lidar, camera, pose"), std::string::npos);
  EXPECT_FALSE(components.stopped("radar")) << "what is not there holds nothing up";
}

TEST_F(ComponentsTest, PortsShowRateAgeAndWhoIsConnected) {
  components.activate_all();
  EXPECT_FALSE(info("lidar").ports.front().age) << "no value yet";
  for (int k = 0; k <= 10; ++k) {
    components.count_output("lidar", "scan", robot_time_s(0.2 * k));
  }
  const api::ComponentPort out = info("lidar", robot_time_s(2.5)).ports.front();
  EXPECT_TRUE(out.output);
  EXPECT_EQ(out.connected, std::vector<std::string>{"pose.scan"});
  EXPECT_NEAR(out.rate_hz, 5.0, 1e-9);
  EXPECT_EQ(out.age, seconds(0.5));
  const api::ComponentPort in = info("pose", robot_time_s(2.5)).ports.front();
  EXPECT_FALSE(in.output);
  EXPECT_EQ(in.type, "LaserScan");
  EXPECT_EQ(in.connected, std::vector<std::string>{"lidar.scan"});
  EXPECT_NEAR(in.rate_hz, 5.0, 1e-9);
  EXPECT_EQ(in.age, out.age);
  EXPECT_TRUE(components.connected("lidar.scan", "pose.scan"));
  EXPECT_FALSE(components.connected("camera.picture", "pose.scan"));
}

}  // namespace
}  // namespace seeker::app
