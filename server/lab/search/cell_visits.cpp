#include "server/lab/search/cell_visits.hpp"

namespace seeker::lab {

void CellVisits::add(const Point2& p) {
  const CellIndex cell = frame_.cell_of(p);
  const Point2 off_centre = (p - frame_.centre_of(cell)).cwiseAbs();
  const bool inside = off_centre.maxCoeff() <= frame_.resolution_m / 2.0 - margin_m_;
  if (!inside || cell == current_) {
    return;
  }
  current_ = cell;
  cells_.insert(cell);
  ++entries_;
}

}  // namespace seeker::lab
