#include "server/slam/local_cloud.hpp"

#include <gtest/gtest.h>

namespace seeker::slam {
namespace {

TEST(LocalCloud, AsksForAKeyframeWhereNoneIsNearWithTheSameHeading) {
  LocalCloud cloud;
  EXPECT_TRUE(cloud.needs_keyframe({}));
  cloud.add({}, {});
  EXPECT_FALSE(cloud.needs_keyframe({0.4, 0.0, 0.0}));
  EXPECT_TRUE(cloud.needs_keyframe({0.6, 0.0, 0.0}));
  EXPECT_FALSE(cloud.needs_keyframe({0.0, 0.0, 0.5}));
  EXPECT_TRUE(cloud.needs_keyframe({0.0, 0.0, 0.7}));
}

TEST(LocalCloud, AsksForOneSoonerWhereTheScanShowsWhatNoneHas) {
  LocalCloud cloud;
  cloud.add({}, {});
  const double known = 0.6;
  EXPECT_FALSE(cloud.needs_keyframe({0.1, 0.0, 0.0}, known)) << "not with each scan";
  EXPECT_TRUE(cloud.needs_keyframe({0.2, 0.0, 0.0}, known));
  EXPECT_TRUE(cloud.needs_keyframe({0.0, 0.0, 0.3}, known));
  EXPECT_FALSE(cloud.needs_keyframe({0.2, 0.0, 0.0}, 0.9));
}

}  // namespace
}  // namespace seeker::slam
