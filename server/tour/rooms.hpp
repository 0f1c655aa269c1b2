/// \file
/// Rooms of a floor, found by themselves: wide parts, parted where the floor is as narrow as a door.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker::tour {

struct RoomsParams {
  /// Clearance that the middle of a room has and that of a door has not: half the width of the widest door.
  double door_half_m = 0.6;
  double least_room_m2 = 4.0;  ///< a smaller wide part belongs to the room beside it, such as the floor behind a desk
};

/// A graph over rooms and passages.
class Rooms {
 public:
  static constexpr std::uint16_t kNone = 0;

  /// `floor`: 1 = floor that the robot can reach; `clearance_m`: distance to the next obstacle, cell by cell of the
  /// same grid. Every floor cell belongs to one room; rooms are numbered from 1 in the order of their cells.
  static Rooms find(const Grid<std::uint8_t>& floor, const Grid<float>& clearance_m, const RoomsParams& params = {});

  /// The room of a place on the floor or beside it, as of nearest_cell(); kNone: there is none.
  [[nodiscard]] std::uint16_t at(const Point2& p_map) const;
  [[nodiscard]] std::size_t count() const { return neighbours_.size(); }
  /// Fewest passages on a path from the room to every room, by number; index 0 is unused. kUnreached: there is none.
  [[nodiscard]] std::vector<int> passages_from(std::uint16_t room) const;

  static constexpr int kUnreached = -1;

 private:
  Grid<std::uint16_t> rooms_;
  std::vector<std::vector<std::uint16_t>> neighbours_;  ///< rooms beside a room; that of room n at index n - 1
};

}  // namespace seeker::tour
