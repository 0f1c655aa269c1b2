#include "server/fleet/map_merger.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "tests/support/matchers.hpp"
#include "toy_maps.hpp"

namespace seeker::fleet {
namespace {

using testing::Pose2Near;

std::string figures_of(const MergeAnswer& answer) {
  std::ostringstream text;
  for (const MergeHypothesis& h : answer.hypotheses) {
    text << h.a_T_b.a_T_b << ": " << h.pairs.size() << " pairs, " << h.shared_wall_m << " m shared, " << h.weak_wall_m
         << " m across, " << h.contradiction << " denied, " << h.denied_piece_m << " m in one piece, deformed "
         << h.deformation.chi2 << "/" << h.deformation.dof << ", " << h.deformation.largest_rad << " rad, off "
         << h.deformation.switched_off << "\n";
  }
  return text.str();
}

const std::vector<Point2> kWest{{1.0, 6.0}, {14.0, 6.0}, {2.0, 6.2}};
const std::vector<Point2> kEast{{23.0, 6.0}, {8.0, 5.9}, {20.0, 6.0}};

TEST(MapMerger, LaysTwoRobotsMapsUponEachOtherWithoutKnowingWhereTheyBegan) {
  const auto walls = office(1);
  const auto paths = std::pair(drive(kWest), drive(kEast));
  PreparedMap a = prepared(toy_map(walls, paths.first, 11));
  PreparedMap b = prepared(toy_map(walls, paths.second, 12));
  const MergeAnswer answer = MapMerger().merge(a, b);
  ASSERT_EQ(answer.verdict, MergeVerdict::kMerged) << answer.reason;
  const Pose2 truth = inverse(paths.first.front()) * paths.second.front();
  EXPECT_THAT(answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(truth, 0.15, 0.02));
}

TEST(MapMerger, DoesNotMergeTwoBuildings) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    PreparedMap a = prepared(toy_map(office(seed), drive(kWest), 11));
    PreparedMap b = prepared(toy_map(office(seed + 10), drive(kEast), 12));
    const MergeAnswer answer = MapMerger().merge(a, b);
    EXPECT_NE(answer.verdict, MergeVerdict::kMerged) << answer.reason;
  }
}

TEST(MapMerger, DoesNotMergeTwoBuildingsHoweverMuchTheirMapsMayDeform) {
  for (std::uint64_t seed = 21; seed <= 30; ++seed) {
    const ToyDrift drift{0.03, 0.003 * static_cast<double>(seed - 20)};
    PreparedMap a = prepared(toy_map(office(seed), drive({{1.0, 6.0}, {23.0, 6.0}, {1.0, 6.1}}), seed, drift));
    PreparedMap b = prepared(toy_map(office(seed + 100), drive(kEast), seed + 50, drift));
    const MergeAnswer answer = MapMerger().merge(a, b);
    EXPECT_NE(answer.verdict, MergeVerdict::kMerged) << "seed " << seed << "\n" << figures_of(answer);
  }
}

TEST(MapMerger, AnswersTheSameWhenAskedAgainAndTheInverseInTheOtherDirection) {
  const auto walls = office(2);
  PreparedMap a = prepared(toy_map(walls, drive(kWest), 11));
  PreparedMap b = prepared(toy_map(walls, drive(kEast), 12));
  const MergeAnswer first = MapMerger().merge(a, b);
  const MergeAnswer again = MapMerger().merge(a, b);
  const MergeAnswer back = MapMerger().merge(b, a);
  ASSERT_TRUE(first.merged() && again.merged() && back.merged()) << first.reason << back.reason;
  EXPECT_EQ(first.hypotheses.front().a_T_b.a_T_b, again.hypotheses.front().a_T_b.a_T_b);
  EXPECT_THAT(inverse(back.hypotheses.front().a_T_b.a_T_b),
              Pose2Near(first.hypotheses.front().a_T_b.a_T_b, 0.1, 0.015));
}

/// The map with everything from a local map on turned about it: its heading slipped there.
LineMap slipped(LineMap map, std::uint32_t from, double slip_rad) {
  for (MapEdge& edge : map.edges) {
    if (edge.to == from) {
      edge.from_T_to = edge.from_T_to * Pose2{0.0, 0.0, slip_rad};
    }
    map.nodes[edge.to].map_T_node = map.nodes[edge.from].map_T_node * edge.from_T_to;
  }
  return map;
}

