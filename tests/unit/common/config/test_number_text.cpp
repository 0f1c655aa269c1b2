#include "common/config/number_text.hpp"

#include <gtest/gtest.h>

namespace seeker::config {
namespace {

TEST(NumberText, WhatIsNoFiniteNumberIsRefusedByEveryCheck) {
  for (const char* bad : {"", "nan", "-nan", "inf", "-inf", "1e999", "3s", "three", "1,5", " 1", "+", "++1"}) {
    for (const auto check : {finite_number, number_above_zero, number_from_zero}) {
      EXPECT_NE(check(bad), "") << bad;
    }
  }
}

TEST(NumberText, SaysWhatTheNumberMustBe) {
  EXPECT_EQ(number_above_zero("0"), "must be a number above 0, not '0'");
  EXPECT_EQ(number_from_zero("-1"), "must be a number, 0 or above, not '-1'");
  EXPECT_EQ(finite_number("nan"), "must be a number, not 'nan'");
  EXPECT_EQ(number_above_zero("0.25"), "");
  EXPECT_EQ(number_from_zero("0"), "");
  EXPECT_EQ(finite_number("-3.5e1"), "");
  EXPECT_EQ(finite_number("+90"), "");
}

}  // namespace
}  // namespace seeker::config
