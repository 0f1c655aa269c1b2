#include "common/core/number_in.hpp"

#include <cstdint>

#include <gtest/gtest.h>

namespace seeker {
namespace {

TEST(NumberIn, IsTheWholeText) {
  EXPECT_EQ(number_in<int>("-12"), -12);
  EXPECT_EQ(number_in<double>("2.5e3"), 2500.0);
  for (const char* bad : {"", " 1", "1 ", "1x", "x", "1,5", "+1", "0x10"}) {
    EXPECT_EQ(number_in<int>(bad), std::nullopt) << bad;
    EXPECT_EQ(number_in<double>(bad), std::nullopt) << bad;
  }
}

TEST(NumberIn, FitsItsType) {
  EXPECT_EQ(number_in<std::uint16_t>("65535"), 65535);
  EXPECT_EQ(number_in<std::uint16_t>("65536"), std::nullopt);
  EXPECT_EQ(number_in<std::uint64_t>("-1"), std::nullopt);
  EXPECT_EQ(number_in<double>("1e999"), std::nullopt);
}

TEST(FiniteIn, IsNeitherInfinityNorNan) {
  EXPECT_TRUE(number_in<double>("inf"));
  EXPECT_TRUE(number_in<double>("nan"));
  EXPECT_EQ(finite_in("inf"), std::nullopt);
  EXPECT_EQ(finite_in("-nan"), std::nullopt);
  EXPECT_EQ(finite_in("-0.25"), -0.25);
}

}  // namespace
}  // namespace seeker
