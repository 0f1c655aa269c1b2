/// \file
/// Values of the robot as JSON, by nlohmann-json; keys in docs/client.md. The library finds each to_json() beside the
/// type that it is for.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "common/api/robot_api.hpp"

namespace seeker {

void to_json(nlohmann::ordered_json& json, const Pose2& pose);
/// A pose that is not known is written as nulls.
void to_json(nlohmann::ordered_json& json, const PoseEstimate& pose);
void to_json(nlohmann::ordered_json& json, const DecisionCandidate& candidate);
void to_json(nlohmann::ordered_json& json, const ExploreDecision& decision);
void to_json(nlohmann::ordered_json& json, const MapSegment& segment);
void to_json(nlohmann::ordered_json& json, const UnreachablePlace& place);
void to_json(nlohmann::ordered_json& json, const RobotTopology& robot);

namespace api {

void to_json(nlohmann::ordered_json& json, const Detection& detection);
void to_json(nlohmann::ordered_json& json, const Gap& gap);
void to_json(nlohmann::ordered_json& json, const CoverageSummary& coverage);
void to_json(nlohmann::ordered_json& json, const MissionEnd& end);
void to_json(nlohmann::ordered_json& json, const MissionStatus& mission);
void to_json(nlohmann::ordered_json& json, const LinkStep& step);
void to_json(nlohmann::ordered_json& json, const LinkCountdown& countdown);
void to_json(nlohmann::ordered_json& json, const LeaseState& lease);
void to_json(nlohmann::ordered_json& json, const Fault& fault);
void to_json(nlohmann::ordered_json& json, const RobotStatus& status);
void to_json(nlohmann::ordered_json& json, const ComponentPort& port);
void to_json(nlohmann::ordered_json& json, const ComponentLink& link);
void to_json(nlohmann::ordered_json& json, const ComponentInfo& component);
void to_json(nlohmann::ordered_json& json, const ComponentSetting& setting);
void to_json(nlohmann::ordered_json& json, const Event& event);
void to_json(nlohmann::ordered_json& json, const Finding& finding);
void to_json(nlohmann::ordered_json& json, const AuditRecord& record);
void to_json(nlohmann::ordered_json& json, const GridReport& grid);
void to_json(nlohmann::ordered_json& json, const MapSummary& map);
void to_json(nlohmann::ordered_json& json, const LandmarkSummary& database);
void to_json(nlohmann::ordered_json& json, const SegmentUpdate& update);
void to_json(nlohmann::ordered_json& json, const ScanLine& line);
void to_json(nlohmann::ordered_json& json, const LinePacket& packet);
/// The scan itself is summed up: the topic `scan` has it.
void to_json(nlohmann::ordered_json& json, const LineReport& report);
/// {"topic", "sequence", "dropped", "stamp_s", "data"}; pictures and tiles are given by their sizes, not their content.
void to_json(nlohmann::ordered_json& json, const Update& update);

}  // namespace api

namespace cli {

/// An object keeps the order in which its members were written.
using Json = nlohmann::ordered_json;

/// The value, or null where there is none.
template <class T, class Document = Json>
[[nodiscard]] Document or_null(const std::optional<T>& value) {
  return value ? Document(*value) : Document();
}

/// A wall clock, since 1970 and UTC, as "2027-03-01T12:00:00.250Z".
[[nodiscard]] std::string wall_time_text(std::int64_t unix_ns);

/// One document on one line. A number that is not finite becomes null, and bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string json_line(const Json& json);

}  // namespace cli
}  // namespace seeker
