#include "common/core/unreachable.hpp"

#include <set>

#include <gtest/gtest.h>

namespace seeker {
namespace {

TEST(UnreachableCause, EachHasItsNameExplanationAndRemedy) {
  std::set<std::string> names;
  std::set<std::string> explanations;
  std::set<std::string> remedies;
  for (const UnreachableCause cause : kUnreachableCauses) {
    names.insert(std::string(to_string(cause)));
    explanations.insert(std::string(explain(cause)));
    remedies.insert(std::string(remedy_of(cause)));
  }
  EXPECT_EQ(names.size(), kUnreachableCauses.size());
  EXPECT_EQ(explanations.size(), kUnreachableCauses.size());
  EXPECT_EQ(remedies.size(), kUnreachableCauses.size());
  EXPECT_EQ(static_cast<std::size_t>(kUnreachableCauses.back()) + 1, kUnreachableCauses.size());
}

TEST(UnreachablePlace, IsDescribedWithItsWidthAndCause) {
  EXPECT_EQ(describe(UnreachablePlace{{3.0, 4.5}, UnreachableCause::kOutsideBound, 0.0, ""}),
            "(3.00, 4.50) m: it lies outside the bound of the mission");
  EXPECT_EQ(describe(UnreachablePlace{{3.0, 4.5}, UnreachableCause::kBlocked, 0.8, "a chair stands there"}),
            "(3.00, 4.50) m, 0.80 m wide: a chair stands there");
}

TEST(UnreachablePlace, OfManyTheRestIsCounted) {
  const std::vector<UnreachablePlace> places(11, UnreachablePlace{{1.0, 2.0}, UnreachableCause::kCutOff, 0.0, ""});
  const std::string text = describe(places);
  EXPECT_NE(text.find("; and 3 more"), std::string::npos) << text;
  EXPECT_EQ(positions_of(places).size(), 11U);
}

TEST(UnreachablePlace, EveryRemedyIsGivenOnce) {
  const std::vector<UnreachablePlace> places{{{1.0, 2.0}, UnreachableCause::kCutOff, 0.0, ""},
                                             {{2.0, 2.0}, UnreachableCause::kCutOff, 0.0, ""},
                                             {{3.0, 2.0}, UnreachableCause::kNotStated, 0.0, ""},
                                             {{4.0, 2.0}, UnreachableCause::kOutsideBound, 0.0, ""}};
  EXPECT_EQ(remedies_of(places), std::string(remedy_of(UnreachableCause::kCutOff)) + "; " +
                                     std::string(remedy_of(UnreachableCause::kOutsideBound)));
}

}  // namespace
}  // namespace seeker
