#include "server/search/mamdani.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::search {
namespace {

constexpr double kSpread_rad = kPi / 4.0;

}  // namespace

double near_membership(double distance_m) {
  return std::clamp((kNearNone_m - distance_m) / (kNearNone_m - kNearFull_m), 0.0, 1.0);
}

double target_membership(int level, double target_rad) {
  const double centre = level * kSpread_rad;
  if ((level == 2 && target_rad >= centre) || (level == -2 && target_rad <= centre)) {
    return 1.0;
  }
  return heading_change_membership(level, target_rad);
}

double heading_change_membership(int level, double heading_change_rad) {
  return std::max(0.0, 1.0 - std::abs(heading_change_rad - level * kSpread_rad) / kSpread_rad);
}

MamdaniPlanner::MamdaniPlanner() : rules_(generate_rules()) {
  // Middles of equal slices of [-pi, pi], as fuzzylite's Centroid takes them.
  for (std::size_t s = 0; s < sample_rad_.size(); ++s) {
    sample_rad_[s] = -kPi + (static_cast<double>(s) + 0.5) * kTwoPi / kCentroidSamples;
    for (std::size_t level = 0; level < kLevels; ++level) {
      output_sets_[s][level] = heading_change_membership(static_cast<int>(level) - 2, sample_rad_[s]);
    }
  }
}

MamdaniPlanner::Activation MamdaniPlanner::activate(const Sectors& sectors, double target_rad) const {
  std::array<std::array<double, 2>, kSectors> sector_sets{};
  for (std::size_t k = 0; k < kSectors; ++k) {
    const double near = near_membership(std::clamp(sectors.distance_m[k], 0.0, kMaxDistance_m));
    sector_sets[k] = {1.0 - near, near};
  }
  Activation target_sets{};
  for (std::size_t level = 0; level < kLevels; ++level) {
    target_sets[level] = target_membership(static_cast<int>(level) - 2, target_rad);
  }
  Activation activation{};
  for (std::size_t r = 0; r < rules_.size(); r += kLevels) {
    double all_sectors = 1.0;
    for (std::size_t k = 0; k < kSectors; ++k) {
      all_sectors = std::min(all_sectors, sector_sets[k][rules_[r].near[k] ? 1 : 0]);
    }
    for (std::size_t t = 0; all_sectors > 0.0 && t < kLevels; ++t) {
      double& level = activation[static_cast<std::size_t>(rules_[r + t].output + 2)];
      level = std::max(level, std::min(all_sectors, target_sets[t]));
    }
  }
  return activation;
}

HeadingResult MamdaniPlanner::infer(const Sectors& sectors, double target_rad) const {
  const bool valid = std::isfinite(target_rad) && std::all_of(sectors.distance_m.begin(), sectors.distance_m.end(),
                                                              [](double d) { return std::isfinite(d); });
  if (!valid) {
    return tl::unexpected(PlannerStop::kInvalidInput);
  }
  const Activation activation = activate(sectors, wrap_angle(target_rad));
  double moment = 0.0;
  double area = 0.0;
  for (std::size_t s = 0; s < sample_rad_.size(); ++s) {
    double membership = 0.0;
    for (std::size_t level = 0; level < kLevels; ++level) {
      membership = std::max(membership, std::min(activation[level], output_sets_[s][level]));
    }
    moment += sample_rad_[s] * membership;
    area += membership;
  }
  if (area <= 0.0) {
    return tl::unexpected(PlannerStop::kNoRule);
  }
  return moment / area;
}

}  // namespace seeker::search
