/// \file
/// Image, random numbers, time and the names of errors.
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/rng.hpp"
#include "common/core/time.hpp"

namespace seeker {
namespace {

TEST(Image, PixelsAreRowByRowFromTheTop) {
  Image image(3, 2, 3);
  image.at(1, 1)[2] = 200;
  EXPECT_EQ(image.data().size(), 18U);
  EXPECT_EQ(image.data()[(1 * 3 + 1) * 3 + 2], 200);
}

TEST(ImageDeathTest, PixelOutsideIsABug) {
  const Image image(3, 2, 1);
  EXPECT_DEATH(static_cast<void>(image.at(3, 0)), "assertion failed");
}

TEST(Image, GreyWeighsGreenMostAndKeepsWhite) {
  Image image(4, 1, 3);
  image.data() = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
  EXPECT_EQ(to_grey(image).data(), (std::vector<std::uint8_t>{76, 150, 29, 255}));
  const Image grey(2, 2, 1, 9);
  EXPECT_EQ(to_grey(grey), grey);
}

TEST(Rng, SameSeedGivesTheSameNumbersOnEveryMachine) {
  Rng rng(5489);
  // The first output of mt19937_64 with its default seed, as the C++ standard's generator defines it.
  EXPECT_EQ(rng.bits(), 14514284786278117030ULL);
}

TEST(Rng, NormalHasItsMeanAndSpread) {
  constexpr std::uint64_t kSeed = 7;
  Rng rng(kSeed);
  constexpr int kDraws = 20000;
  double sum = 0.0;
  double sum2 = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = rng.normal(2.0);
    sum += x;
    sum2 += x * x;
  }
  // Five standard errors.
  EXPECT_NEAR(sum / kDraws, 0.0, 5.0 * 2.0 / std::sqrt(kDraws)) << "seed " << kSeed;
  EXPECT_NEAR(std::sqrt(sum2 / kDraws), 2.0, 5.0 * 2.0 / std::sqrt(2.0 * kDraws)) << "seed " << kSeed;
}

TEST(Rng, ForksOfDifferentPurposesDiffer) {
  Rng a(1);
  Rng b(1);
  Rng c(1);
  EXPECT_EQ(a.fork("lidar").bits(), b.fork("lidar").bits());
  EXPECT_NE(Rng(1).fork("lidar").bits(), c.fork("sonar").bits());
}

RC_GTEST_PROP(Rng, UniformStaysInItsHalfOpenInterval, (std::uint64_t seed)) {
  Rng rng(seed);
  for (int i = 0; i < 100; ++i) {
    const double x = rng.uniform(-2.0, 3.0);
    RC_ASSERT(x >= -2.0 && x < 3.0);
    RC_ASSERT(rng.below(6) < 6U);
  }
}

TEST(Time, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(seconds(0.1).count(), 100'000'000);
  EXPECT_EQ(seconds(-0.1).count(), -100'000'000);
  EXPECT_EQ(seconds(1.6e-9).count(), 2);
  EXPECT_DOUBLE_EQ(to_seconds(robot_time_s(12.5)), 12.5);
  EXPECT_EQ(robot_time_s(2.0) - robot_time_s(0.5), seconds(1.5));
}

TEST(Result, EveryCodeHasItsOwnName) {
  std::set<std::string> names;
  for (int code = 0; code <= static_cast<int>(Errc::kInternal); ++code) {
    names.insert(std::string(to_string(static_cast<Errc>(code))));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Errc::kInternal) + 1);
}

TEST(Result, ContextGoesInFrontAndKeepsTheCode) {
  const Status status = fail_with_context("world.yaml", Error{Errc::kParse, "line 3"});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error(), (Error{Errc::kParse, "world.yaml: line 3"}));
}

}  // namespace
}  // namespace seeker
