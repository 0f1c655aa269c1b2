/// \file
/// The behaviours that a robot can run, by the kind of mission and by what the robot has.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "server/app/composition/robot_options.hpp"
#include "server/app/composition/stereo_missions.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/app/missions/explore_behaviour.hpp"
#include "server/app/missions/goto_behaviour.hpp"
#include "server/app/missions/search_behaviour.hpp"

namespace seeker::app {

/// What all searches of a robot share, without a model of solids. Errors name the field of the robot file that is
/// wrong.
[[nodiscard]] Result<SearchTools> make_search_tools(const RobotOptions& options);
/// Reads the model of solids that the robot file names. Errors leave the one there was.
[[nodiscard]] Status load_solids_into(const RobotOptions& options, SearchTools& tools);

/// A BehaviourFactory; holds what the missions of a robot share. Each mission goes by the options as they are when it
/// starts.
class RobotBehaviours {
 public:
  /// `stereo` is nothing where the robot has no stereo camera.
  RobotBehaviours(std::shared_ptr<const RobotOptions> options, std::shared_ptr<const SearchTools> tools,
                  bool has_camera, std::optional<StereoMissions> stereo);

  /// kRefused where the robot has not what the mission needs.
  [[nodiscard]] Result<std::unique_ptr<Behaviour>> operator()(const api::MissionTask& task, const Situation& situation);

 private:
  [[nodiscard]] Result<std::unique_ptr<Behaviour>> return_to_start(const api::ReturnMission& mission) const;
  [[nodiscard]] Result<std::unique_ptr<Behaviour>> search(const api::SearchMission& mission,
                                                          const Situation& situation) const;

  [[nodiscard]] std::vector<api::TargetSpec> as_recognised(std::vector<api::TargetSpec> targets) const;

  std::shared_ptr<const RobotOptions> options_;
  std::shared_ptr<const SearchTools> tools_;
  bool has_camera_;
  std::optional<StereoMissions> stereo_;
};

}  // namespace seeker::app
