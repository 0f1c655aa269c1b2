/// \file
/// What the fake robot answers where that takes more than a line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/support/fake_robot.hpp"

namespace seeker::testing {

/// Who asks is `me`.
[[nodiscard]] Result<api::LeaseState> fake_lease(api::LeaseState& state, api::LeaseAction action,
                                                 const std::string& me);

/// One mission at a time; repeating the one that runs is accepted.
[[nodiscard]] Result<api::MissionAccepted> fake_start_mission(FakeRobotValues& values,
                                                              const api::MissionRequest& request);

/// The mission that runs is stopped by an operator.
void fake_end_mission(FakeRobotValues& values);

[[nodiscard]] tl::unexpected<Error> fake_no_such_map(const std::string& name);
[[nodiscard]] Result<api::MapSummary> fake_find_map(const FakeRobotValues& values, const std::string& name);

[[nodiscard]] std::vector<api::LandmarkSummary> fake_list_landmarks(const FakeRobotValues& values);
[[nodiscard]] Result<api::LandmarkSummary> fake_inspect_landmarks(const FakeRobotValues& values,
                                                                  const std::string& name);
[[nodiscard]] Result<std::vector<api::LandmarkPoint>> fake_landmarks(const FakeRobotValues& values,
                                                                     const std::string& name);
/// Takes a pruning back, once.
[[nodiscard]] Result<api::LandmarkSummary> fake_revert_landmarks(FakeRobotValues& values, const std::string& name);
[[nodiscard]] Result<api::LandmarkSummary> fake_prune_landmarks(FakeRobotValues& values, const std::string& name,
                                                                int min_views);

/// Files in pieces, in memory: no limits, and every hash is believed but that of a file in read.
[[nodiscard]] Result<std::uint64_t> fake_begin_upload(FakeRobotValues& values, const api::FileOffer& offer);
[[nodiscard]] Result<std::uint64_t> fake_upload_piece(FakeRobotValues& values, const api::UploadPiece& piece);
[[nodiscard]] Result<api::UploadedFile> fake_finish_upload(FakeRobotValues& values, const api::UploadEnd& end);
[[nodiscard]] Result<api::FilePiece> fake_read_file(const FakeRobotValues& values, const api::FileRead& wish);

/// Applies `change` to the component of that name; kNotFound when there is none.
[[nodiscard]] Status fake_component(FakeRobotValues& values, const std::string& name,
                                    const std::function<void(api::ComponentInfo&)>& change);
[[nodiscard]] Result<std::vector<api::ComponentSetting>> fake_settings(const FakeRobotValues& values,
                                                                       const std::string& component);
/// The value "bad" is refused.
[[nodiscard]] Result<std::vector<api::ComponentSetting>> fake_set_settings(FakeRobotValues& values,
                                                                           const std::string& component,
                                                                           const std::vector<std::string>& assignments);

}  // namespace seeker::testing
