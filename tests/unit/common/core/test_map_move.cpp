#include "common/core/map_move.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace seeker {
namespace {

TEST(MapMove, OfNoPiecesMovesNothing) {
  const MapMove move;
  EXPECT_FALSE(move.moves());
  EXPECT_EQ(move * Point2(3.0, 4.0), Point2(3.0, 4.0));
}

TEST(MapMove, TakesAPlaceAsTheNearestPieceMoved) {
  const MapMove move(std::vector<MapMove::Piece>{{{0.0, 0.0}, {}}, {{10.0, 0.0}, {0.0, 2.0, 0.0}}});
  EXPECT_TRUE(move.moves());
  EXPECT_EQ(move * Point2(4.0, 1.0), Point2(4.0, 1.0));
  EXPECT_EQ(move * Point2(6.0, 1.0), Point2(6.0, 3.0));
  EXPECT_EQ(move * Point2(5.0, 0.0), Point2(5.0, 0.0)) << "as near as each other: the first";
  EXPECT_EQ((move * Pose2{9.0, 0.0, 0.3}), (Pose2{9.0, 2.0, 0.3}));
}

Pose2 any_pose() {
  const auto any = [](int most) { return 0.01 * static_cast<double>(*rc::gen::inRange(-most, most)); };
  const double x_m = any(2000);
  const double y_m = any(2000);
  return {x_m, y_m, any(314)};
}

RC_GTEST_PROP(MapMove, OfOnePieceIsThePose, ()) {
  const Pose2 new_T_old = any_pose();
  const Pose2 old_T_x = any_pose();
  RC_ASSERT((MapMove(new_T_old) * old_T_x) == new_T_old * old_T_x);
  RC_ASSERT(distance_m(inverse(MapMove(new_T_old)) * (MapMove(new_T_old) * old_T_x), old_T_x) < 1e-9);
}

TEST(MapMove, InverseLeadsBackAwayFromWherePiecesMeet) {
  const MapMove move(std::vector<MapMove::Piece>{{{0.0, 0.0}, {0.1, 0.0, 0.02}}, {{20.0, 0.0}, {0.0, 1.0, -0.1}}});
  const MapMove back = inverse(move);
  for (const Point2& p : {Point2(1.0, 2.0), Point2(-3.0, 0.0), Point2(19.0, 4.0), Point2(25.0, -2.0)}) {
    EXPECT_LT((back * (move * p) - p).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace seeker
