/// \file
/// The whole search: coverage, taking pictures, confirming, approaching, ending. It is stepped by the robot loop and
/// depends on its inputs alone.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/search/control_table.hpp"
#include "server/search/detection_tracker.hpp"
#include "server/search/evidence.hpp"
#include "server/search/search_params.hpp"
#include "server/search/search_types.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::nav {
class OccupancyMap;
}

namespace seeker::search {

/// The inputs of one control step.
struct SearchInput {
  RobotTime now;
  Pose2 map_T_base;
  Matrix3 covariance = Matrix3::Zero();  ///< covariance of (x, y, theta)
  const SonarScan* sonar = nullptr;      ///< null: no ring fitted
  const LaserScan* laser = nullptr;      ///< null: none fitted
  const nav::OccupancyMap& map;
  std::uint32_t map_epoch = 0;
  /// Strategy kPlan only: the search continues until none of these viewpoints is worth a drive.
  MapViews map_views = {};
};

/// The result of one control step.
struct SearchStep {
  Twist2 command;
  bool wants_image = false;   ///< take a picture, recognise, and call on_sightings() with the result
  bool while_moving = false;  ///< the picture may be taken in motion; otherwise the robot stands and waits for it
  std::string phase;          ///< "cover", "escape", "look", "confirm", "approach", "stopped", "done"
  std::string activity;       ///< what the robot does and why, in one sentence
  std::vector<SearchEvent> events;
  std::vector<Point2> planned_path;  ///< frame `map`
  std::optional<SearchEnd> end;      ///< present from the last step on
};

/// A search mission. It is not thread-safe, and its outputs depend on its inputs alone.
class SearchMission {
 public:
  /// `table` is shared: it is costly to fill and immutable. kInvalidArgument: request or parameters out of bounds.
  [[nodiscard]] static Result<SearchMission> create(const SearchRequest& request, const SearchParams& params,
                                                    const std::shared_ptr<const ControlTable>& table);

  SearchMission(SearchMission&&) noexcept;
  SearchMission& operator=(SearchMission&&) noexcept;
  SearchMission(const SearchMission&) = delete;
  SearchMission& operator=(const SearchMission&) = delete;
  ~SearchMission();

  /// Computes one control step; it is called at 10 Hz. After the end it repeats the end with a zero command.
  [[nodiscard]] SearchStep step(const SearchInput& input);

  /// Response to wants_image: everything recognised in one picture (possibly nothing), with the pose and the readings
  /// at its exposure. Pictures that were not requested may be given too; they add evidence.
  void on_sightings(RobotTime stamp, const Pose2& map_T_base_at_exposure,
                    const std::vector<vision::Sighting>& sightings, const LaserScan* laser, const SonarScan* sonar);

  /// The same for several pictures that together show all directions from one place: evidence counts them as one
  /// observation. Their covariances are filled in here.
  void on_looks(std::vector<Look> looks);

  /// Stops all time limits until resume(); step() must not be called in between. The robot may be moved meanwhile.
  void pause();
  void resume(RobotTime now);

  /// The map was corrected (new epoch): `move` takes old map coordinates to new ones. It moves lists, evidence and
  /// detections.
  void transform(const MapMove& move);

  /// Sets the evidence of an earlier search, for SearchRequest::gaps_only. Call it before the first step.
  void keep_evidence(EvidenceGrid evidence);
  [[nodiscard]] const EvidenceGrid& evidence() const;
  /// Goes on from what an earlier run of this search had seen (EvidenceGrid::own_looks) and listed, frame `map`. Call
  /// it before the first step.
  void take_back(const Grid<std::uint8_t>& looks, const GridLists& lists);
  /// Sets what other robots have searched, frame `map`; it replaces earlier data. Only searches for all targets of this
  /// one count.
  void set_others(const std::vector<SearchedFloor>& others);

  [[nodiscard]] const GridLists& lists() const;
  /// All tracks that have not been refuted, in the order of ids.
  [[nodiscard]] std::vector<Detection> detections() const;
  /// Certificate over the floor that is reachable now, from the map of the last step.
  [[nodiscard]] EvidenceReport evidence_report() const;
  [[nodiscard]] CoverageSummary summary() const;
  /// 0..1: share of the known reachable floor that is covered.
  [[nodiscard]] double progress() const;
  [[nodiscard]] double path_length_m() const;
  [[nodiscard]] const SearchRequest& request() const;

 private:
  class Impl;
  explicit SearchMission(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace seeker::search
