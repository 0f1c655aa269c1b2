#include <gtest/gtest.h>

#include "server/protocols/p2os/pioneer_model.hpp"

namespace seeker::p2os {
namespace {

TEST(P2osPioneerModel, ABoardOfTheOldKindCountsAboutHalfMillimetres) {
  EXPECT_DOUBLE_EQ(find_pioneer_model("p3dx")->distance_unit_m, 0.485e-3);
  EXPECT_DOUBLE_EQ(find_pioneer_model("p3at")->distance_unit_m, 0.465e-3);
  EXPECT_DOUBLE_EQ(find_pioneer_model("p3dx-sh")->distance_unit_m, 1e-3);
  EXPECT_DOUBLE_EQ(find_pioneer_model("p3at-sh")->distance_unit_m, 1e-3);
}

TEST(P2osPioneerModel, TheSlowerModelHasFourWheelsAndItsOwnTrack) {
  EXPECT_DOUBLE_EQ(find_pioneer_model("p3at")->v_max_m_s, 1.2);
  EXPECT_DOUBLE_EQ(find_pioneer_model("p3at")->rotation_rad_per_m, 3.4);
  EXPECT_DOUBLE_EQ(find_pioneer_model("p3dx")->v_max_m_s, 2.2);
  EXPECT_DOUBLE_EQ(find_pioneer_model("p3dx")->rotation_rad_per_m, 5.6);
}

TEST(P2osPioneerModel, TheSonarsLieMirroredAboutTheAxisOfTheBase) {
  for (const char* subclass : {"p3dx", "p3at-sh"}) {
    const auto& poses = find_pioneer_model(subclass)->base_T_sonar;
    ASSERT_EQ(poses.size(), 2 * kArraySonars);
    for (std::size_t k = 0; k < kArraySonars; ++k) {
      for (const std::size_t first : {std::size_t{0}, kArraySonars}) {
        const Pose2& left = poses[first + k];
        const Pose2& right = poses[first + kArraySonars - 1 - k];
        EXPECT_DOUBLE_EQ(left.x_m, right.x_m);
        EXPECT_DOUBLE_EQ(left.y_m, -right.y_m);
        EXPECT_DOUBLE_EQ(left.theta_rad, -right.theta_rad);
      }
    }
  }
}

TEST(P2osPioneerModel, AFrontSonarOfTheManualHasItsPose) {
  const Pose2 pose = find_pioneer_model("p3dx-sh")->base_T_sonar[1];
  EXPECT_DOUBLE_EQ(pose.x_m, 0.114);
  EXPECT_DOUBLE_EQ(pose.y_m, 0.119);
  EXPECT_DOUBLE_EQ(pose.theta_rad, deg_to_rad(50.0));
}

TEST(P2osPioneerModel, AnEquippedBaseOfTheNewBoardHasTheUnitsOfTheBoard) {
  EXPECT_EQ(find_pioneer_model("p3dx-sh-lms1xx"), find_pioneer_model("p3dx-sh"));
}

TEST(P2osPioneerModel, AnUnknownSubclassIsNotGuessed) {
  EXPECT_EQ(find_pioneer_model("p3dx-x"), nullptr);
  EXPECT_EQ(find_pioneer_model("p3dx-shx"), nullptr);
  EXPECT_EQ(find_pioneer_model("peoplebot-sh"), nullptr);
  EXPECT_EQ(find_pioneer_model(""), nullptr);
  EXPECT_EQ(known_subclasses(), "p3dx, p3dx-sh, p3at, p3at-sh");
}

}  // namespace
}  // namespace seeker::p2os
