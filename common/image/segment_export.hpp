/// \file
/// Maps of segments for other programs: SVG to look at, GeoJSON to compute with.
#pragma once

#include <string>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/result.hpp"

namespace seeker::image {

/// What the picture shows, in the frame `map`.
struct SegmentScene {
  std::string title;
  std::vector<MapSegment> segments;
  std::vector<Pose2> trajectory;
};

/// Walls as strokes, physical ends as filled and limits of what was seen as open circles, the trajectory dashed, and a
/// scale bar. Error: kNotReady when there is nothing to draw.
[[nodiscard]] Result<std::string> segments_svg(const SegmentScene& scene);

/// A FeatureCollection with one LineString per segment, from its left end to its right one, and the properties `id`,
/// `length_m`, `hits`, `sigma_m` (across the wall), `sigma_rad`, `left_real`, `right_real`. Coordinates are metres in
/// the robot's frame `map`, not longitude and latitude: the member `coordinate_frame` says so.
[[nodiscard]] std::string segments_geojson(const std::vector<MapSegment>& segments);

}  // namespace seeker::image
