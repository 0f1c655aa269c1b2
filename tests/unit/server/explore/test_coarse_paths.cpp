#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "common/core/rng.hpp"
#include "server/explore/coarse_paths.hpp"

namespace seeker::explore {
namespace {

constexpr double kCoarse_m = 0.2;

Grid<std::uint8_t> scattered_floor(int width, int height, double free_share, std::uint64_t seed) {
  Rng rng(seed);
  Grid<std::uint8_t> floor({{-1.0, 2.0}, kCoarse_m}, width, height, 0);
  for (std::uint8_t& cell : floor.cells()) {
    cell = rng.uniform(0.0, 1.0) < free_share ? 1 : 0;
  }
  return floor;
}

/// Path lengths in cells from one cell to all, by relaxing every step until none shortens anything.
Grid<double> relaxed(const Grid<std::uint8_t>& floor, CellIndex start) {
  Grid<double> lengths(floor.frame(), floor.width(), floor.height(), CoarsePaths::kNoPath);
  lengths[start] = 0.0;
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (std::size_t k = 0; k < floor.cells().size(); ++k) {
      const CellIndex cell = floor.cell(k);
      for (int step = 0; floor[cell] != 0 && step < 9; ++step) {
        const CellIndex from{cell.i + step / 3 - 1, cell.j + step % 3 - 1};
        if (floor.contains(from) && floor[from] != 0) {
          const double length = lengths[from] + std::hypot(from.i - cell.i, from.j - cell.j);
          shorter = shorter || length < lengths[cell] - 1e-9;
          lengths[cell] = std::min(lengths[cell], length);
        }
      }
    }
  }
  return lengths;
}

TEST(CoarsePaths, AreTheShortestOnAnyFloor) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Grid<std::uint8_t> floor = scattered_floor(23, 17, 0.5 + 0.02 * static_cast<double>(seed), seed);
    std::vector<CellIndex> cells;
    std::vector<Point2> centres;
    for (std::size_t k = 0; k < floor.cells().size(); ++k) {
      if (floor.cells()[k] != 0) {
        cells.push_back(floor.cell(k));
        centres.push_back(floor.frame().centre_of(cells.back()));
      }
    }
    const CoarsePaths paths(floor);
    const Grid<double> expected = relaxed(floor, cells.front());
    const std::vector<double> lengths_m = paths.lengths_m(centres.front(), centres);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const double expected_m = kCoarse_m * expected[cells[k]];
      if (std::isfinite(expected_m)) {
        EXPECT_NEAR(lengths_m[k], expected_m, 1e-4) << "seed " << seed << ", cell " << cells[k].i << ' ' << cells[k].j;
      } else {
        EXPECT_EQ(lengths_m[k], CoarsePaths::kNoPath) << "seed " << seed;
      }
      EXPECT_EQ(paths.lengths_m(centres.front(), {&centres[k], 1}).front(), lengths_m[k])
          << "one target ends the search, not its length";
    }
  }
}

TEST(CoarsePaths, ToAPlaceOfTheSameCellAreStraight) {
  const Grid<std::uint8_t> floor({Point2::Zero(), kCoarse_m}, 5, 5, 1);
  const std::vector<Point2> beside{{0.55, 0.5}};
  EXPECT_NEAR(CoarsePaths(floor).lengths_m({0.45, 0.5}, beside).front(), 0.1, 1e-9);
}

TEST(CoarsePaths, AreGuessedWhereNoneIsKnown) {
  Grid<std::uint8_t> floor({Point2::Zero(), kCoarse_m}, 30, 3, 1);
  for (int j = 0; j < 3; ++j) {
    floor[{15, j}] = 0;
  }
  const Point2 here = floor.frame().centre_of({2, 1});
  const std::vector<Point2> there{floor.frame().centre_of({27, 1})};
  const CoarsePaths paths(floor);
  EXPECT_EQ(paths.lengths_m(here, there).front(), CoarsePaths::kNoPath);
  EXPECT_NEAR(paths.expected_m(here, there).front(), 1.5 * 25 * kCoarse_m, 1e-9);
  const std::vector<Point2> nowhere{{100.0, 100.0}};
  EXPECT_EQ(paths.lengths_m(here, nowhere).front(), CoarsePaths::kNoPath);
  EXPECT_EQ(paths.lengths_m({100.0, 100.0}, there).front(), CoarsePaths::kNoPath);
}

}  // namespace
}  // namespace seeker::explore
