#include "server/explore/view_gain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::explore {
namespace {

constexpr int kRays = 120;
constexpr double kStep_m = 0.1;
/// So much unknown floor behind each other is believed.
constexpr double kDeepest_m = 3.0;

double along_ray(const nav::CostMap& map, const Grid<std::uint8_t>* walls, const Point2& from_map, double angle_rad,
                 double range_m) {
  const Point2 direction(std::cos(angle_rad), std::sin(angle_rad));
  double area_m2 = 0.0;
  double unknown_m = 0.0;
  for (double r = kStep_m; r <= range_m && unknown_m < kDeepest_m; r += kStep_m) {
    const CellIndex cell = map.frame().cell_of(from_map + r * direction);
    const nav::CellState state = map.state(cell);
    const bool expected = walls != nullptr && walls->contains(cell) && (*walls)[cell] != 0;
    if (state == nav::CellState::kOccupied || expected) {
      break;
    }
    if (state == nav::CellState::kUnknown) {
      unknown_m += kStep_m;
      area_m2 += r * kStep_m * kTwoPi / kRays;
    }
  }
  return area_m2;
}

}  // namespace

ViewGain view_gain(const nav::CostMap& map, const Point2& from_map, const SensorModel& sensor,
                   const Grid<std::uint8_t>* walls) {
  std::array<double, kRays> rays{};
  for (int k = 0; k < kRays; ++k) {
    rays[static_cast<std::size_t>(k)] = along_ray(map, walls, from_map, kTwoPi * k / kRays, sensor.range_m);
  }
  const int half = std::clamp(static_cast<int>(sensor.half_angle_rad / kTwoPi * kRays), 0, (kRays - 1) / 2);
  const auto ray = [&](int k) { return rays[static_cast<std::size_t>((k + kRays) % kRays)]; };
  double window = 0.0;
  for (int k = -half; k <= half; ++k) {
    window += ray(k);
  }
  ViewGain best{window, 0.0};
  for (int k = 1; k < kRays; ++k) {
    window += ray(k + half) - ray(k - 1 - half);
    if (window > best.area_m2 + 1e-9) {
      best = {window, wrap_angle(kTwoPi * k / kRays)};
    }
  }
  return best;
}

}  // namespace seeker::explore
