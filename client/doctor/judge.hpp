/// \file
/// What to think of the link to a robot, and of what it says of itself. Values in, findings out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/doctor/own_files.hpp"
#include "common/api/diagnosis.hpp"
#include "common/api/robot_state.hpp"

namespace seeker::doctor {

/// Clocks that are further apart are a warning: lines of logs cannot be put in order any more.
inline constexpr Duration kClockWarning = std::chrono::seconds(1);
/// Clocks that are further apart fail: certificates are believed by the clock.
inline constexpr Duration kClockFailure = std::chrono::minutes(5);
/// A velocity command lives 0.3 s: an answer that takes longer than this makes driving by hand jerky.
inline constexpr Duration kSlowAnswer = std::chrono::milliseconds(150);
/// A loop of which more than this share of ticks is late is a warning.
inline constexpr double kLateShare = 0.001;

/// tls-files and tls-certificate.
[[nodiscard]] std::vector<api::Finding> judge(const OwnFiles& files, pki::CalendarTime now);

/// The versions of this program and of a robot.
[[nodiscard]] api::Finding judge_versions(const std::string& own_version, const api::RobotInfo& robot);

/// Wall clock of the robot minus that of this machine, known to `uncertainty`; nothing: the robot does not say.
[[nodiscard]] api::Finding judge_clocks(const std::optional<Duration>& robot_minus_own, Duration uncertainty);

/// Times of calls and their answers, at least one.
[[nodiscard]] api::Finding judge_round_trips(std::vector<Duration> round_trips);

/// lease, estop, loop, and a finding for each fault.
[[nodiscard]] std::vector<api::Finding> judge(const api::RobotStatus& status);

/// A finding for each component that does not work; one where all do.
[[nodiscard]] std::vector<api::Finding> judge(const std::vector<api::ComponentInfo>& components);

/// Whether a check has failed.
[[nodiscard]] bool has_failed(const std::vector<api::Finding>& findings);

}  // namespace seeker::doctor
