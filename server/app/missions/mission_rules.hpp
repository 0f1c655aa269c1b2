/// \file
/// What holds for missions of every kind.
#pragma once

#include "common/api/mission.hpp"
#include "common/core/pose_estimate.hpp"
#include "common/core/result.hpp"

namespace seeker::app {

/// The return to the start keeps to the ground that the mission may use.
[[nodiscard]] api::ReturnMission return_of(const api::MissionTask& task);

/// kRefused: the robot stands outside the mission's bound, where it would find no floor at all or drive outside it. One
/// whose place is not known is let in.
[[nodiscard]] Status check_start(const api::MissionTask& task, const PoseEstimate& pose);

/// Whether a mission of this end came to it with all done that there was.
[[nodiscard]] bool is_done(api::Outcome outcome);

/// Why the robot was sent home, and how that went.
[[nodiscard]] api::MissionEnd after_return(api::MissionEnd why, const api::MissionEnd& end_of_return);

}  // namespace seeker::app