constexpr double kSlip_rad = 0.06;

/// The answer for a good map and one whose heading has slipped, whose steps are as uncertain as `sigma_rad` says.
MergeAnswer merge_with_slipped(double sigma_rad) {
  const auto walls = office(2);
  const std::vector<Point2> there_and_back{{1.0, 6.0}, {23.0, 6.0}, {1.0, 6.1}};
  const auto path = drive(there_and_back);
  LineMap slipping = slipped(toy_map(walls, path, 12), 2, kSlip_rad);
  for (MapEdge& edge : slipping.edges) {
    edge.covariance(2, 2) = sigma_rad * sigma_rad;
  }
  PreparedMap a = prepared(toy_map(walls, path, 11));
  PreparedMap b = prepared(slipping);
  return MapMerger().merge(a, b);
}

TEST(MapMerger, DeformsAMapWhoseHeadingHasSlippedBeforeItJudges) {
  const MergeAnswer answer = merge_with_slipped(kSlip_rad / 2.0);
  ASSERT_TRUE(answer.merged()) << answer.reason << "\n" << figures_of(answer);
  const Deformation& deformation = answer.hypotheses.front().deformation;
  EXPECT_GT(deformation.dof, 0U);
  EXPECT_LT(deformation.ratio(), MergeParams{}.deformation.max_ratio);
  EXPECT_GT(deformation.largest_rad, 0.5 * kSlip_rad);
}

TEST(MapMerger, DoesNotDeformAMapMoreThanItsCovarianceAllows) {
  const MergeAnswer answer = merge_with_slipped(kSlip_rad / 30.0);
  EXPECT_EQ(answer.verdict, MergeVerdict::kContradicted) << answer.reason << "\n" << figures_of(answer);
}

TEST(MapMerger, APlaceThatOnlyOneOfThemHasSeenIsTooLittle) {
  const auto walls = office(1);
  PreparedMap a = prepared(toy_map(walls, drive({{1.0, 6.0}, {2.0, 6.0}}), 11));
  PreparedMap b = prepared(toy_map(walls, drive({{22.0, 2.0}, {21.0, 2.0}}), 12));
  const MergeAnswer answer = MapMerger().merge(a, b);
  EXPECT_EQ(answer.verdict, MergeVerdict::kInsufficientOverlap) << answer.reason;
}

TEST(MapMerger, WhichOfTwoEqualCorridorsIsMeantCannotBeDecided) {
  const auto walls = twin_corridors();
  // The first robot knows both, the other one alone.
  PreparedMap both = prepared(
      toy_map(walls, drive({{10.0, 1.0}, {19.0, 1.0}, {-1.0, 1.0}, {-1.0, 11.0}, {19.0, 11.0}, {1.0, 11.0}}), 11));
  for (const double y : {1.0, 11.0}) {
    PreparedMap one = prepared(toy_map(walls, drive({{3.0, y}, {19.0, y}, {2.0, y}}), 12));
    EXPECT_NE(MapMerger().merge(both, one).verdict, MergeVerdict::kMerged) << y;
    EXPECT_NE(MapMerger().merge(one, both).verdict, MergeVerdict::kMerged) << y;
  }
}

TEST(MapMerger, TwoRobotsInTwoEqualCorridorsAreNotTakenForNeighbours) {
  const auto walls = twin_corridors();
  PreparedMap a = prepared(toy_map(walls, drive({{3.0, 1.0}, {19.0, 1.0}, {2.0, 1.0}}), 11));
  PreparedMap b = prepared(toy_map(walls, drive({{5.0, 11.0}, {19.0, 11.0}, {3.0, 11.0}}), 12));
  const MergeAnswer answer = MapMerger().merge(a, b);
  EXPECT_NE(answer.verdict, MergeVerdict::kMerged) << figures_of(answer);
}

