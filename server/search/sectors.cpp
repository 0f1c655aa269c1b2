#include "server/search/sectors.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::search {
namespace {

constexpr double kFrontLimit_rad = deg_to_rad(20.0);
constexpr double kFlankLimit_rad = deg_to_rad(70.0);
constexpr double kSideLimit_rad = deg_to_rad(110.0);
/// Bearings of the Pioneer's front array, along which virtual walls are looked for.
constexpr std::array<double, 8> kRingBearings_deg{90.0, 50.0, 30.0, 10.0, -10.0, -30.0, -50.0, -90.0};

}  // namespace

std::optional<Sector> sector_of(double bearing_rad) {
  const double bearing = wrap_angle(bearing_rad);
  const double size = std::abs(bearing);
  if (size <= kFrontLimit_rad) {
    return Sector::kFront;
  }
  if (size <= kFlankLimit_rad) {
    return bearing > 0.0 ? Sector::kLeftFront : Sector::kRightFront;
  }
  if (size <= kSideLimit_rad) {
    return bearing > 0.0 ? Sector::kLeft : Sector::kRight;
  }
  return std::nullopt;
}

Result<Sectors> fuse_sectors(const SonarScan& scan) {
  Sectors sectors;
  sectors.distance_m.fill(kMaxDistance_m);
  std::array<bool, kSectors> covered{};
  for (const SonarReading& reading : scan.readings) {
    const auto sector = sector_of(reading.base_T_sonar.theta_rad);
    if (!sector) {
      continue;
    }
    const double range = reading.range_m;
    if (std::isnan(range) || range < 0.0) {
      return fail(Errc::kInvalidArgument, "a sonar reads no valid distance; check its cable and driver");
    }
    const auto k = static_cast<std::size_t>(*sector);
    covered[k] = true;
    sectors.distance_m[k] = std::min(sectors.distance_m[k], range);
  }
  if (!std::all_of(covered.begin(), covered.end(), [](bool c) { return c; })) {
    return fail(Errc::kInvalidArgument,
                "the sonar ring leaves a sector of the local planner blind; fit the front array");
  }
  return sectors;
}

Sectors with_virtual_walls(Sectors sectors, const nav::ForbiddenAreas& areas, const Pose2& map_T_base,
                           double ring_radius_m) {
  if (areas.empty()) {
    return sectors;
  }
  for (const double bearing_deg : kRingBearings_deg) {
    const double bearing = deg_to_rad(bearing_deg);
    const auto hit = nav::distance_to_forbidden(areas, map_T_base.translation(), map_T_base.theta_rad + bearing,
                                                kMaxDistance_m + ring_radius_m);
    if (hit) {
      double& distance = sectors.distance_m[static_cast<std::size_t>(*sector_of(bearing))];
      distance = std::min(distance, std::max(0.0, *hit - ring_radius_m));
    }
  }
  return sectors;
}

}  // namespace seeker::search
