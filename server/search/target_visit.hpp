/// \file
/// Visits of a detected target: observing it from a second place to confirm it, or approaching it to refine its
/// position.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "server/search/detection_tracker.hpp"
#include "server/search/drive_to.hpp"

namespace seeker::search {

enum class VisitResult : std::uint8_t { kBusy, kConfirmed, kRefused, kReached };

/// Makes one visit at a time. Confirming: observe from up to confirm_looks other places until the track is confirmed;
/// when time or observations are used up, the track is refused. Approaching: drive to standoff_m in front, rotate to
/// face it, and observe; a target that cannot be reached is observed from where the robot arrived.
class TargetVisit {
 public:
  TargetVisit(const SearchParams& params, LocalPlanner planner, bool use_map);

  void begin_confirm(std::uint64_t id, RobotTime now) { begin(id, false, now); }
  void begin_approach(const Detection& detection, RobotTime now) {
    begin(detection.id, true, now);
    sightings_before_ = detection.sightings;
    misses_before_ = detection.misses;
  }
  [[nodiscard]] bool active() const { return active_; }
  [[nodiscard]] bool approaching() const { return active_ && approach_; }
  [[nodiscard]] std::uint64_t id() const { return id_; }

  /// Fills command, phase, activity, wants_image and planned_path of `out`.
  [[nodiscard]] VisitResult step(const StrategyInput& input, const DetectionTracker& tracker, StrategyStep& out);
  void image_taken();
  void interrupted();

 private:
  enum class State : std::uint8_t { kPlan, kDrive, kFace, kLook };

  void begin(std::uint64_t id, bool approach, RobotTime now);
  [[nodiscard]] VisitResult finish(VisitResult result);
  [[nodiscard]] std::optional<VisitResult> approach_verdict(const Detection& detection, double spent_s) const;
  [[nodiscard]] std::optional<VisitResult> verdict(const Detection& detection, RobotTime now) const;
  void plan(const StrategyInput& input, const DetectionTracker& tracker, const Detection& detection);
  void plan_approach(const StrategyInput& input, const Detection& detection);
  void plan_confirm(const StrategyInput& input, const DetectionTracker& tracker, const Detection& detection);
  void face(const StrategyInput& input, const Detection& detection, StrategyStep& out);
  void drive(const StrategyInput& input, StrategyStep& out);

  MissionParams params_;
  double new_place_m_;
  double sure_score_;
  DriveTo drive_;
  std::uint64_t id_ = 0;
  bool active_ = false;
  bool approach_ = false;
  bool arrived_ = false;
  int looks_ = 0;
  int sightings_before_ = 0;  ///< sightings of the track when the visit began
  int misses_before_ = 0;
  Point2 here_ = Point2::Zero();     ///< where the robot stands while it observes
  std::vector<Point2> viewed_from_;  ///< places of this visit's observations
  State state_ = State::kPlan;
  RobotTime started_;
  RobotTime face_since_;
};

/// The place with the lowest path cost on circles about `p_map` from which it can be seen, at least `away_m` from all
/// `others`. The radii are tried in order, and the first that has such a place is used.
[[nodiscard]] std::optional<Point2> viewpoint_about(const nav::FloorView& floor, const Pose2& map_T_base,
                                                    const Point2& p_map, const std::vector<double>& radii_m,
                                                    const std::vector<Point2>& others, double away_m);

}  // namespace seeker::search
