/// \file
/// Values of the robot as text for people. As JSON: values_json.hpp.
#pragma once

#include <string>

#include "common/api/robot_api.hpp"
#include "common/image/map_picture.hpp"

namespace seeker::cli {

/// A number in a printf format that holds its unit: fixed("%.2f m", x).
[[nodiscard]] std::string fixed(const char* format, double value);
/// A time as "2026-03-01 12:30 UTC"; "-" for 0.
[[nodiscard]] std::string date_of(std::int64_t unix_s);
/// A count with its noun in singular or plural: "1 loop", "2 loops".
[[nodiscard]] std::string count_of(std::uint64_t count, const std::string& noun);
[[nodiscard]] std::string size_of(std::uint64_t bytes);
[[nodiscard]] std::string text_of(const Point2& p);
[[nodiscard]] std::string text_of(const Pose2& pose);
/// A detection in one line: name, position with sigma, bearing, score, range source, sightings.
[[nodiscard]] std::string text_of(const api::Detection& detection);
[[nodiscard]] std::string text_of(const api::CoverageSummary& coverage);
/// Who holds the lease and who asks for it, in one line.
[[nodiscard]] std::string text_of(const api::LeaseState& lease);
/// "event after 2 s, return after 30 s"; the short form where a robot of older software says no more.
[[nodiscard]] std::string text_of(const api::LinkSteps& steps, api::LinkPolicy short_form);
/// "silent for 3 s, return in 27 s".
[[nodiscard]] std::string text_of(const api::LinkCountdown& countdown);
/// The gaps of a search as marks of a picture.
[[nodiscard]] std::vector<image::GapMark> marks_of(const std::vector<api::Gap>& gaps);
/// The gaps of a search, one line each, numbered as in a picture (image::listed_gaps).
[[nodiscard]] std::vector<std::string> lines_of(const std::vector<api::Gap>& gaps);
/// A decision of an exploration in one line: number, rule, count of candidates, reason.
[[nodiscard]] std::string text_of(const ExploreDecision& decision);
/// A topology in one line: its nodes, edges and goals, and the goal that the robot drives to.
[[nodiscard]] std::string text_of(const RobotTopology& robot);
/// The pose of the robot in the map, or that it is not known.
[[nodiscard]] std::string place_text(const PoseEstimate& pose);
/// One line for people about any update.
[[nodiscard]] std::string text_of(const api::Update& update);
/// Largest standard deviation of a position.
[[nodiscard]] double sigma_m(const Matrix2& covariance_m2);

}  // namespace seeker::cli
