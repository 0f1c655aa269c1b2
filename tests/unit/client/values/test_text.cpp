#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "client/values/names.hpp"
#include "client/values/values.hpp"

namespace seeker::cli {
namespace {

TEST(Gaps, AreNumberedInTheListAsInThePicture) {
  const std::vector<api::Gap> gaps{{Point2(1, 1), 0.01, "not seen"}, {Point2(2, 2), 0.5, "cut off"}, {{3, 3}, 2, "x"}};
  EXPECT_EQ(lines_of(gaps), (std::vector<std::string>{"1  2.0 m\xC2\xB2 at (3.00, 3.00) x",
                                                      "2  0.5 m\xC2\xB2 at (2.00, 2.00) cut off"}));
}

TEST(Names, AreListedAsTheirValuesStand) {
  EXPECT_EQ(listed(std::vector{api::Role::kObserver, api::Role::kOperator}), "observer, operator");
  EXPECT_EQ(names_of(all_topics()).size(), api::kTopicCount);
}

}  // namespace
}  // namespace seeker::cli
