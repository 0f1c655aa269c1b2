#include "common/core/natural_order.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace seeker {
namespace {

TEST(NaturalOrder, NumbersGoByTheirValue) {
  std::vector<std::string> names{"p10", "p9", "p010", "p1", "p", "q0", "p10b", "p10a", "p1x2", "p1x10"};
  std::sort(names.begin(), names.end(), [](const auto& a, const auto& b) { return natural_less(a, b); });
  EXPECT_EQ(names, (std::vector<std::string>{"p", "p1", "p1x2", "p1x10", "p9", "p010", "p10", "p10a", "p10b", "q0"}));
}

TEST(NaturalOrder, IsAStrictOrderOfDifferentNames) {
  const std::vector<std::string> names{"",    "0",  "00",  "1",  "01", "a",     "a0",
                                       "a00", "0a", "00a", "10", "9",  "a1b02", "a1b2"};
  for (const std::string& a : names) {
    EXPECT_FALSE(natural_less(a, a)) << a;
    for (const std::string& b : names) {
      if (a != b) {
        EXPECT_NE(natural_less(a, b), natural_less(b, a)) << a << " and " << b;
      }
    }
  }
}

}  // namespace
}  // namespace seeker
