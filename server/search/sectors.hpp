/// \file
/// From a sonar ring to the five sectors of the local planner (spec S3.1), and virtual walls of the mission.
#pragma once

#include <array>
#include <optional>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "server/nav/forbidden_areas.hpp"
#include "server/search/fuzzy_rules.hpp"

namespace seeker::search {

/// Distance per sector, in the order of Sector, metres, clipped to [0, 3].
struct Sectors {
  std::array<double, kSectors> distance_m{};

  [[nodiscard]] double operator[](Sector sector) const { return distance_m[static_cast<std::size_t>(sector)]; }
  friend bool operator==(const Sectors&, const Sectors&) = default;
};

/// The sector that a direction of the base belongs to: |bearing| <= 20 deg front, <= 70 deg front flank, <= 110 deg
/// side (the Pioneer's +-10, +-30 and +-50, +-90). Nothing: it points behind the robot.
[[nodiscard]] std::optional<Sector> sector_of(double bearing_rad);

/// Smallest reading of each sector; "no return" counts as 3 m. It refuses NaN and negative readings, and a ring that
/// leaves a sector without a transducer: the caller must stop.
[[nodiscard]] Result<Sectors> fuse_sectors(const SonarScan& scan);

/// Borders of forbidden areas count as walls for the planner: each sector becomes the smaller of the sonar's and the
/// border's distance (seen from the transducers' ring, `ring_radius_m` from the centre).
[[nodiscard]] Sectors with_virtual_walls(Sectors sectors, const nav::ForbiddenAreas& areas, const Pose2& map_T_base,
                                         double ring_radius_m);

}  // namespace seeker::search
