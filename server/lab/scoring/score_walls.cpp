#include "server/lab/scoring/score_walls.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include "common/image/files.hpp"
#include "server/drivers/replay/words.hpp"

namespace seeker::lab {
namespace {

using google::protobuf::ListValue;
using google::protobuf::Struct;
using google::protobuf::Value;

/// Coordinates beyond this are damage, not a building.
constexpr double kLargest_m = 1e4;
/// Collections within collections.
constexpr int kMaxDepth = 8;

const Value* member(const Struct& object, const std::string& name) {
  const auto found = object.fields().find(name);
  return found == object.fields().end() ? nullptr : &found->second;
}

std::optional<Point2> point_of(const Value& value) {
  if (!value.has_list_value() || value.list_value().values_size() < 2) {
    return std::nullopt;
  }
  const ListValue& list = value.list_value();
  const Point2 point(list.values(0).number_value(), list.values(1).number_value());
  const bool numbers = list.values(0).kind_case() == Value::kNumberValue &&
                       list.values(1).kind_case() == Value::kNumberValue && point.allFinite() &&
                       point.cwiseAbs().maxCoeff() < kLargest_m;
  return numbers ? std::optional<Point2>(point) : std::nullopt;
}

/// Walks the objects of a document and gathers their geometries.
class Gatherer {
 public:
  Walls walls;

  /// Features, collections and geometries; false where it is none of these.
  bool take(const Struct& object, int depth) {
    const Value* type = member(object, "type");
    if (type == nullptr || type->kind_case() != Value::kStringValue || depth > kMaxDepth) {
      return false;
    }
    const std::string& name = type->string_value();
    if (name == "FeatureCollection") {
      return take_all(member(object, "features"), depth);
    }
    if (name == "GeometryCollection") {
      return take_all(member(object, "geometries"), depth);
    }
    if (name == "Feature") {
      const Value* geometry = member(object, "geometry");
      // A feature may have no geometry: RFC 7946, 3.2.
      return geometry != nullptr && (!geometry->has_struct_value() || take(geometry->struct_value(), depth + 1));
    }
    const Value* coordinates = member(object, "coordinates");
    return coordinates != nullptr && take_geometry(name, *coordinates);
  }

 private:
  bool take_all(const Value* list, int depth) {
    if (list == nullptr || !list->has_list_value()) {
      return false;
    }
    std::uint64_t number = 0;
    for (const Value& item : list->list_value().values()) {
      ++number;
      if (!item.has_struct_value() || !take(item.struct_value(), depth + 1)) {
        walls.bad.add(number, "it is no feature or geometry with finite coordinates");
      }
    }
    return true;
  }

  bool take_geometry(const std::string& type, const Value& coordinates) {
    if (type == "Point") {
      return take_points({&coordinates, 1});
    }
    if (!coordinates.has_list_value()) {
      return false;
    }
    const auto& values = coordinates.list_value().values();
    if (type == "LineString") {
      return take_line(coordinates.list_value());
    }
    bool good = type == "MultiPoint" || type == "MultiLineString" || type == "Polygon";
    for (const Value& value : values) {
      good = good && (type == "MultiPoint" ? take_points({&value, 1})
                                           : value.has_list_value() && take_line(value.list_value()));
    }
    return good;
  }

  bool take_points(std::span<const Value> values) {
    for (const Value& value : values) {
      const std::optional<Point2> point = point_of(value);
      if (!point) {
        return false;
      }
      walls.points.push_back(*point);
    }
    return true;
  }

  bool take_line(const ListValue& list) {
    std::vector<Point2> corners;
    for (const Value& value : list.values()) {
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
  Struct document;
  const auto parsed = google::protobuf::util::JsonStringToMessage(std::string(text), &document);
  if (!parsed.ok()) {
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
  const Result<std::vector<std::uint8_t>> bytes = image::read_file(path);
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
