/// \file
/// What the main robot of a fleet found out about two maps, and what robots have found, as it is kept on its disk.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/api/perception.hpp"
#include "seeker/v1/kept.pb.h"
#include "server/fleet/map_merger.hpp"

namespace seeker::app {

void write(const fleet::MergeAnswer& from, v1::KeptPair* to);
/// Trusts nothing: kInvalidArgument for what is no answer of ours. What was rejected before it is not kept.
[[nodiscard]] Result<fleet::MergeAnswer> read_answer(const v1::KeptPair& from);

/// Takes the report of a damaged file: a sentence with what is lost.
using ReportDamage = std::function<void(const std::string&)>;
using DetectionField = google::protobuf::RepeatedPtrField<v1::Detection>;
/// The targets that a robot has found; none where they are damaged, which is reported.
[[nodiscard]] std::vector<api::Detection> read_found(const DetectionField& kept, const std::string& robot_id,
                                                     const ReportDamage& report_damage);

}  // namespace seeker::app
