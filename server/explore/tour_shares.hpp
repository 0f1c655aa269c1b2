/// \file
/// The share of this robot in a tour that several robots drive.
#pragma once

#include <cstddef>
#include <vector>

#include "server/explore/coarse_paths.hpp"
#include "server/explore/tour_places.hpp"
#include "server/tour/route.hpp"

namespace seeker::explore {

/// Indices of the places that this robot visits itself, in rising order: all of them where no other robot explores, see
/// tour::shared_places(). `paths`: on the floor of `input`; `between`: legs between the places, as of tour::RouteCosts;
/// first legs are measured from where the robots are, or were reported. A place to which a robot drives stays with it.
/// Robots are ordered by name, so that all share alike.
[[nodiscard]] std::vector<std::size_t> own_share(const PlaceInput& input, const CoarsePaths& paths,
                                                 const std::vector<TourPlace>& places, const Eigen::MatrixXd& between);

/// The costs of some of the places, by their indices.
[[nodiscard]] tour::RouteCosts costs_among(const tour::RouteCosts& costs, const std::vector<std::size_t>& places);

}  // namespace seeker::explore
