/// \file
/// Fields that several messages of a fleet have.
#pragma once

#include <string>

#include <google/protobuf/repeated_field.h>

#include "common/core/pose2.hpp"
#include "common/wire/check.hpp"

namespace seeker::wire {

/// 1 to 32 characters of a-z, 0-9 and -.
[[nodiscard]] std::string read_robot_id(const std::string& id, Check& check);

/// Nine numbers, row by row, of a field `covariance`.
using CovarianceField = google::protobuf::RepeatedField<double>;
void write_covariance(const Matrix3& from, CovarianceField* to);
void read_covariance(const CovarianceField& from, Matrix3& to, Check& check);

}  // namespace seeker::wire
