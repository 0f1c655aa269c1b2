/// \file
/// How much of what a scan shows is in other local maps already.
#pragma once

#include <memory>
#include <vector>

#include "server/slam/map_agreement.hpp"
#include "server/slam/place_recogniser.hpp"

namespace seeker::slam {

/// A local map and where it lies.
struct PlacedMap {
  Pose2 node_T_map;
  std::shared_ptr<const PlaceMap> place;  ///< never null
};

/// What a scan shows, in one frame: surfaces, and places of the floor that its beams pass.
struct ScanView {
  SeenPoints surfaces;
  std::vector<Point2> floor;
};

/// Places of the floor that a scan's beams pass up to a range, in the frame `base`. A beam that met nothing passes
/// floor up to that range.
[[nodiscard]] std::vector<Point2> passed_floor(const LaserScan& scan, double range_m);
[[nodiscard]] ScanView transform(const Pose2& a_T_b, const ScanView& view_b);

/// Share, 0 to 1, of the view's surfaces and places of the floor that at least one of the local maps shows as such; 0
/// for an empty view.
[[nodiscard]] double known_share(const ScanView& view_map, const std::vector<PlacedMap>& maps);

}  // namespace seeker::slam
