/// \file
/// The displacement of the places of a map by a correction, such as a loop closure.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"

namespace seeker {

/// A correction deforms a map: each piece of it moves as a rigid body, and a place moves with the nearest piece. When a
/// loop closes, the start of the map is held and its far end may move by metres.
class MapMove {
 public:
  struct Piece {
    Point2 p_old = Point2::Zero();  ///< position of the piece in the map before the correction
    Pose2 new_T_old;                ///< maps its points from before the correction to after it
  };

  /// The correction that leaves every place where it is.
  MapMove() = default;
  /// The whole map moves as one rigid body.
  MapMove(const Pose2& new_T_old);  // NOLINT(google-explicit-constructor): it is a special case
  /// One displacement for each piece; of two pieces at the same distance the first counts. An empty list moves no
  /// place.
  explicit MapMove(std::vector<Piece> pieces);

  [[nodiscard]] bool moves() const;
  /// Displacement of the piece that is nearest to the place.
  [[nodiscard]] Pose2 at(const Point2& p_old) const;
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  std::vector<Piece> pieces_;
};

/// Maps a point, or a pose, from before the correction to after it.
[[nodiscard]] Point2 operator*(const MapMove& move, const Point2& p_old);
[[nodiscard]] Pose2 operator*(const MapMove& move, const Pose2& old_T_x);
/// The correction from the new map to the old one: exact except near the borders between pieces.
[[nodiscard]] MapMove inverse(const MapMove& move);

}  // namespace seeker
