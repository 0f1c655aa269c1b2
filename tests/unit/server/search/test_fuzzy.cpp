#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/search/control_table.hpp"
#include "server/search/drive_law.hpp"
#include "server/search/fuzzy_planner.hpp"
#include "server/search/fuzzy_rules.hpp"
#include "server/search/mamdani.hpp"
#include "tests/support/data.hpp"

namespace seeker::search {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Sectors all(double distance_m) {
  Sectors sectors;
  sectors.distance_m.fill(distance_m);
  return sectors;
}

Sectors random_sectors(Rng& rng) {
  Sectors sectors;
  for (double& d : sectors.distance_m) {
    d = rng.uniform() < 0.5 ? rng.uniform(0.0, 1.2) : rng.uniform(0.0, 3.0);
  }
  return sectors;
}

FuzzyPlanner planner() {
  auto created = FuzzyPlanner::create(generate_fll());
  EXPECT_TRUE(created.has_value());
  return std::move(*created);
}

TEST(FuzzyRules, CountsAreThoseOfTheSpecification) {
  std::array<int, kLevels> counts{};
  const auto rules = generate_rules();
  ASSERT_EQ(rules.size(), 160U);
  for (const FuzzyRule& rule : rules) {
    ++counts.at(static_cast<std::size_t>(rule.output + 2));
  }
  EXPECT_EQ(counts, (std::array<int, kLevels>{23, 42, 20, 46, 29}));
}

TEST(FuzzyRules, NoFreeSectorTurnsFarLeft) {
  for (int target = -2; target <= 2; ++target) {
    EXPECT_EQ(output_level({true, true, true, true, true}, target), 2);
  }
}

TEST(FuzzyRules, StraightAheadBesideOneNearFlankBendsAway) {
  EXPECT_EQ(output_level({false, true, false, false, false}, 0), -1);
  EXPECT_EQ(output_level({false, false, false, true, false}, 0), 1);
  EXPECT_EQ(output_level({false, true, false, true, false}, 0), 0);
}

TEST(FuzzyRules, TheShippedFileIsWhatTheGeneratorWrites) {
  std::ifstream file(seeker::testing::source_file("config/fuzzy/planner.fll"));
  ASSERT_TRUE(file.good());
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), generate_fll());
}

TEST(FuzzyPlanner, GivesTheCheckValues) {
  FuzzyPlanner fuzzy = planner();
  EXPECT_EQ(fuzzy.rule_count(), 160U);
  EXPECT_NEAR(*fuzzy.infer(all(3.0), 0.0), 0.0, 1e-9);
  EXPECT_NEAR(*fuzzy.infer(all(3.0), 0.5), 0.48, 0.005);
  EXPECT_NEAR(*fuzzy.infer(all(3.0), kPi / 2.0), 1.571, 0.001);
  Sectors front = all(3.0);
  front.distance_m[2] = 0.5;
  EXPECT_NEAR(*fuzzy.infer(front, 0.0), 0.62, 0.005);
}

TEST(FuzzyPlanner, StopsOnWhatIsNotANumber) {
  FuzzyPlanner fuzzy = planner();
  const MamdaniPlanner own;
  const auto table = ControlTable::create();
  for (std::size_t k = 0; k < kSectors; ++k) {
    Sectors sectors = all(1.0);
    sectors.distance_m[k] = kNan;
    EXPECT_EQ(fuzzy.infer(sectors, 0.0), tl::unexpected(PlannerStop::kInvalidInput));
    EXPECT_EQ(own.infer(sectors, 0.0), tl::unexpected(PlannerStop::kInvalidInput));
    EXPECT_EQ(table->look_up(sectors, 0.0), tl::unexpected(PlannerStop::kInvalidInput));
  }
  EXPECT_EQ(fuzzy.infer(all(1.0), kNan), tl::unexpected(PlannerStop::kInvalidInput));
  EXPECT_EQ(table->look_up(all(1.0), kNan), tl::unexpected(PlannerStop::kInvalidInput));
}

TEST(FuzzyPlanner, StopsWhenNoRuleFires) {
  // An engine whose only rule needs a near front.
  std::string fll = generate_fll();
  fll.resize(fll.find("  rule: "));
  fll += "  rule: if F is NEAR and TARGET is Z then TURN is TZ\n";
  auto fuzzy = FuzzyPlanner::create(fll);
  ASSERT_TRUE(fuzzy.has_value()) << fuzzy.error().message;
  EXPECT_TRUE(fuzzy->infer(all(0.3), 0.0).has_value());
  EXPECT_EQ(fuzzy->infer(all(3.0), 0.0), tl::unexpected(PlannerStop::kNoRule));
}

TEST(FuzzyPlanner, RefusesTextThatIsNoPlanner) {
  std::string without_rules = generate_fll();
  without_rules.resize(without_rules.find("  rule: "));
  for (const std::string& bad : {std::string(), std::string("hello"), std::string("Engine: x\n"), without_rules,
                                 std::string(std::size_t{2} << 20U, 'x')}) {
    const auto refused = FuzzyPlanner::create(bad);
    ASSERT_FALSE(refused.has_value());
    EXPECT_FALSE(refused.error().message.empty());
  }
}

TEST(MamdaniPlanner, EqualsFuzzyliteOnManyInputs) {
  FuzzyPlanner fuzzy = planner();
  const MamdaniPlanner own;
  Rng rng(71);
  double largest = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const Sectors sectors = random_sectors(rng);
    const double target = rng.uniform(-kPi, kPi);
    largest = std::max(largest, std::abs(*fuzzy.infer(sectors, target) - *own.infer(sectors, target)));
  }
  // The file states pi/4 with nine decimals.
  EXPECT_LT(largest, 1e-6);
}

