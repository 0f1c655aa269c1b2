/// \file
/// Parameters of the strategy that plans tours.
#pragma once

#include "server/tour/rooms.hpp"

namespace seeker::explore {

/// Most places of a tour. The time of a decision rises with the square of their number, while the robot drives on.
inline constexpr int kMostTourPlaces = 256;

/// What takes time without being path counts as the path that the robot would drive meanwhile.
struct TourParams {
  double passage_m = 1.5;          ///< cost of a passage from room to room: a room is left when it is finished
  double rotation_m_rad = 1.0;     ///< cost of rotating by a radian
  double free_rotation_rad = 0.6;  ///< rotations up to this blend into the drive
  /// The robot leaves its path for a place beside it whenever it goes there: only what the first rotation exceeds this
  /// by speaks against going there now. Otherwise it passes all rooms of a corridor and comes back for them.
  double aside_rotation_rad = 1.57;
  /// So many times its length the first leg counts: what is near comes first where that makes no longer tour, since
  /// what is expected of the rest may change.
  double first_leg_weight = 1.3;
  double beyond_m = 2.5;  ///< no border is expected to lead farther than this into the unknown
  /// Walls are expected to go on so far beyond what was seen of them; less than a door is wide.
  double expected_wall_m = 0.6;
  /// Longest detour for every square metre of floor that a place is expected to show.
  double detour_m_m2 = 10.0;
  double room_m2 = 2.0;          ///< a place that is expected to show this much is worth any detour
  double passing_m = 0.1;        ///< longest detour for an opening that does not matter by itself
  double passing_wall = 0.6;     ///< so much longer it may be for every metre of a wall's unseen side
  double passing_near_m = 4.0;   ///< such openings count only this near to the robot
  double hysteresis_m = 1.0;     ///< another goal while driving, and another order, must save this much
  double replan_period_s = 1.0;  ///< the tour is planned again this often while the robot drives
  /// Speed in place of the driver's: obstacles, corners and the end of the path slow the robot as they must.
  double max_v_m_s = 0.75;
  /// The robot turns on the spot beyond this heading error only: smaller turns are driven as arcs.
  double rotate_in_place_rad = 1.0;
  double look_s = 0.3;               ///< how long the robot stands at a place that the drive did not settle
  int max_places = kMostTourPlaces;  ///< number of places of a tour; farther ones wait
  /// A robot whose share is empty waits for the others so long before it sees itself to what is left.
  double share_wait_s = 60.0;
  /// And so long where none of them drives, since each may think that what is left is the share of another.
  double idle_wait_s = 3.0;
  double together_m = 1.0;  ///< openings of a room within this distance of each other are one place of the tour
  tour::RoomsParams rooms;
};

}  // namespace seeker::explore
