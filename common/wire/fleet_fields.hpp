/// \file
/// Fields that several messages of a fleet have.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <google/protobuf/repeated_field.h>

#include "common/api/fleet.hpp"
#include "common/wire/check.hpp"
#include "seeker/v1/fleet.pb.h"
#include "seeker/v1/geometry.pb.h"
#include "seeker/v1/search.pb.h"

namespace seeker::wire {

/// Reads the id of a robot; it must be valid as in api::validate_robot_id().
[[nodiscard]] std::string read_robot_id(const std::string& id, Check& check);

/// A field `covariance`: nine numbers, row by row.
using CovarianceField = google::protobuf::RepeatedField<double>;
void write_covariance(const Matrix3& from, CovarianceField* to);
void read_covariance(const CovarianceField& from, Matrix3& to, Check& check);

/// A field `detections`: at most api::kMaxFleetDetections, all within reach.
using DetectionField = google::protobuf::RepeatedPtrField<v1::Detection>;
void write_detections(const std::vector<api::Detection>& from, DetectionField* to);
void read_detections(const DetectionField& from, std::vector<api::Detection>& to, Check& check);
/// Refuses a detection that is not in_reach(): too far away, or with too large a covariance.
void check_reach(const api::Detection& detection, Check& check);

/// The value, or 0 with the field refused where its size is above the limit or it is no number.
double within(double value, double limit, std::string_view field, Check& check);
/// A required pose within api::kMaxFleetReach_m.
[[nodiscard]] Pose2 read_place_pose(bool present, const v1::Pose2& from, std::string_view field, Check& check);

/// A field `others`: `most` robots at most.
void write_others(const std::vector<RobotTopology>& from, v1::FleetReply* to);
void read_others(const v1::FleetReply& from, std::vector<RobotTopology>& to, std::size_t most, Check& check);

}  // namespace seeker::wire
