#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "server/protocols/lms200/baud_rate.hpp"
#include "server/protocols/lms200/measuring.hpp"

namespace seeker::lms200 {
namespace {

constexpr std::array kModes{MeasuringMode::k8mFieldsAbDazzle, MeasuringMode::k8mReflector, MeasuringMode::k8mFieldsAbc,
                            MeasuringMode::k16mReflector,     MeasuringMode::k16mFieldsAb, MeasuringMode::k32mReflector,
                            MeasuringMode::k32mFieldA,        MeasuringMode::k32m};
constexpr std::array kUnits{Unit::kCentimetre, Unit::kMillimetre, Unit::kDecimetre};

TEST(Lms200Measuring, TheCodesOf13BitsBeginAt8183) {
  EXPECT_EQ(first_special_value(MeasuringMode::k8mReflector), 8183);
  EXPECT_FLOAT_EQ(range_of(8182, MeasuringMode::k8mReflector, Unit::kMillimetre), 8.182F);
  for (const std::uint16_t code : std::initializer_list<std::uint16_t>{8183, 8189, 8190, 8191}) {
    EXPECT_EQ(range_of(code, MeasuringMode::k8mReflector, Unit::kMillimetre), kNoReturn);
  }
}

TEST(Lms200Measuring, TheNineHighestValuesOfEachModeAreNoReturns) {
  for (const MeasuringMode mode : kModes) {
    const unsigned top = (1U << value_bits(mode)) - 1U;
    EXPECT_EQ(range_of(static_cast<std::uint16_t>(top), mode, Unit::kMillimetre), kNoReturn);
    EXPECT_EQ(range_of(static_cast<std::uint16_t>(top - 8), mode, Unit::kMillimetre), kNoReturn);
    EXPECT_LT(range_of(static_cast<std::uint16_t>(top - 9), mode, Unit::kMillimetre), kNoReturn);
  }
}

TEST(Lms200Measuring, ZeroIsNoReturn) {
  EXPECT_EQ(range_of(0, MeasuringMode::k32m, Unit::kCentimetre), kNoReturn);
  EXPECT_EQ(range_of(0xE000, MeasuringMode::k8mReflector, Unit::kCentimetre), kNoReturn);
}

TEST(Lms200Measuring, FlagsAreNotPartOfTheRange) {
  EXPECT_FLOAT_EQ(range_of(0xE000 | 1234, MeasuringMode::k8mReflector, Unit::kMillimetre), 1.234F);
  EXPECT_EQ(flags_of(0xE000 | 1234, MeasuringMode::k8mReflector), 7);
  EXPECT_EQ(flags_of(0x4000 | 1234, MeasuringMode::k16mFieldsAb), 1);
  EXPECT_EQ(flags_of(0x8000 | 1234, MeasuringMode::k32mFieldA), 1);
  EXPECT_EQ(flags_of(0xFFFF, MeasuringMode::k32m), 0);
}

RC_GTEST_PROP(Lms200Measuring, ARangeAndItsFlagsComeBackToHalfAUnit, ()) {
  const MeasuringMode mode = *rc::gen::elementOf(kModes);
  const Unit unit = *rc::gen::elementOf(kUnits);
  const double limit_m = range_limit_m(mode, unit);
  const double range_m = limit_m * *rc::gen::inRange(1, 1000) / 1001.0;
  const auto flags = static_cast<std::uint8_t>(*rc::gen::inRange(0U, 1U << (16 - value_bits(mode))));
  const std::uint16_t word = word_of(static_cast<float>(range_m), flags, mode, unit);
  RC_ASSERT(flags_of(word, mode) == flags);
  const float back = range_of(word, mode, unit);
  RC_ASSERT(range_m < metres(unit) || std::abs(static_cast<double>(back) - range_m) <= metres(unit) / 2.0 + 1e-5);
  RC_ASSERT(range_of(word_of(kNoReturn, flags, mode, unit), mode, unit) == kNoReturn);
  RC_ASSERT(range_of(word_of(static_cast<float>(limit_m), flags, mode, unit), mode, unit) == kNoReturn);
}

TEST(Lms200Measuring, OnlyDocumentedCodesAreUnitsAndModes) {
  int modes = 0;
  int units = 0;
  for (int code = 0; code < 256; ++code) {
    modes += measuring_mode_of(static_cast<std::uint8_t>(code)) ? 1 : 0;
    units += unit_of(static_cast<std::uint8_t>(code)) ? 1 : 0;
  }
  EXPECT_EQ(modes, 9);
  EXPECT_EQ(units, 3);
}

TEST(Lms200Variant, BeamsAnglesAndRotationsAreThoseOfTheScanner) {
  EXPECT_EQ((Variant{180, 50}.beams()), 361U);
  EXPECT_EQ((Variant{180, 100}.beams()), 181U);
  EXPECT_EQ((Variant{100, 25}.beams()), 401U);
  EXPECT_DOUBLE_EQ((Variant{180, 50}.angle_min_rad()), deg_to_rad(-90.0));
  EXPECT_DOUBLE_EQ((Variant{100, 25}.angle_step_rad()), deg_to_rad(0.25));
  EXPECT_EQ((Variant{180, 100}.mirror_rotations()), 1);
  EXPECT_EQ((Variant{180, 50}.mirror_rotations()), 2);
  EXPECT_EQ((Variant{100, 25}.mirror_rotations()), 4);
}

TEST(Lms200Variant, TheScannerHasFive) {
  int variants = 0;
  for (std::uint16_t angle = 0; angle < 400; ++angle) {
    for (std::uint16_t step = 0; step < 200; ++step) {
      variants += is_variant({angle, step}) ? 1 : 0;
    }
  }
  EXPECT_EQ(variants, 5);
  EXPECT_FALSE(is_variant({180, 25}));
}

TEST(Lms200Baud, EachRateHasItsParameter) {
  for (const std::uint32_t baud : baud_rates()) {
    ASSERT_TRUE(baud_mode(baud));
    EXPECT_EQ(baud_of_mode(*baud_mode(baud)), baud);
  }
  EXPECT_EQ(baud_mode(38400), 0x40);
  EXPECT_EQ(baud_mode(9600), 0x42);
  EXPECT_FALSE(baud_mode(115200));
  EXPECT_FALSE(baud_of_mode(0x24));
  EXPECT_EQ(baud_word(38400), 0x8019);
  EXPECT_EQ(baud_word(9600), 0x8067);
}

}  // namespace
}  // namespace seeker::lms200
