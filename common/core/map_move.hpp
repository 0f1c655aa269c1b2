/// \file
/// How a correction moved the places of a map.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"

namespace seeker {

/// A map bends: each piece of it moves as a whole, and a place moves as the nearest piece does. Where the start of a
/// building is held, its far end may move by metres when a loop closes.
class MapMove {
 public:
  struct Piece {
    Point2 p_old = Point2::Zero();  ///< where it lies, in the map before
    Pose2 new_T_old;                ///< takes its places in the map before to the map now
  };

  /// Nothing moves.
  MapMove() = default;
  /// Everything moves as a whole.
  MapMove(const Pose2& new_T_old);  // NOLINT(google-explicit-constructor): it is a special case
  /// Of two pieces as near as each other the first counts. None: nothing moves.
  explicit MapMove(std::vector<Piece> pieces);

  [[nodiscard]] bool moves() const;
  /// The motion of the piece that the place belongs to.
  [[nodiscard]] Pose2 at(const Point2& p_old) const;
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  std::vector<Piece> pieces_;
};

/// A place of the map before, in the map now.
[[nodiscard]] Point2 operator*(const MapMove& move, const Point2& p_old);
[[nodiscard]] Pose2 operator*(const MapMove& move, const Pose2& old_T_x);
/// Takes places of the map now to the map before: exact away from where pieces meet.
[[nodiscard]] MapMove inverse(const MapMove& move);

}  // namespace seeker
