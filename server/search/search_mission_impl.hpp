/// \file
/// Implementation of SearchMission; no other file includes it.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/nav/known_floor.hpp"
#include "server/search/detection_tracker.hpp"
#include "server/search/search_mission.hpp"
#include "server/search/strategy.hpp"
#include "server/search/target_visit.hpp"

namespace seeker::search {

class SearchMission::Impl {
 public:
  Impl(SearchRequest request, const SearchParams& params, const std::shared_ptr<const ControlTable>& table);

  [[nodiscard]] SearchStep step(const SearchInput& input);
  void add_looks(const std::vector<Look>& looks);
  void resume(RobotTime now);
  void transform(const MapMove& move);

  [[nodiscard]] EvidenceReport evidence_report() const;

  SearchRequest request_;
  SearchParams params_;
  nav::FloorSource floors_;
  nav::KnownFloor known_floor_;
  EvidenceGrid evidence_;
  DetectionTracker tracker_;
  LocalPlanner planner_;
  std::unique_ptr<CoverageStrategy> strategy_;
  TargetVisit visit_;
  CoverageSummary summary_;
  double path_length_m_ = 0.0;
  Matrix3 pose_covariance_ = Matrix3::Zero();  ///< pose covariance of the last step, for pictures taken since

 private:
  /// Pictures from one place whose sightings are in the tracker and whose evidence waits for the next step's map.
  struct PendingLook {
    Point2 camera_map;
    std::vector<std::uint64_t> seen;
  };
  [[nodiscard]] StrategyInput strategy_input(const SearchInput& input);
  void account(const SearchInput& input, SearchStep& out);
  void note_floor(const Point2& robot_map, RobotTime now);
  void process_looks(const StrategyInput& input, SearchStep& out);
  void process_look(const PendingLook& look, const StrategyInput& input, SearchStep& out);
  void note_sighting(std::uint64_t id, const StrategyInput& input, SearchStep& out);
  void note_confirmed(const Detection& detection, const StrategyInput& input, SearchStep& out);
  /// Begins to look at the next unconfirmed sighting from another place, if one is due; doubtful ones wait for a few
  /// pictures unless `doubtful_too`.
  bool confirm_next(RobotTime now, bool doubtful_too);
  void run_visit(const StrategyInput& input, SearchStep& out);
  void run_cover(const StrategyInput& input, SearchStep& out);
  void hand_over(StrategyStep&& from, const StrategyInput& input, SearchStep& out);
  void settle_image(const StrategyInput& input, SearchStep& out);
  void image_taken(const StrategyInput& input);
  [[nodiscard]] std::vector<UnreachablePlace> unreachable_places() const;
  void finish(EndKind kind, std::string cause, std::string remedy, SearchStep& out);
  void finish_found(std::uint64_t id, SearchStep& out);
  [[nodiscard]] std::string not_found() const;
  void finish_covered(const StrategyStep& step, const StrategyInput& input, SearchStep& out);
  [[nodiscard]] bool out_of_reach(const Detection& detection) const;
  [[nodiscard]] bool refused_before(const Detection& detection) const;
  void note_refusal(std::uint64_t id);
  /// Approaches a target that was confirmed while another one was approached, if there is one.
  void approach_next(RobotTime now);
  [[nodiscard]] std::string name_of(int target) const;
  [[nodiscard]] double smallest_target_m() const;

  std::shared_ptr<const nav::FloorView> noted_floor_;  ///< the last view that was added to known_floor_
  std::optional<RobotTime> floor_noted_at_;
  std::deque<PendingLook> looks_;
  /// A sighting that is to be confirmed.
  struct Unconfirmed {
    std::uint64_t id = 0;
    int looks = 0;  ///< pictures since
  };
  std::deque<Unconfirmed> to_confirm_;
  std::set<std::uint64_t> sighted_;    ///< detections reported as sighting
  std::set<std::uint64_t> confirmed_;  ///< detections reported as confirmed
  std::vector<Point2> refused_;        ///< places where confirming failed, frame `map`
  /// Places from where confirming failed, each with the heading towards what was seen in no place that was found.
  std::vector<Pose2> refused_bearings_;
  std::optional<SearchEnd> end_;
  std::optional<RobotTime> waiting_since_;   ///< since when the mission waits for a picture
  std::optional<RobotTime> standing_since_;  ///< since when the robot stands
  Pose2 last_pose_;
  Point2 path_anchor_ = Point2::Zero();
  bool started_ = false;
  bool image_missing_ = false;
  std::uint32_t map_epoch_ = 0;
  RobotTime last_now_;
  Duration paused_{0};
};

}  // namespace seeker::search
