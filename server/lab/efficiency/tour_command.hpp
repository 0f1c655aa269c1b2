/// \file
/// The verb `tour`: what somebody would drive who knows the building.
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/tour/clairvoyant.hpp"

namespace seeker::lab {

struct TourOptions {
  /// A world of the simulator, or the YAML file of a ROS map (one that names an `image`).
  std::filesystem::path building;
  double robot_radius_m = 0.27;
  double scanner_height_m = 0.30;      ///< of a world: what lies in this height is seen
  std::optional<Point2> start = {};    ///< nothing: the world's first start, or the origin of the map
  std::filesystem::path picture = {};  ///< PNG to write; empty: none
  bool json = false;
  tour::CoverageParams coverage = {};
};

/// A building with its tour, for tables and pictures.
struct MeasuredTour {
  tour::KnownBuilding building;
  Point2 start = Point2::Zero();
  tour::ClairvoyantTour tour;
};

/// Errors of the files, and those of tour::clairvoyant_tour().
[[nodiscard]] Result<MeasuredTour> measure_tour(const TourOptions& o);

/// The building with viewpoints and both tours.
[[nodiscard]] Image draw_tour(const MeasuredTour& measured, const std::string& title);

/// Prints the tour to `out` and draws it. Errors: those of measure_tour(); kIo.
[[nodiscard]] Status run_tour(const TourOptions& o, std::ostream& out);

}  // namespace seeker::lab
