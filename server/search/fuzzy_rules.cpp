#include "server/search/fuzzy_rules.hpp"

#include <cstdlib>
#include <sstream>

#include "common/core/angle.hpp"

namespace seeker::search {
namespace {

constexpr std::array<const char*, kSectors> kSectorNames{"L", "LF", "F", "RF", "R"};
constexpr std::array<const char*, kLevels> kTargetNames{"NB", "NS", "Z", "PS", "PB"};
constexpr std::array<const char*, kLevels> kOutputNames{"TNB", "TNS", "TZ", "TPS", "TPB"};
constexpr int kFllDecimals = 9;
/// A target beyond any bearing: fuzzylite's ramps need an end where the set has long been saturated.
constexpr double kTargetSpread_rad = kPi / 4.0;

std::size_t index_of(int level) { return static_cast<std::size_t>(level + 2); }

/// Straight ahead beside one near flank is bent away from that flank.
int bend_away(const std::array<bool, kSectors>& near, int level) {
  const bool left_near = near[static_cast<std::size_t>(Sector::kLeftFront)];
  const bool right_near = near[static_cast<std::size_t>(Sector::kRightFront)];
  if (level != 0 || left_near == right_near) {
    return level;
  }
  return left_near ? -1 : 1;
}

bool closer(int candidate, int best, int target) {
  const int d_candidate = std::abs(candidate - target);
  const int d_best = std::abs(best - target);
  if (d_candidate != d_best) {
    return d_candidate < d_best;
  }
  if (std::abs(candidate) != std::abs(best)) {
    return std::abs(candidate) < std::abs(best);
  }
  return candidate > best;
}

void write_variable(std::ostream& out, const char* kind, const char* name, double low, double high) {
  out << kind << ": " << name << "\n  enabled: true\n  range: " << low << ' ' << high << "\n  lock-range: true\n";
}

void write_inputs(std::ostream& out) {
  for (const char* name : kSectorNames) {
    write_variable(out, "InputVariable", name, 0.0, kMaxDistance_m);
    out << "  term: NEAR Ramp " << kNearNone_m << ' ' << kNearFull_m << '\n';
    out << "  term: FAR Ramp " << kNearFull_m << ' ' << kNearNone_m << '\n';
  }
  write_variable(out, "InputVariable", "TARGET", -kPi, kPi);
  for (std::size_t level = 0; level < kLevels; ++level) {
    const double centre = (static_cast<double>(level) - 2.0) * kTargetSpread_rad;
    out << "  term: " << kTargetNames[level];
    if (level == 0) {
      out << " Ramp " << centre + kTargetSpread_rad << ' ' << centre << '\n';
    } else if (level + 1 == kLevels) {
      out << " Ramp " << centre - kTargetSpread_rad << ' ' << centre << '\n';
    } else {
      out << " Triangle " << centre - kTargetSpread_rad << ' ' << centre << ' ' << centre + kTargetSpread_rad << '\n';
    }
  }
}

void write_output(std::ostream& out) {
  write_variable(out, "OutputVariable", "TURN", -kPi, kPi);
  out << "  aggregation: Maximum\n  defuzzifier: Centroid " << kCentroidSamples
      << "\n  default: nan\n  lock-previous: false\n";
  for (std::size_t level = 0; level < kLevels; ++level) {
    const double centre = (static_cast<double>(level) - 2.0) * kTargetSpread_rad;
    out << "  term: " << kOutputNames[level] << " Triangle " << centre - kTargetSpread_rad << ' ' << centre << ' '
        << centre + kTargetSpread_rad << '\n';
  }
}

void write_rules(std::ostream& out) {
  out << "RuleBlock: planner\n  enabled: true\n  conjunction: Minimum\n  disjunction: none\n  implication: Minimum\n"
         "  activation: General\n";
  for (const FuzzyRule& rule : generate_rules()) {
    out << "  rule: if ";
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      out << kSectorNames[sector] << " is " << (rule.near[sector] ? "NEAR" : "FAR") << " and ";
    }
    out << "TARGET is " << kTargetNames[index_of(rule.target)] << " then TURN is "
        << kOutputNames[index_of(rule.output)] << '\n';
  }
}

}  // namespace

int output_level(const std::array<bool, kSectors>& near, int target) {
  bool found = false;
  int best = 0;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const int level = level_of(sector);
    if (!near[sector] && (!found || closer(level, best, target))) {
      best = level;
      found = true;
    }
  }
  return found ? bend_away(near, best) : 2;
}

std::vector<FuzzyRule> generate_rules() {
  constexpr unsigned kCombinations = 1U << kSectors;
  std::vector<FuzzyRule> rules;
  rules.reserve(kCombinations * kLevels);
  for (unsigned bits = 0; bits < kCombinations; ++bits) {
    FuzzyRule rule;
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      rule.near[sector] = ((bits >> (kSectors - 1 - sector)) & 1U) != 0U;
    }
    for (rule.target = -2; rule.target <= 2; ++rule.target) {
      rule.output = output_level(rule.near, rule.target);
      rules.push_back(rule);
    }
  }
  return rules;
}

std::string generate_fll() {
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(kFllDecimals);
  out << "# Local planner of the coverage search (spec S3.2). Generated: change server/search/fuzzy_rules.cpp "
         "instead;\n"
         "# a test compares this file with what the generator writes.\n"
         "Engine: planner\n";
  write_inputs(out);
  write_output(out);
  write_rules(out);
  return out.str();
}

}  // namespace seeker::search
