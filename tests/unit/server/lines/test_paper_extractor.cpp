#include <gtest/gtest.h>

#include "server/lines/fast_extractor.hpp"
#include "server/lines/five_modes.hpp"
#include "server/lines/paper_extractor.hpp"
#include "server/lines/split_extractors.hpp"
#include "tests/unit/server/lines/scenes.hpp"

namespace seeker::lines {
namespace {

using testing::ScannerModel;

/// A room with a cupboard in a corner, all walls longer than half a metre.
testing::Room furnished_room() {
  testing::Room room = box_room(-2.0, -2.5, 3.0, 2.0);
  testing::add_polygon(room, {{1.2, -1.9}, {2.2, -1.5}, {1.9, -0.7}, {0.9, -1.1}});
  return room;
}

/// Points along given places, for the state machine alone.
PointRow row_of(const std::vector<Point2>& points) {
  PointRow row;
  for (const Point2& p : points) {
    row.points.push_back(p);
    row.polar.push_back({.range_m = p.norm(), .angle_rad = std::atan2(p.y(), p.x())});
    row.beams.push_back(row.beams.size());
  }
  return row;
}

std::vector<Indices> modes_on(const std::vector<Point2>& points) {
  const PointRow row = row_of(points);
  const PaperParams params;
  const ModeLimits limits{.thresholds = params.start, .max_fit_error_m = 0.005, .spacing_rad = 0.0};
  return FiveModes(row, params, limits).run(0, points.size() - 1);
}

TEST(FiveModes, ACornerEndsALineAndBeginsTheNextAtItsLastPoint) {
  std::vector<Point2> points;
  for (int k = 0; k <= 10; ++k) {
    points.emplace_back(2.0, -1.0 + 0.1 * k);
  }
  for (int k = 1; k <= 10; ++k) {
    points.emplace_back(2.0 - 0.1 * k, 0.0);
  }
  const std::vector<Indices> lines = modes_on(points);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].front(), 0U);
  EXPECT_EQ(lines[0].back(), 10U);
  EXPECT_EQ(lines[1].front(), 10U);
  EXPECT_EQ(lines[1].back(), 20U);
}

TEST(FiveModes, AnOutlierIsSkipped) {
  std::vector<Point2> points;
  for (int k = 0; k <= 20; ++k) {
    points.emplace_back(2.0 + (k == 12 ? 0.05 : 0.0), -1.0 + 0.1 * k);
  }
  const std::vector<Indices> lines = modes_on(points);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 20U);
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), 12U), 0);
}

TEST(FiveModes, AGapSplits) {
  std::vector<Point2> points;
  for (int k = 0; k <= 20; ++k) {
    points.emplace_back(2.0, -1.0 + 0.1 * k + (k > 9 ? 0.1 : 0.0));
  }
  const std::vector<Indices> lines = modes_on(points);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].size(), 10U);
  EXPECT_EQ(lines[1].size(), 11U);
}

TEST(FiveModes, ASeedThatDoesNotFitMovesOn) {
  std::vector<Point2> points{{2.3, -1.05}, {2.2, -1.02}};
  for (int k = 0; k <= 12; ++k) {
    points.emplace_back(2.0, -1.0 + 0.1 * k);
  }
  const std::vector<Indices> lines = modes_on(points);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].back(), 14U);
  EXPECT_GE(lines[0].front(), 1U);
}

TEST(PaperExtractor, AgreesWithTheFastExtractorOnCleanScenes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const LaserScan scan = scan_of(furnished_room(), ScannerModel::full_circle(720, 0.0), 0.002, seed);
    FastParams fast_params;
    fast_params.noise.sigma_m = 0.002;
    PaperParams paper_params;
    paper_params.noise.sigma_m = 0.002;
    const ScanLines fast = FastExtractor(fast_params).extract(scan);
    const ScanLines paper = PaperExtractor(paper_params).extract(scan);
    // The paper's rules keep lines of 0.1 m, the fast ones begin at 0.3 m.
    std::vector<Line> long_lines;
    std::copy_if(paper.lines.begin(), paper.lines.end(), std::back_inserter(long_lines),
                 [](const Line& line) { return line.length_m > 0.35; });
    ASSERT_EQ(fast.lines.size(), long_lines.size()) << "seed " << seed;
    for (const Line& a : fast.lines) {
      const auto same = std::find_if(long_lines.begin(), long_lines.end(), [&](const Line& b) {
        return std::abs(wrap_angle(a.alpha_rad - b.alpha_rad)) < 0.01 && std::abs(a.r_m - b.r_m) < 0.02 &&
               (a.start - b.start).norm() < 0.15 && (a.end - b.end).norm() < 0.15;
      });
      EXPECT_NE(same, long_lines.end()) << "seed " << seed << ": r " << a.r_m << " alpha " << a.alpha_rad;
    }
  }
}

