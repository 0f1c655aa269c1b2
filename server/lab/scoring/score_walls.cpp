#include "server/lab/scoring/score_walls.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "common/files/files.hpp"
#include "server/drivers/replay/words.hpp"

namespace seeker::lab {
namespace {

using nlohmann::json;

/// Coordinates beyond this are damage, not a building.
constexpr double kLargest_m = 1e4;
/// Collections within collections.
constexpr int kMaxDepth = 8;

/// Null where the object has no such member.
const json* member(const json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

std::optional<Point2> point_of(const json& value) {
  if (!value.is_array() || value.size() < 2 || !value[0].is_number() || !value[1].is_number()) {
    return std::nullopt;
  }
  const Point2 point(value[0].get<double>(), value[1].get<double>());
  return point.cwiseAbs().maxCoeff() < kLargest_m ? std::optional<Point2>(point) : std::nullopt;
}

/// Walks the objects of a document and gathers their geometries.
class Gatherer {
 public:
  Walls walls;

  /// Features, collections and geometries; false where it is none of these.
  bool take(const json& object, int depth) {
    const json* type = member(object, "type");
    if (type == nullptr || !type->is_string() || depth > kMaxDepth) {
      return false;
    }
    const auto& name = type->get_ref<const std::string&>();
    if (name == "FeatureCollection") {
      return take_all(member(object, "features"), depth);
    }
    if (name == "GeometryCollection") {
      return take_all(member(object, "geometries"), depth);
    }
    if (name == "Feature") {
      const json* geometry = member(object, "geometry");
      // A feature may have no geometry: RFC 7946, 3.2.
      return geometry != nullptr && (!geometry->is_object() || take(*geometry, depth + 1));
    }
    const json* coordinates = member(object, "coordinates");
    return coordinates != nullptr && take_geometry(name, *coordinates);
  }

 private:
  bool take_all(const json* list, int depth) {
    if (list == nullptr || !list->is_array()) {
      return false;
    }
    std::uint64_t number = 0;
    for (const json& item : *list) {
      ++number;
      if (!item.is_object() || !take(item, depth + 1)) {
        walls.bad.add(number, "it is no feature or geometry with finite coordinates");
      }
    }
    return true;
  }

  bool take_geometry(const std::string& type, const json& coordinates) {
    if (type == "Point") {
      return take_point(coordinates);
    }
    if (!coordinates.is_array()) {
      return false;
    }
    if (type == "LineString") {
      return take_line(coordinates);
    }
    bool good = type == "MultiPoint" || type == "MultiLineString" || type == "Polygon";
    for (const json& value : coordinates) {
      good = good && (type == "MultiPoint" ? take_point(value) : value.is_array() && take_line(value));
    }
    return good;
  }

  bool take_point(const json& value) {
    const std::optional<Point2> point = point_of(value);
    if (point) {
      walls.points.push_back(*point);
    }
    return point.has_value();
  }

  bool take_line(const json& list) {
    std::vector<Point2> corners;
    for (const json& value : list) {
      const std::optional<Point2> point = point_of(value);
      if (!point) {
        return false;
      }
      corners.push_back(*point);
    }
    for (std::size_t k = 1; k < corners.size(); ++k) {
      walls.segments.emplace_back(corners[k - 1], corners[k]);
    }
    return corners.size() > 1;
  }
};

}  // namespace

Result<Walls> parse_geojson_walls(std::string_view text) {
  const json document = json::parse(text, nullptr, false);
  if (!document.is_object()) {
    return fail(Errc::kParse, "the text is no JSON object");
  }
  Gatherer gatherer;
  if (!gatherer.take(document, 0)) {
    return fail(Errc::kParse, "the JSON object is no GeoJSON with finite coordinates");
  }
  return std::move(gatherer.walls);
}

Walls parse_csv_walls(std::string_view text) {
  Walls walls;
  std::uint64_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    drivers::Words words(line, drivers::Words::kCommaOrBlank);
    if (words.at_end() || line.front() == '#') {
      continue;
    }
    Point2 a{words.number(), 0.0};
    a.y() = words.number();
    const bool segment = !words.at_end();
    Point2 b{segment ? words.number() : 0.0, 0.0};
    b.y() = segment ? words.number() : 0.0;
    const double largest_m = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
    if (!words.good() || !words.at_end() || largest_m >= kLargest_m) {
      walls.bad.add(number, "the line is not `x,y` or `x1,y1,x2,y2`");
    } else if (segment) {
      walls.segments.emplace_back(a, b);
    } else {
      walls.points.push_back(a);
    }
  }
  return walls;
}

Result<Walls> read_walls(const std::filesystem::path& path) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path);
  if (!bytes) {
    return tl::unexpected<Error>(bytes.error());
  }
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool json = first != std::string_view::npos && text[first] == '{';
  Result<Walls> walls = json ? parse_geojson_walls(text) : parse_csv_walls(text);
  if (!walls) {
    return fail_with_context(path.string(), walls.error());
  }
  if (walls->segments.empty() && walls->points.empty()) {
    return fail(Errc::kParse, path.string() + " holds no wall; it must be GeoJSON, or lines `x,y` or `x1,y1,x2,y2`");
  }
  return walls;
}

std::vector<Point2> sample_walls(const Walls& walls, double step_m) {
  std::vector<Point2> points = walls.points;
  for (const auto& [a, b] : walls.segments) {
    const auto pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step_m)));
    for (int k = 0; k <= pieces; ++k) {
      points.emplace_back(a + (b - a) * (static_cast<double>(k) / pieces));
    }
  }
  return points;
}

}  // namespace seeker::lab
