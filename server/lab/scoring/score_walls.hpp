/// \file
/// Walls of a map as line segments and points, read from files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/drivers/replay/line_file.hpp"

namespace seeker::lab {

/// Walls in one frame, in metres.
struct Walls {
  std::vector<std::pair<Point2, Point2>> segments;
  std::vector<Point2> points;
  drivers::BadLines bad;  ///< lines of a CSV file, or geometries, that were skipped
};

/// Parses GeoJSON (RFC 7946) with plane coordinates in metres: LineString, MultiLineString and Polygon become segments,
/// Point and MultiPoint become points, at any depth of features and collections. kParse: no JSON, or no GeoJSON object.
[[nodiscard]] Result<Walls> parse_geojson_walls(std::string_view text);

/// Parses lines `x,y` (a point) and `x1,y1,x2,y2` (a segment).
[[nodiscard]] Walls parse_csv_walls(std::string_view text);

/// Reads a file of either format, which is recognised by the first character. kNotFound, kIo, kTooLarge; kParse when it
/// holds no wall.
[[nodiscard]] Result<Walls> read_walls(const std::filesystem::path& path);

/// The points, and the segments cut into points at most `step_m` apart, both ends included.
[[nodiscard]] std::vector<Point2> sample_walls(const Walls& walls, double step_m);

}  // namespace seeker::lab
