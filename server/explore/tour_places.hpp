/// \file
/// Openings as places of a tour: with the nearest viewpoint that shows each, its room, and what it is worth.
#pragma once

#include <cstdint>
#include <vector>

#include "server/explore/place_strategy.hpp"
#include "server/tour/rooms.hpp"

namespace seeker::explore {

/// A place of the tour: an opening, and those beside it that are seen with it.
struct TourPlace {
  Opening opening;  ///< the one that the robot drives to
  /// The cheapest place that shows it: so far the tour leads, frame `map`. Of a place that is only passed the viewpoint
  /// itself.
  Point2 seen_from_map;
  std::vector<std::uint64_t> ids;  ///< of all openings of the place
  double gain_m2 = 0.0;            ///< unknown floor in sight of the opening
  std::uint16_t room = tour::Rooms::kNone;
};

struct TourPlaces {
  std::vector<TourPlace> worth_it;  ///< what the tour visits, in order of rising path cost
  std::vector<TourPlace> passing;   ///< what is taken only where the path passes by: little floor, ends of walls
};

/// Rooms of the snapshot's reachable floor.
[[nodiscard]] tour::Rooms rooms_of(const nav::FloorView& floor, const tour::RoomsParams& params);

/// The openings of a decision as places. The robot drives towards a border itself, but it counts as visited where it
/// comes into view.
[[nodiscard]] TourPlaces tour_places(const PlaceInput& input, const tour::Rooms& rooms, const ExploreParams& params);

}  // namespace seeker::explore
