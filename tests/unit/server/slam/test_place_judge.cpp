#include <gtest/gtest.h>

#include "server/slam/place_recogniser.hpp"

namespace seeker::slam {
namespace {

PlaceCandidate candidate(double fit, double through) {
  PlaceCandidate out;
  out.fit = {fit, fit};
  out.agreement.through = through;
  return out;
}

TEST(Judge, NamesTheReasonOfEachVerdict) {
  const JudgeParams params;
  EXPECT_EQ(judge({}, 200).verdict, PlaceVerdict::kNone);
  EXPECT_EQ(judge({candidate(0.95, 0.0)}, 200).verdict, PlaceVerdict::kUnique);
  EXPECT_EQ(judge({candidate(0.7, 0.0)}, 200).verdict, PlaceVerdict::kNone);
  EXPECT_EQ(judge({candidate(0.7, 0.0)}, 200).reason,
            "much of what is seen lies where the map shows nothing; drive to where it has been made");
  EXPECT_EQ(judge({candidate(0.95, 0.2)}, 200).verdict, PlaceVerdict::kNone);
  EXPECT_EQ(judge({candidate(0.95, 0.2)}, 200).reason, "the points contradict even the best place");
  EXPECT_EQ(judge({candidate(0.9, 0.0), candidate(0.95, 0.0)}, 200).verdict, PlaceVerdict::kAmbiguous);
  EXPECT_EQ(judge({candidate(0.95, 0.0), candidate(0.9, 0.0)}, 200).reason, "another place fits nearly as well");
  EXPECT_EQ(judge({candidate(0.95, 0.0), candidate(0.75, 0.0)}, 60).reason,
            "too little was observed to distinguish this place from others");
  // The same lead is enough for a good fit and too little for a poor one.
  EXPECT_EQ(judge({candidate(0.95, 0.0), candidate(0.8, 0.0)}, 200).verdict, PlaceVerdict::kUnique);
  EXPECT_EQ(judge({candidate(0.8, 0.0), candidate(0.65, 0.0)}, 200).verdict, PlaceVerdict::kAmbiguous);
  // Beams that go through a rival's walls speak against it.
  const auto answer = judge({candidate(0.94, 0.4), candidate(0.95, 0.0)}, 200);
  EXPECT_EQ(answer.verdict, PlaceVerdict::kUnique);
  EXPECT_EQ(answer.candidates.front().fit.all, 0.95);
  auto blind = candidate(0.95, 0.0);
  blind.match.degenerate_direction = Point2(1.0, 0.0);
  EXPECT_EQ(judge({blind}, 200).verdict, PlaceVerdict::kAmbiguous);
}

TEST(Judge, DistinguishesEvidenceForAnotherPlaceFromNoEvidence) {
  EXPECT_FALSE(judge({}, 200).says_nothing);
  EXPECT_FALSE(judge({candidate(0.7, 0.0)}, 200).says_nothing) << "the map does not show this place";
  EXPECT_FALSE(judge({candidate(0.95, 0.0), candidate(0.9, 0.0)}, 200).says_nothing) << "two places fit";
  EXPECT_TRUE(judge({candidate(0.95, 0.0), candidate(0.75, 0.0)}, 60).says_nothing) << "too little was seen";
  auto blind = candidate(0.95, 0.0);
  blind.match.degenerate_direction = Point2(1.0, 0.0);
  EXPECT_TRUE(judge({blind}, 200).says_nothing) << "a corridor";
}

TEST(Judge, WeighsAPlaceThatLeadsByTooLittle) {
  const auto weight = [](double best, double next, std::size_t cells) {
    return judge({candidate(best, 0.0), candidate(next, 0.0)}, cells).weight;
  };
  EXPECT_EQ(weight(0.97, 0.8, 200), 1.0) << "unique";
  EXPECT_NEAR(weight(0.97, 0.87, 200), 0.1 / 0.12, 1e-9) << "by the lead";
  EXPECT_NEAR(weight(0.97, 0.87, 75), 0.1 * 75.0 / 15.0, 1e-9) << "by how much of the view it rests on";
  EXPECT_NEAR(weight(0.97, 0.8, 50), 0.17 * 50.0 / 15.0, 1e-9) << "clear, but too little was seen";
  EXPECT_EQ(weight(0.97, 0.9, 200), 0.0) << "the other one fits as well";
  EXPECT_EQ(weight(0.9, 0.8, 200), 0.0) << "it leaves a tenth unexplained";
  EXPECT_EQ(judge({candidate(0.97, 0.2), candidate(0.87, 0.2)}, 200).weight, 0.0) << "the map speaks against it";
}

}  // namespace
}  // namespace seeker::slam
