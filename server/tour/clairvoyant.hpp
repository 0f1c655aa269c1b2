/// \file
/// The tour that somebody would drive who knows the building: the yardstick of explorations and searches.
#pragma once

#include <vector>

#include "common/core/result.hpp"
#include "server/tour/coverage.hpp"

namespace seeker::tour {

struct ClairvoyantTour {
  Coverage coverage;
  double open_tour_m = 0.0;         ///< length of the tour that ends at its last viewpoint
  double with_return_m = 0.0;       ///< length of the one that ends where it began
  std::vector<Point2> open_tour;    ///< its path
  std::vector<Point2> with_return;  ///< its path
};

/// Joins the viewpoints of cover() by short tours over the floor that the robot can drive on. An upper bound of the
/// shortest: the cover is greedy and the tours are locally best. It depends on its inputs alone. Errors: those of
/// cover(); kUnreachable: the start is not on that floor.
[[nodiscard]] Result<ClairvoyantTour> clairvoyant_tour(const KnownBuilding& building, const Point2& start,
                                                       const CoverageParams& params = {});

}  // namespace seeker::tour
