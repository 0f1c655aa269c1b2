/// \file
/// Values of the robot as JSON (keys in docs/client.md) and as text for people.
#pragma once

#include <string>

#include "client/cli/json.hpp"
#include "common/api/robot_api.hpp"
#include "common/image/map_picture.hpp"

namespace seeker::cli {

void write_json(Json& json, const Pose2& pose);
void write_json(Json& json, const api::Detection& detection);
void write_json(Json& json, const api::Gap& gap);
void write_json(Json& json, const api::CoverageSummary& coverage);
void write_json(Json& json, const DecisionCandidate& candidate);
void write_json(Json& json, const ExploreDecision& decision);
void write_json(Json& json, const api::MissionStatus& mission);
void write_json(Json& json, const api::RobotStatus& status);
void write_json(Json& json, const api::ComponentInfo& component);
void write_json(Json& json, const api::Event& event);
void write_json(Json& json, const api::GridReport& grid);
void write_json(Json& json, const api::MapSummary& map);
void write_json(Json& json, const api::LandmarkSummary& database);
void write_json(Json& json, const MapSegment& segment);
void write_json(Json& json, const api::SegmentUpdate& update);
/// {"topic", "sequence", "dropped", "stamp_s", "data"}; pictures and tiles are told by their sizes, not their content.
void write_json(Json& json, const api::Update& update);

template <class T>
[[nodiscard]] std::string to_json(const T& value) {
  Json json;
  write_json(json, value);
  return json.str();
}

template <class T>
void write_list(Json& json, std::string_view name, const std::vector<T>& values) {
  json.key(name).begin_array();
  for (const T& value : values) {
    if constexpr (std::is_same_v<T, Point2> || std::is_same_v<T, std::string>) {
      json.value(value);
    } else {
      write_json(json, value);
    }
  }
  json.end_array();
}

/// printf-like number with its unit: fixed("%.2f m", x).
[[nodiscard]] std::string fixed(const char* format, double value);
/// "2026-03-01 12:30 UTC"; "-" for 0.
[[nodiscard]] std::string date_of(std::int64_t unix_s);
/// "1 loop", "2 loops".
[[nodiscard]] std::string count_of(std::uint64_t count, const std::string& thing);
[[nodiscard]] std::string size_of(std::uint64_t bytes);
[[nodiscard]] std::string text_of(const Point2& p);
[[nodiscard]] std::string text_of(const Pose2& pose);
/// One line: name, position with sigma, bearing, score, range source, sightings.
[[nodiscard]] std::string text_of(const api::Detection& detection);
[[nodiscard]] std::string text_of(const api::CoverageSummary& coverage);
/// Gaps as a picture marks them.
[[nodiscard]] std::vector<image::GapMark> marks_of(const std::vector<api::Gap>& gaps);
/// One line each, numbered as in a picture (image::listed_gaps).
[[nodiscard]] std::vector<std::string> lines_of(const std::vector<api::Gap>& gaps);
/// One line: number, rule, the reason, how many alternatives there were.
[[nodiscard]] std::string text_of(const ExploreDecision& decision);
/// The place in the map, or that it is not known.
[[nodiscard]] std::string place_text(const PoseEstimate& pose);
/// One line for people about any update.
[[nodiscard]] std::string text_of(const api::Update& update);
/// Largest standard deviation of a position.
[[nodiscard]] double sigma_m(const Matrix2& covariance_m2);

}  // namespace seeker::cli