TEST(PaperExtractor, ReportsHowItsThresholdsShrank) {
  // A flat corner within the first turning threshold.
  const testing::Room room{{{1.0, -1.0}, {1.04, 0.0}}, {{1.04, 0.0}, {1.0, 1.0}}};
  PaperParams params;
  params.noise.sigma_m = 0.001;
  const ScanLines lines = PaperExtractor(params).extract(scan_of(room, ScannerModel::half_circle(361, 0.0), 0.001));
  ASSERT_EQ(lines.history.size(), 1U);
  const PacketHistory& history = lines.history.front();
  ASSERT_GT(history.rounds.size(), 1U);
  EXPECT_EQ(history.rounds.size(), history.worst_error_m.size());
  EXPECT_DOUBLE_EQ(history.rounds[0].corner_m, 0.025);
  EXPECT_DOUBLE_EQ(history.rounds[1].corner_m, 0.8 * 0.025);
  EXPECT_DOUBLE_EQ(history.rounds[1].gap_m, 0.8 * 0.150);
  EXPECT_GT(history.worst_error_m.front(), 0.005);
  EXPECT_LE(history.worst_error_m.back(), 0.005);
}

TEST(PaperExtractor, CollinearWallsStayApartWhenTheirEndsAre) {
  for (const double gap_m : {0.1, 0.5}) {
    const testing::Room room{{{1.0, -0.8}, {1.0, 0.0}}, {{1.0, gap_m}, {1.0, 0.8 + gap_m}}};
    PaperParams params;
    params.start.gap_m = 0.05;
    params.noise.sigma_m = 0.002;
    const ScanLines lines = PaperExtractor(params).extract(scan_of(room, ScannerModel::half_circle(721, 0.0), 0.002));
    EXPECT_EQ(lines.lines.size(), gap_m < 0.2 ? 1U : 2U);
  }
}

TEST(PaperExtractor, TakesScansWithoutLines) {
  LaserScan scan;
  scan.angle_step_rad = 0.01;
  scan.range_max_m = 10.0;
  for (const std::size_t beams : {0U, 1U, 2U, 7U}) {
    scan.ranges_m.assign(beams, 1.0F);
    EXPECT_TRUE(PaperExtractor().extract(scan).lines.empty());
    EXPECT_TRUE(SplitAndMerge().extract(scan).lines.empty());
    EXPECT_TRUE(Iepf().extract(scan).lines.empty());
  }
  scan.ranges_m.assign(300, kNoReturn);
  EXPECT_TRUE(PaperExtractor().extract(scan).lines.empty());
}

TEST(PointByPointExtractors, NeverGiveNaN) {
  Rng rng(12);
  for (int scan_number = 0; scan_number < 100; ++scan_number) {
    LaserScan scan;
    scan.angle_min_rad = -1.0;
    scan.angle_step_rad = kTwoPi / 200.0;
    for (int k = 0; k < 200; ++k) {
      scan.ranges_m.push_back(rng.uniform() < 0.5 ? 2.0F : static_cast<float>(rng.uniform(0.0, 3.0)));
    }
    for (const ScanLines& found :
         {PaperExtractor().extract(scan), SplitAndMerge().extract(scan), Iepf().extract(scan)}) {
      for (const Line& line : found.lines) {
        EXPECT_TRUE(is_finite(line)) << "scan " << scan_number;
      }
    }
  }
}

TEST(SplitExtractors, FindTheWallsOfARoom) {
  const LaserScan scan = scan_of(box_room(-2.0, -2.5, 3.0, 2.0), ScannerModel::full_circle(720, 0.0), 0.002);
  EXPECT_EQ(SplitAndMerge().extract(scan).lines.size(), 4U);
  EXPECT_EQ(Iepf().extract(scan).lines.size(), 4U);
}

}  // namespace
}  // namespace seeker::lines
