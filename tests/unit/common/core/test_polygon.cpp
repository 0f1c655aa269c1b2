#include "common/core/polygon.hpp"

#include <gtest/gtest.h>

namespace seeker {
namespace {

const Polygon kSquare{{0, 0}, {2, 0}, {2, 2}, {0, 2}};

TEST(Polygon, SquareIsAcceptedAndContainsItsCentre) {
  EXPECT_TRUE(validate_polygon(kSquare));
  EXPECT_TRUE(contains(kSquare, {1, 1}));
  EXPECT_FALSE(contains(kSquare, {3, 1}));
  EXPECT_DOUBLE_EQ(signed_area_m2(kSquare), 4.0);
  EXPECT_DOUBLE_EQ(distance_to_edge_m(kSquare, {1.0, 0.5}), 0.5);
}

TEST(Polygon, BowTieIsRefusedWithTheEdges) {
  const Status status = validate_polygon({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, Errc::kInvalidArgument);
  EXPECT_NE(status.error().message.find("crosses itself"), std::string::npos);
}

TEST(Polygon, TwoCornersNanAndZeroAreaAreRefused) {
  EXPECT_FALSE(validate_polygon({{0, 0}, {1, 1}}));
  EXPECT_FALSE(validate_polygon({{0, 0}, {1, std::nan("")}, {1, 0}}));
  EXPECT_FALSE(validate_polygon({{0, 0}, {1, 1}, {2, 2}}));
}

}  // namespace
}  // namespace seeker