TEST(MapMerger, RobotsThatBeganInTwoEqualCorridorsMeetInTheHallAndNowhereElse) {
  const auto walls = twin_corridors_with_a_hall();
  const std::vector<Point2> first{{15.0, 1.0}, {3.0, 1.0}, {-4.0, 1.0}, {-7.0, 4.0}, {-7.0, 9.0}, {-4.0, 10.5}};
  const std::vector<Point2> second{{15.0, 11.0}, {3.0, 11.0}, {-4.0, 11.0}, {-8.0, 8.0}, {-6.0, 3.0}, {-3.0, 1.5}};
  const auto path = [](const std::vector<Point2>& corners, std::size_t so_far) {
    return drive({corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(so_far)});
  };
  for (std::size_t so_far = 2; so_far <= first.size(); ++so_far) {
    const auto paths = std::pair(path(first, so_far), path(second, so_far));
    PreparedMap a = prepared(toy_map(walls, paths.first, 11));
    PreparedMap b = prepared(toy_map(walls, paths.second, 12));
    const MergeAnswer answer = MapMerger().merge(a, b);
    const Pose2 truth = inverse(paths.first.front()) * paths.second.front();
    if (answer.merged()) {
      EXPECT_THAT(answer.hypotheses.front().a_T_b.a_T_b, Pose2Near(truth, 0.3, 0.03)) << figures_of(answer);
    }
    if (so_far == first.size()) {
      EXPECT_TRUE(answer.merged()) << answer.reason << "\n" << figures_of(answer);
    }
  }
}

TEST(MapMerger, MapsWithoutScansHaveNothingToCompare) {
  PreparedMap nothing;
  PreparedMap a = prepared(toy_map(office(1), drive(kWest), 11));
  EXPECT_EQ(MapMerger().merge(a, nothing).verdict, MergeVerdict::kInsufficientOverlap);
  EXPECT_EQ(MapMerger().merge(nothing, a).verdict, MergeVerdict::kInsufficientOverlap);
}

MergeHypothesis hypothesis(double shared_m, double weak_m, double contradiction, std::size_t pairs = 3) {
  MergeHypothesis made;
  made.shared_wall_m = shared_m;
  made.weak_wall_m = weak_m;
  made.contradiction = contradiction;
  made.pairs.resize(pairs);
  return made;
}

MergeVerdict verdict_of(std::vector<MergeHypothesis> hypotheses) {
  MergeAnswer answer;
  answer.hypotheses = std::move(hypotheses);
  judge(answer, {});
  EXPECT_FALSE(answer.reason.empty());
  return answer.verdict;
}

TEST(MergeJudge, WeighsSharedWallsContradictionAndRivals) {
  EXPECT_EQ(verdict_of({}), MergeVerdict::kInsufficientOverlap);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.05)}), MergeVerdict::kMerged);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.05), hypothesis(20.0, 8.0, 0.2)}), MergeVerdict::kMerged);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.05), hypothesis(55.0, 20.0, 0.06)}), MergeVerdict::kAmbiguous);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.4)}), MergeVerdict::kContradicted);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.21)}), MergeVerdict::kAmbiguous);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.05, 1)}), MergeVerdict::kAmbiguous);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 5.0, 0.05)}), MergeVerdict::kAmbiguous);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 1.0, 0.05)}), MergeVerdict::kInsufficientOverlap);
  EXPECT_EQ(verdict_of({hypothesis(8.0, 5.0, 0.0)}), MergeVerdict::kInsufficientOverlap);
}

TEST(MergeJudge, LocalMapsThatShowTheSameWallsSpeakWhereOnlyOnePairWasFound) {
  MergeHypothesis one_pair = hypothesis(60.0, 20.0, 0.05, 1);
  one_pair.witnesses = 1;
  EXPECT_EQ(verdict_of({one_pair}), MergeVerdict::kAmbiguous);
  one_pair.witnesses = 2;
  EXPECT_EQ(verdict_of({one_pair}), MergeVerdict::kMerged);
}

TEST(MergeJudge, AWallThatTheOtherLookedThroughDeniesWhatManyOthersAffirm) {
  MergeHypothesis looked_through = hypothesis(60.0, 20.0, 0.05);
  looked_through.denied_piece_m = 2.1;
  EXPECT_EQ(verdict_of({looked_through}), MergeVerdict::kAmbiguous);
  // Nor is it a rival to one that nothing denies.
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.05), looked_through}), MergeVerdict::kMerged);
}

