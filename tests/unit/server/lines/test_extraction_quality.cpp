#include <gtest/gtest.h>

#include "server/lines/fast_extractor.hpp"
#include "tests/support/lines/scoring.hpp"

namespace seeker::lines {
namespace {

using testing::LineScore;
using testing::ScannerModel;
using testing::ScoringParams;

struct Scores {
  LineScore found;
  LineScore oracle;
};

Scores score_rooms(const ScannerModel& model, int rooms, std::uint64_t seed) {
  FastParams params;
  const ScoringParams scoring;
  params.min_points = scoring.min_points;
  params.min_length_m = scoring.min_length_m;
  FastExtractor extractor(params);
  Rng rng(seed);
  Scores scores;
  for (int k = 0; k < rooms; ++k) {
    const testing::Room room = testing::random_room(rng);
    const testing::TrueScan truth = testing::scan_room(room, model, rng);
    const auto runs = testing::wall_runs(room, truth, scoring);
    testing::score_scan(runs, extractor.extract(truth.scan), scoring, scores.found);
    testing::score_scan(runs, testing::oracle_lines(runs, truth), scoring, scores.oracle);
  }
  return scores;
}

class RandomRooms : public ::testing::TestWithParam<ScannerModel> {};

TEST_P(RandomRooms, WallsAreFoundAndNothingElse) {
  const Scores scores = score_rooms(GetParam(), 60, 5);
  EXPECT_GT(scores.found.required, 100);
  EXPECT_GE(scores.found.true_positive(), 0.98);
  EXPECT_LE(scores.found.false_positive(), 0.02);
}

TEST_P(RandomRooms, LinesAreAsGoodAsFitsToTheTrueWalls) {
  const Scores scores = score_rooms(GetParam(), 60, 6);
  EXPECT_LE(scores.found.r_spread_m(), 1.2 * scores.oracle.r_spread_m());
  EXPECT_LE(scores.found.alpha_spread_rad(), 1.2 * scores.oracle.alpha_spread_rad());
}

INSTANTIATE_TEST_SUITE_P(Scanners, RandomRooms,
                         ::testing::Values(ScannerModel::half_circle(361, 0.01), ScannerModel::half_circle(181, 0.01),
                                           ScannerModel::full_circle(360, 0.01), ScannerModel::full_circle(720, 0.02)));

class LineCovariance : public ::testing::TestWithParam<ScannerModel> {};

TEST_P(LineCovariance, SaysHowWrongTheLinesAre) {
  const LineScore score = score_rooms(GetParam(), 1250, 7).found;
  std::cout << score.matches << " lines of " << GetParam().beams << " beams: NEES " << score.nees_mean() << "\n";
  EXPECT_GE(score.matches, 5000);
  // 2 degrees of freedom: the mean of the normalised squared errors is 2, and scatters by 0.03 for so many.
  EXPECT_NEAR(score.nees_mean(), 2.0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Scanners, LineCovariance,
                         ::testing::Values(ScannerModel::half_circle(361, 0.01), ScannerModel::half_circle(181, 0.01),
                                           ScannerModel::full_circle(720, 0.02)));

}  // namespace
}  // namespace seeker::lines
