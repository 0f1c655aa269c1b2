#include "common/core/map_move.hpp"

#include <algorithm>
#include <utility>

namespace seeker {

MapMove::MapMove(const Pose2& new_T_old) : pieces_({{Point2::Zero(), new_T_old}}) {}

MapMove::MapMove(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

bool MapMove::moves() const {
  return std::any_of(pieces_.begin(), pieces_.end(), [](const Piece& piece) { return piece.new_T_old != Pose2{}; });
}

Pose2 MapMove::at(const Point2& p_old) const {
  const auto nearest = std::min_element(pieces_.begin(), pieces_.end(), [&](const Piece& a, const Piece& b) {
    return (a.p_old - p_old).squaredNorm() < (b.p_old - p_old).squaredNorm();
  });
  return nearest != pieces_.end() ? nearest->new_T_old : Pose2{};
}

Point2 operator*(const MapMove& move, const Point2& p_old) { return move.at(p_old) * p_old; }

Pose2 operator*(const MapMove& move, const Pose2& old_T_x) { return move.at(old_T_x.translation()) * old_T_x; }

MapMove inverse(const MapMove& move) {
  std::vector<MapMove::Piece> back;
  back.reserve(move.pieces().size());
  for (const MapMove::Piece& piece : move.pieces()) {
    back.push_back({piece.new_T_old * piece.p_old, inverse(piece.new_T_old)});
  }
  return MapMove(std::move(back));
}

}  // namespace seeker
