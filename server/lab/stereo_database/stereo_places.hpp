/// \file
/// Relocalisation from unknown places: by one view, and by rotating on the spot as in mission `localise`. Used by
/// stereo_run.cpp.
#pragma once

#include "server/lab/stereo_database/stereo_parts.hpp"

namespace seeker::lab::stereo {

inline constexpr int kPlaceHeadings = 12;         ///< views of a rotating robot, as in mission `localise`
inline constexpr double kWrongPlace_m = 0.3;      ///< an answer with a larger position error is wrong,
inline constexpr double kWrongPlace_rad = 0.087;  ///< as is one with a larger heading error (5 degrees)

/// A robot that rotates on the spot until it is LOCALISED or has observed all directions.
struct Awakening {
  bool at_once = false;        ///< whether its first view alone gave a place
  bool at_once_wrong = false;  ///< whether that place was wrong
  bool found = false;
  bool wrong = false;
  int looks = 0;
  int refused = 0;             ///< number of views that the check of the camera rejected
  double relocalise_ms = 0.0;  ///< time for the first view, without its features
};
[[nodiscard]] Result<Awakening> wake_up(const Bench& bench, const Database& database, const sim::World& world,
                                        const Pose2& world_T_base, std::uint64_t seed);

/// Single views of a room that is not in the database.
struct ForeignViews {
  int found = 0;
  int empty = 0;  ///< number of views without a feature: blank, or rejected
  std::vector<double> relocalise_ms;
};
[[nodiscard]] Result<ForeignViews> observe_foreign(const Bench& bench, const Database& database,
                                                   const sim::World& world, int views, Rng& rng);

}  // namespace seeker::lab::stereo