TEST(MergeJudge, TheMoreBothHaveSeenTheLongerIsTheWallThatWasMovedMeanwhile) {
  MergeHypothesis moved = hypothesis(150.0, 60.0, 0.05);
  moved.denied_piece_m = 1.6;
  EXPECT_EQ(verdict_of({moved}), MergeVerdict::kAmbiguous);
  moved.shared_wall_m = 200.0;
  EXPECT_EQ(verdict_of({moved}), MergeVerdict::kMerged);
  moved.shared_wall_m = 1000.0;
  moved.denied_piece_m = 3.2;
  EXPECT_EQ(verdict_of({moved}), MergeVerdict::kAmbiguous);
}

TEST(MergeJudge, MapsThatMustDeformMoreThanTheyCanContradictEachOther) {
  MergeHypothesis deformed = hypothesis(60.0, 20.0, 0.05);
  deformed.deformation.dof = 6;
  deformed.deformation.chi2 = 6.0 * MergeParams{}.deformation.max_ratio + 1.0;
  EXPECT_EQ(verdict_of({deformed}), MergeVerdict::kContradicted);
  deformed.deformation.chi2 -= 2.0;
  EXPECT_EQ(verdict_of({deformed}), MergeVerdict::kMerged);
}

TEST(MergeJudge, WhatMayBeSlidAlongACorridorIsNoRival) {
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.05), hypothesis(50.0, 2.0, 0.0)}), MergeVerdict::kMerged);
  EXPECT_EQ(verdict_of({hypothesis(60.0, 20.0, 0.05), hypothesis(50.0, 8.0, 0.0)}), MergeVerdict::kAmbiguous);
}

MergeHypothesis pictured(MergeHypothesis made, std::size_t alike, std::size_t unlike) {
  made.pictures = {alike, unlike};
  return made;
}

TEST(MergeJudge, PicturesDecideBetweenPlacesThatAreAlikeForALaser) {
  const MergeHypothesis one = hypothesis(60.0, 20.0, 0.05);
  EXPECT_EQ(verdict_of({pictured(one, 3, 0), pictured(one, 0, 3)}), MergeVerdict::kMerged);
  EXPECT_EQ(verdict_of({pictured(one, 3, 0), pictured(one, 0, 1)}), MergeVerdict::kAmbiguous);
  EXPECT_EQ(verdict_of({pictured(one, 3, 0), pictured(one, 1, 3)}), MergeVerdict::kAmbiguous);
  EXPECT_EQ(verdict_of({pictured(one, 0, 3)}), MergeVerdict::kAmbiguous) << "pictures deny it";
}

TEST(MergeJudge, PicturesOfTheSamePlacesNeedFewerWalls) {
  const MergeHypothesis few_walls = hypothesis(16.0, 6.0, 0.05, 1);
  EXPECT_EQ(verdict_of({few_walls}), MergeVerdict::kAmbiguous);
  EXPECT_EQ(verdict_of({pictured(few_walls, 2, 0)}), MergeVerdict::kMerged);
  const MergeHypothesis hardly_any = hypothesis(8.0, 5.0, 0.0);
  EXPECT_EQ(verdict_of({pictured(hardly_any, 2, 0)}), MergeVerdict::kAmbiguous) << "the operator may confirm";
  EXPECT_EQ(verdict_of({pictured(hypothesis(1.0, 0.5, 0.0), 2, 0)}), MergeVerdict::kInsufficientOverlap);
}

TEST(MergeJudge, LongCorridorsWithManyDoorsAreNotSure) {
  EXPECT_EQ(verdict_of({hypothesis(90.0, 12.0, 0.05)}), MergeVerdict::kAmbiguous);
}

TEST(MergeConfidence, GrowsWithSharedWallsAndFallsWithContradiction) {
  const MergeParams params;
  EXPECT_GT(confidence_of(hypothesis(60.0, 20.0, 0.05), params), confidence_of(hypothesis(20.0, 8.0, 0.05), params));
  EXPECT_GT(confidence_of(hypothesis(60.0, 20.0, 0.05), params), confidence_of(hypothesis(60.0, 20.0, 0.2), params));
  EXPECT_EQ(confidence_of(hypothesis(60.0, 20.0, 1.0), params), 0.0);
  EXPECT_LE(confidence_of(hypothesis(1e6, 1e6, 0.0), params), 1.0);
}

}  // namespace
}  // namespace seeker::fleet
