/// \file
/// Sonar ring -> the five sectors of the local planner (spec S3.1), and walls that exist only in the mission.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/core/polygon.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "server/search/fuzzy_rules.hpp"

namespace seeker::search {

/// Distance per sector, in the order of Sector, metres, clipped to [0, 3].
struct Sectors {
  std::array<double, kSectors> distance_m{};

  [[nodiscard]] double operator[](Sector sector) const { return distance_m[static_cast<std::size_t>(sector)]; }
  friend bool operator==(const Sectors&, const Sectors&) = default;
};

/// Sector a direction of the base belongs to: |bearing| <= 20 deg front, <= 70 deg front flank, <= 110 deg side (the
/// Pioneer's +-10, +-30 and +-50, +-90); behind: none.
[[nodiscard]] std::optional<Sector> sector_of(double bearing_rad);

/// Smallest reading of each sector, "no return" counting as 3 m. Refuses NaN and negative readings, and a ring that
/// leaves a sector without a transducer: the caller must stop.
[[nodiscard]] Result<Sectors> fuse_sectors(const SonarScan& scan);

/// Where the robot must not go: outside `bound` and inside any of `keep_out`, frame `map`.
struct ForbiddenAreas {
  std::optional<Polygon> bound;
  std::vector<Polygon> keep_out;

  [[nodiscard]] bool outside_bound(const Point2& p_map) const;
  [[nodiscard]] bool in_keep_out(const Point2& p_map) const;
  [[nodiscard]] bool allows(const Point2& p_map) const { return !outside_bound(p_map) && !in_keep_out(p_map); }
  [[nodiscard]] bool empty() const { return !bound && keep_out.empty(); }
};

/// Distance along a ray to the first border that leads from allowed to forbidden ground; nothing within `max_m`.
[[nodiscard]] std::optional<double> distance_to_forbidden(const ForbiddenAreas& areas, const Point2& from_map,
                                                          double direction_rad, double max_m);

/// Borders of forbidden areas count as walls for the planner: each sector becomes the smaller of the sonar's and the
/// border's distance (seen from the transducers' ring, `ring_radius_m` from the centre).
[[nodiscard]] Sectors with_virtual_walls(Sectors sectors, const ForbiddenAreas& areas, const Pose2& map_T_base,
                                         double ring_radius_m);

}  // namespace seeker::search
