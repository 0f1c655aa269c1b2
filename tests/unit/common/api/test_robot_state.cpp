#include "common/api/robot_state.hpp"

#include <gtest/gtest.h>

namespace seeker::api {
namespace {

TEST(RobotId, NamesAFolderAndNothingElse) {
  for (const char* id : {"r1", "Hall-2_left.b", "7", "-"}) {
    EXPECT_TRUE(validate_robot_id(id)) << id;
  }
  EXPECT_TRUE(validate_robot_id(std::string(64, 'a')));
  for (const char* id : {"", ".", "..", ".hidden", "../../esc", "a/b", "a b", "a\\b", "r\n1", "r\xc3\xa9"}) {
    EXPECT_FALSE(validate_robot_id(id)) << id;
  }
  EXPECT_FALSE(validate_robot_id(std::string(65, 'a')));
  EXPECT_FALSE(validate_robot_id(std::string("a\0b", 3)));
}

}  // namespace
}  // namespace seeker::api
