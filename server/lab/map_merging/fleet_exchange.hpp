/// \file
/// What the robots of a fleet exchange in an experiment: their maps and pictures are merged as on the main robot, and
/// each receives what the others have seen.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/app/loop/robot_loop.hpp"
#include "server/app/runtime/update_hub.hpp"
#include "server/fleet/map_merger.hpp"
#include "server/lab/map_merging/fleet_run.hpp"
#include "server/lab/map_merging/fleet_traffic.hpp"
#include "server/nav/shared_floor.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::lab {

/// One robot: its loop, and its map ready for being merged.
struct FleetMember {
  std::string id;
  app::UpdateHub hub;
  std::shared_ptr<sim::Simulation> simulation;
  std::shared_ptr<drivers::Clock> clock;
  std::unique_ptr<app::RobotLoop> loop;
  fleet::PreparedMap map;
  Status ran;
};
using FleetMembers = std::vector<std::unique_ptr<FleetMember>>;

class FleetExchange {
 public:
  /// `members` must outlive it.
  FleetExchange(FleetMembers& members, const FleetSpec& spec, const fleet::MergeParams& merge);

  /// Call between two ticks, while no robot's loop runs.
  void between(RobotTime now);
  /// What it knows of the run at its end.
  void fill(FleetResult& result) const;

 private:
  /// The pose of one robot's map in that of another one.
  struct Relation {
    std::size_t a = 0;
    std::size_t b = 0;
    std::optional<Pose2> a_T_b;
    std::optional<RobotTime> since;
    std::size_t alike = 0;  ///< places whose pictures confirm it
  };

  /// Another robot that is merged with one, and where that one has its map.
  struct Partner {
    Pose2 to_T_from;
    const FleetMember* from = nullptr;
  };

  /// In the frame `map` of the member that receives it.
  struct SeenByOthers {
    nav::SharedFloor floor;
    SharedSides sides;
  };

  void merge(RobotTime now);
  void take_maps();
  [[nodiscard]] std::vector<Partner> partners_of(std::size_t to) const;
  [[nodiscard]] fleet::NodePictures pictures_of(std::size_t member) const;
  void count_false_pair(const fleet::MergeAnswer& answer, const Relation& relation);
  /// Errors of position and angle against where the robots truly began.
  [[nodiscard]] std::pair<double, double> error_of(const Relation& relation) const;
  void deliver(std::size_t to);
  void carry_seen();

  FleetMembers& members_;
  Duration period_;
  bool inject_false_pair_ = false;
  RobotTime next_merge_;
  RobotTime next_seen_;
  RobotTime next_share_;
  std::vector<SeenByOthers> seen_;     ///< by member
  std::vector<FleetTraffic> traffic_;  ///< by member; empty where it is not counted
  fleet::MapMerger merger_;
  std::vector<Relation> relations_;
  int wrong_ = 0;
  int injected_ = 0;
  int false_rejected_ = 0;
  int false_offered_ = 0;
  int false_accepted_ = 0;
};

}  // namespace seeker::lab
