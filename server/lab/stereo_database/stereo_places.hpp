/// \file
/// Robots that wake up somewhere and ask where they are: by one view, and as mission `localise` does, by turning about.
/// For s2_run.cpp.
#pragma once

#include "server/lab/stereo_database/stereo_parts.hpp"

namespace seeker::lab::stereo {

inline constexpr int kPlaceHeadings = 12;         ///< looks of a robot that turns about, as mission `localise` has them
inline constexpr double kWrongPlace_m = 0.3;      ///< an answer farther off is wrong,
inline constexpr double kWrongPlace_rad = 0.087;  ///< or one turned by more (5 degrees)

/// A robot that turns about until it is LOCALISED, or has looked everywhere.
struct Awakening {
  bool at_once = false;        ///< its first view alone told a place
  bool at_once_wrong = false;  ///< and a wrong one
  bool found = false;
  bool wrong = false;
  int looks = 0;
  int refused = 0;             ///< of these: pictures that the check of the camera did not let pass
  double relocalise_ms = 0.0;  ///< of the first view, its features apart
};
[[nodiscard]] Result<Awakening> wake_up(const Bench& bench, const Database& database, const sim::World& world,
                                        const Pose2& world_T_base, std::uint64_t seed);

/// Single views of a room that the database knows nothing of.
struct ForeignViews {
  int found = 0;
  int empty = 0;  ///< views without a feature: blank, or refused
  std::vector<double> relocalise_ms;
};
[[nodiscard]] Result<ForeignViews> look_at_foreign(const Bench& bench, const Database& database,
                                                   const sim::World& world, int views, Rng& rng);

}  // namespace seeker::lab::stereo