TEST(ControlTable, HasTheSizeOfThePaperAndIsExactAtItsNodes) {
  const auto table = ControlTable::create();
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->size(), 101088U);
  FuzzyPlanner fuzzy = planner();
  Rng rng(72);
  const auto& axis = table->params().distances_m;
  for (int k = 0; k < 1000; ++k) {
    Sectors sectors;
    for (double& d : sectors.distance_m) {
      d = axis[rng.below(axis.size())];
    }
    const double target = table->target_node_rad(1 + static_cast<int>(rng.below(12)));
    EXPECT_NEAR(*table->look_up(sectors, target), *fuzzy.infer(sectors, target), 2e-6);
  }
}

TEST(ControlTable, StaysNearTheInferenceBetweenItsNodesAndFinerGridsStayNearer) {
  const auto coarse = ControlTable::create();
  const auto fine = ControlTable::create({{0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 3.0}, 30.0});
  ASSERT_TRUE(coarse && fine);
  const MamdaniPlanner own;
  Rng rng(73);
  double coarse_mean = 0.0;
  double fine_mean = 0.0;
  constexpr int kSamples = 3000;
  for (int k = 0; k < kSamples; ++k) {
    const Sectors sectors = random_sectors(rng);
    const double target = rng.uniform(-kPi, kPi);
    const double exact = *own.infer(sectors, target);
    coarse_mean += std::abs(*coarse->look_up(sectors, target) - exact) / kSamples;
    fine_mean += std::abs(*fine->look_up(sectors, target) - exact) / kSamples;
  }
  EXPECT_LT(coarse_mean, 0.1);
  EXPECT_LT(fine_mean, coarse_mean);
}

TEST(ControlTable, RefusesBadAxes) {
  EXPECT_FALSE(ControlTable::create({{0.4}, 30.0}).has_value());
  EXPECT_FALSE(ControlTable::create({{0.4, 0.4}, 30.0}).has_value());
  EXPECT_FALSE(ControlTable::create({{0.4, 5.0}, 30.0}).has_value());
  EXPECT_FALSE(ControlTable::create({{0.4, 1.0}, 7.0}).has_value());
  EXPECT_FALSE(ControlTable::create({{0.4, 1.0}, kNan}).has_value());
}

TEST(DriveLaw, IsThatOfTheSpecification) {
  EXPECT_EQ(drive_command(0.0, 3.0), (Twist2{0.2, 0.0}));
  EXPECT_EQ(drive_command(0.0, 0.35), (Twist2{0.0, 0.0}));
  EXPECT_NEAR(drive_command(0.0, 0.675).v_m_s, 0.1, 1e-12);
  EXPECT_EQ(drive_command(2.0, 3.0), (Twist2{0.0, 0.6}));
  EXPECT_NEAR(drive_command(-0.5, 3.0).v_m_s, 0.2 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(drive_command(-0.5, 3.0).omega_rad_s, -0.5, 1e-12);
}

SonarScan ring(const std::array<float, 8>& ranges) {
  constexpr std::array<double, 8> kHeadings_deg{90, 50, 30, 10, -10, -30, -50, -90};
  SonarScan scan;
  scan.range_max_m = 5.0;
  scan.cone_half_angle_rad = deg_to_rad(15.0);
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const double heading = deg_to_rad(kHeadings_deg.at(k));
    scan.readings.push_back({{0.15 * std::cos(heading), 0.15 * std::sin(heading), heading}, ranges.at(k)});
  }
  return scan;
}

TEST(Sectors, FuseTheRingAsInThePaper) {
  const auto sectors = fuse_sectors(ring({0.5F, 0.9F, 0.7F, 2.0F, 1.5F, kNoReturn, 4.5F, 1.0F}));
  ASSERT_TRUE(sectors.has_value());
  const std::array<double, 5> expected{0.5, 0.7, 1.5, 3.0, 1.0};
  for (std::size_t k = 0; k < kSectors; ++k) {
    EXPECT_NEAR(sectors->distance_m[k], expected.at(k), 1e-6);
  }
}

TEST(Sectors, RefuseNanAndABlindSector) {
  SonarScan broken = ring({1, 1, 1, std::numeric_limits<float>::quiet_NaN(), 1, 1, 1, 1});
  EXPECT_FALSE(fuse_sectors(broken).has_value());
  SonarScan blind = ring({1, 1, 1, 1, 1, 1, 1, 1});
  blind.readings.pop_back();
  EXPECT_FALSE(fuse_sectors(blind).has_value());
}

TEST(Sectors, BordersOfForbiddenAreasAreWalls) {
  nav::ForbiddenAreas areas;
  areas.bound = Polygon{{-5, -5}, {1, -5}, {1, 5}, {-5, 5}};
  areas.keep_out.push_back({{-1, 1}, {1, 1}, {1, 2}, {-1, 2}});
  Sectors open = all(3.0);
  const Sectors walled = with_virtual_walls(open, areas, {}, 0.2);
  EXPECT_NEAR(walled[Sector::kFront], 1.0 / std::cos(deg_to_rad(10.0)) - 0.2, 1e-6);
  EXPECT_NEAR(walled[Sector::kLeft], 0.8, 1e-6);
  EXPECT_NEAR(walled[Sector::kRight], 3.0, 1e-6);
  // From outside, the border does not keep the robot out.
  const Sectors outside = with_virtual_walls(open, areas, {2.0, -1.0, kPi}, 0.2);
  EXPECT_NEAR(outside[Sector::kFront], 3.0, 1e-6);
}

}  // namespace
}  // namespace seeker::search
