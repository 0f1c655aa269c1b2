// The settings of components while the robot runs: as strict as a robot file.

#include <algorithm>

#include <gtest/gtest.h>

#include "server/app/composition/robot_assembly.hpp"
#include "tests/support/data.hpp"

namespace seeker::app {
namespace {

class LiveOptionsTest : public ::testing::Test {
 protected:
  LiveOptionsTest() {
    const RobotOptions options = load_robot_options(testing::source_file("config/robots/sim.yaml")).value();
    configuration = assemble(options).value().parts.configuration;
  }
  [[nodiscard]] Error refusal(const std::string& component, const std::string& assignment) const {
    const Result<SettingChange> change = configuration->read(component, {assignment});
    return change ? Error{} : change.error();
  }
  [[nodiscard]] std::string value(const std::string& component, const std::string& key) const {
    for (const api::ComponentSetting& setting : configuration->settings(component)) {
      if (setting.key == key) {
        return setting.value;
      }
    }
    return "";
  }

  std::shared_ptr<Configuration> configuration;
};

TEST_F(LiveOptionsTest, AChangeIsReadAndKeptInTwoSteps) {
  const Result<SettingChange> change = configuration->read("safety", {"max_v_m_s=0.25", "clearance.horizon_m=2"});
  ASSERT_TRUE(change) << change.error().message;
  EXPECT_EQ(change->loop->safety.max_v_m_s, 0.25);
  ASSERT_EQ(change->changed.size(), 2U);
  EXPECT_EQ(change->changed.front(),
            (api::ComponentSetting{"max_v_m_s", "0.25", "loop.safety.max_v_m_s", api::SettingEffect::kNow}));
  EXPECT_EQ(value("safety", "max_v_m_s"), "0.75") << "not kept yet";
  change->keep();
  EXPECT_EQ(value("safety", "max_v_m_s"), "0.25");
}

TEST_F(LiveOptionsTest, RefusalsNameThePathInTheRobotFileAndTheReason) {
  Error error = refusal("safety", "max_v_m_s=fast");
  EXPECT_EQ(error.code, Errc::kInvalidArgument);
  EXPECT_NE(error.message.find("loop.safety.max_v_m_s: expected a number, got 'fast'"), std::string::npos)
      << error.message;
  error = refusal("lidar", "period_s=0");
  EXPECT_NE(error.message.find("sim.devices.lidar_period_s: must be above 0"), std::string::npos) << error.message;
  error = refusal("safety", "max_w=1");
  EXPECT_NE(error.message.find("no setting 'max_w'; there are: max_v_m_s"), std::string::npos) << error.message;
  error = refusal("recogniser", "templates.accept_ncc=7");
  EXPECT_NE(error.message.find("search.recogniser"), std::string::npos) << error.message;
  error = refusal("map", "max_range_m=5");
  EXPECT_EQ(error.code, Errc::kRefused);
  EXPECT_NE(error.message.find("occupancy.max_range_m takes effect after a restart only"), std::string::npos)
      << error.message;
  EXPECT_EQ(refusal("safety", "max_v_m_s").code, Errc::kInvalidArgument);
  EXPECT_EQ(refusal("safety", "max_v_m_s=&a [*a]").code, Errc::kInvalidArgument);
  EXPECT_EQ(refusal("camera", "x=1").code, Errc::kInvalidArgument) << "it has no settings";
}

TEST_F(LiveOptionsTest, OnlyWhatHasChangedIsPassedOn) {
  const Result<SettingChange> rate = configuration->read("lidar", {"period_s=0.4"});
  ASSERT_TRUE(rate) << rate.error().message;
  EXPECT_EQ(rate->period, seconds(0.4));
  EXPECT_FALSE(rate->recogniser);
  const Result<SettingChange> threshold = configuration->read("recogniser", {"templates.accept_ncc=0.9"});
  ASSERT_TRUE(threshold) << threshold.error().message;
  ASSERT_TRUE(threshold->recogniser);
  EXPECT_EQ(threshold->recogniser->templates.accept_ncc, 0.9);
  EXPECT_FALSE(threshold->period);
}

TEST_F(LiveOptionsTest, ExchangesNameTheTypesThereAre) {
  const Result<Exchange> pose = configuration->exchange("pose", "scan_match");
  ASSERT_TRUE(pose) << pose.error().message;
  EXPECT_NE(pose->estimator, nullptr);
  const auto message = [&](const std::string& component, const std::string& type) {
    const Result<Exchange> exchange = configuration->exchange(component, type);
    return exchange ? "" : exchange.error().message;
  };
  EXPECT_NE(message("pose", "magic").find("odometry, scan_match, line_slam, landmarks"), std::string::npos);
  EXPECT_NE(message("pose", "landmarks").find("database"), std::string::npos) << "none is named";
  EXPECT_NE(message("planner", "magic").find("by_mission, paper, plan"), std::string::npos);
  EXPECT_EQ(message("recogniser", "features"), "");
  EXPECT_NE(message("base", "sim").find("only pose, recogniser and planner"), std::string::npos);
}

TEST(Connections, ASafetySupervisorWithoutAnySensorIsRefused) {
  const auto file = testing::source_file("config/robots/sim.yaml");
  const RobotOptions blind =
      load_robot_options(file, {"connections.safety.scan=none", "connections.safety.echoes=none"}).value();
  const Result<Assembly> refused = assemble(blind);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("connections.safety"), std::string::npos) << refused.error().message;
  const Result<RobotOptions> wrong = load_robot_options(file, {"connections.pose.scan=radar"});
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("'radar' is not one of lidar, none"), std::string::npos)
      << wrong.error().message;
}

TEST(RobotOptions, RefuseLimitsOfSimilarPicturesOutOfRange) {
  const Result<RobotOptions> options =
      parse_robot_options("{fleet: {merge: {pictures: {views: {min_share: 1.5}}}}}", "robot.yaml", {});
  ASSERT_TRUE(options) << options.error().message;
  const Status valid = validate(*options);
  ASSERT_FALSE(valid);
  EXPECT_NE(valid.error().message.find("fleet.merge.pictures"), std::string::npos) << valid.error().message;
}

}  // namespace
}  // namespace seeker::app
