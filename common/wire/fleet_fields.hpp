/// \file
/// Fields that several messages of a fleet have.
#pragma once

#include <string>
#include <vector>

#include <google/protobuf/repeated_field.h>

#include "common/api/fleet.hpp"
#include "common/wire/check.hpp"
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

}  // namespace seeker::wire
