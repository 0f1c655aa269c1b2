#include "server/app/missions/travelled_path.hpp"

#include <gmock/gmock.h>

#include "tests/support/matchers.hpp"

namespace seeker::app {
namespace {

using ::testing::ElementsAre;
using testing::Point2Near;

TEST(TravelledPath, LeadsBackOverThinnedPlaces) {
  TravelledPath path;
  for (int k = 0; k <= 30; ++k) {
    path.note(Point2(0.1 * k, 0.0));
  }
  EXPECT_THAT(
      path.backwards(Point2(3.0, 0.0)),
      ElementsAre(Point2Near(Point2(2, 0), 0.11), Point2Near(Point2(1, 0), 0.11), Point2Near(Point2(0, 0), 0.01)));
}

TEST(TravelledPath, LeavesOutTheLoopsInWhichTheRobotCameBack) {
  TravelledPath path;
  for (const Point2& place :
       {Point2(0, 0), Point2(2, 0), Point2(4, 0), Point2(4, 2), Point2(2, 2), Point2(2, 0.1), Point2(2, -3)}) {
    path.note(place);
  }
  EXPECT_EQ(path.backwards(Point2(2, -3)), (std::vector<Point2>{{2, 0}, {0, 0}}));
}

TEST(TravelledPath, MovesWithTheMap) {
  TravelledPath path;
  path.note(Point2(0, 0));
  path.note(Point2(2, 0));
  path.move(Pose2(0.0, 1.0, 0.0));
  EXPECT_EQ(path.backwards(Point2(9, 9)), (std::vector<Point2>{{2, 1}, {0, 1}}));
}

TEST(TravelledPath, StaysBoundedAndKeepsItsBeginningAndItsEnd) {
  TravelledPath path;
  for (int k = 0; k < 5000; ++k) {
    path.note(Point2(2.0 * k, 0.0));
  }
  const std::vector<Point2> way = path.backwards(Point2(-5, 0));
  EXPECT_LE(way.size(), TravelledPath::kMostPlaces);
  EXPECT_EQ(way.front(), Point2(9998, 0));
  EXPECT_EQ(way.back(), Point2(0, 0));
}

}  // namespace
}  // namespace seeker::app
