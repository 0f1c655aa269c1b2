#include "server/search/control_table.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/search/mamdani.hpp"

namespace seeker::search {
namespace {

constexpr std::size_t kInputs = kSectors + 1;
constexpr std::size_t kMaxNodes = 16'000'000;
constexpr double kFullCircle_deg = 360.0;

/// Lower node and how far towards the next one, of one input.
struct Position {
  std::size_t node = 0;
  double fraction = 0.0;
};

Position locate(const std::vector<double>& axis, double value) {
  if (value <= axis.front()) {
    return {0, 0.0};
  }
  for (std::size_t k = 1; k < axis.size(); ++k) {
    if (value < axis[k]) {
      return {k - 1, (value - axis[k - 1]) / (axis[k] - axis[k - 1])};
    }
  }
  return {axis.size() - 2, 1.0};
}

Status validate(const ControlTableParams& params) {
  const auto& axis = params.distances_m;
  const bool ascending =
      axis.size() >= 2 && axis.front() >= 0.0 && axis.back() <= kMaxDistance_m &&
      std::adjacent_find(axis.begin(), axis.end(), [](double a, double b) { return !(a < b); }) == axis.end();
  if (!ascending) {
    return fail(Errc::kInvalidArgument, "the control table needs two or more ascending distances within 0..3 m");
  }
  const double steps = kFullCircle_deg / params.target_step_deg;
  constexpr double kRounding = 1e-9;
  if (!(params.target_step_deg >= 1.0) || std::abs(steps - std::round(steps)) > kRounding) {
    return fail(Errc::kInvalidArgument, "the control table's target step must divide 360 degrees and be at least 1");
  }
  const double nodes = std::pow(static_cast<double>(axis.size()), static_cast<double>(kSectors)) * (steps + 1.0);
  if (nodes > static_cast<double>(kMaxNodes)) {
    return fail(Errc::kTooLarge, "the control table would have more than 16 million nodes; choose a coarser grid");
  }
  return {};
}

}  // namespace

ControlTableParams ControlTableParams::fine() { return {{0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 3.0}, 15.0}; }

Result<ControlTable> ControlTable::create(const ControlTableParams& params) {
  if (const Status valid = validate(params); !valid) {
    return tl::unexpected(valid.error());
  }
  ControlTable table;
  table.params_ = params;
  table.target_nodes_ = static_cast<int>(std::lround(kFullCircle_deg / params.target_step_deg)) + 1;
  table.fill();
  return table;
}

double ControlTable::target_node_rad(int k) const { return -kPi + k * deg_to_rad(params_.target_step_deg); }

void ControlTable::fill() {
  const MamdaniPlanner planner;
  const auto& axis = params_.distances_m;
  std::size_t combinations = 1;
  for (std::size_t k = 0; k < kSectors; ++k) {
    combinations *= axis.size();
  }
  values_.reserve(combinations * static_cast<std::size_t>(target_nodes_));
  for (std::size_t combination = 0; combination < combinations; ++combination) {
    Sectors sectors;
    std::size_t rest = combination;
    for (std::size_t k = kSectors; k-- > 0;) {
      sectors.distance_m[k] = axis[rest % axis.size()];
      rest /= axis.size();
    }
    for (int t = 0; t < target_nodes_; ++t) {
      // Exactly -pi would wrap to +pi; the sets are saturated there, so a hair inside is the same node.
      constexpr double kHair_rad = 1e-9;
      const auto heading = planner.infer(sectors, std::max(target_node_rad(t), -kPi + kHair_rad));
      SEEKER_ASSERT(heading.has_value());  // the generated sets leave no input without a rule
      values_.push_back(static_cast<float>(*heading));
    }
  }
}

HeadingResult ControlTable::look_up(const Sectors& sectors, double target_rad) const {
  if (!std::isfinite(target_rad)) {
    return tl::unexpected(PlannerStop::kInvalidInput);
  }
  std::array<Position, kInputs> at;
  std::array<std::size_t, kInputs> stride{};
  std::size_t step = static_cast<std::size_t>(target_nodes_);
  for (std::size_t k = kSectors; k-- > 0;) {
    if (!std::isfinite(sectors.distance_m[k])) {
      return tl::unexpected(PlannerStop::kInvalidInput);
    }
    at[k] = locate(params_.distances_m, sectors.distance_m[k]);
    stride[k] = step;
    step *= params_.distances_m.size();
  }
  const double along = (wrap_angle(target_rad) + kPi) / deg_to_rad(params_.target_step_deg);
  const double node = std::clamp(std::floor(along), 0.0, static_cast<double>(target_nodes_ - 2));
  at[kSectors] = {static_cast<std::size_t>(node), std::clamp(along - node, 0.0, 1.0)};
  stride[kSectors] = 1;

  double sum = 0.0;
  constexpr unsigned kCorners = 1U << kInputs;
  for (unsigned corner = 0; corner < kCorners; ++corner) {
    double weight = 1.0;
    std::size_t offset = 0;
    for (std::size_t k = 0; k < kInputs && weight > 0.0; ++k) {
      const bool upper = ((corner >> k) & 1U) != 0U;
      weight *= upper ? at[k].fraction : 1.0 - at[k].fraction;
      offset += (at[k].node + (upper ? 1U : 0U)) * stride[k];
    }
    if (weight > 0.0) {
      sum += weight * values_[offset];
    }
  }
  return sum;
}

}  // namespace seeker::search
