/// \file
/// Simple polygons: bounds of a mission and keep-out areas, in the frame `map`.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"

namespace seeker {

/// Corners in order (either direction), not closed: the last corner joins the first.
using Polygon = std::vector<Point2>;

/// Accepts 3..kMaxPolygonCorners finite corners, an area above zero and no edge that crosses another.
[[nodiscard]] Status validate_polygon(const Polygon& polygon);
inline constexpr std::size_t kMaxPolygonCorners = 256;

/// Points on the border may fall on either side.
[[nodiscard]] bool contains(const Polygon& polygon, const Point2& p);
/// Signed area, positive for counter-clockwise corners.
[[nodiscard]] double signed_area_m2(const Polygon& polygon);
/// Distance from p to the nearest edge.
[[nodiscard]] double distance_to_edge_m(const Polygon& polygon, const Point2& p);
/// Distance from p to the segment a-b.
[[nodiscard]] double distance_to_segment_m(const Point2& a, const Point2& b, const Point2& p);
/// True when the closed segments a-b and c-d share a point.
[[nodiscard]] bool segments_intersect(const Point2& a, const Point2& b, const Point2& c, const Point2& d);

}  // namespace seeker
