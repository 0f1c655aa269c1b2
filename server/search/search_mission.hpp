/// \file
/// The whole search: coverage, looking, confirming, approaching, ending. Stepped by the robot loop; pure.
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

/// What the robot knows at one control step.
struct SearchInput {
  RobotTime now;
  Pose2 map_T_base;
  Matrix3 covariance = Matrix3::Zero();  ///< of (x, y, theta)
  const SonarScan* sonar = nullptr;      ///< null: no ring fitted
  const LaserScan* laser = nullptr;      ///< null: none fitted
  const nav::OccupancyMap& map;
  std::uint32_t map_epoch = 0;
  MapViews map_views = {};  ///< strategy kPlan only: the search goes on until none of them is worth a drive
};

/// The answer to one control step.
struct SearchStep {
  Twist2 command;
  bool wants_image = false;   ///< take a picture, recognise, answer with on_sightings()
  bool while_moving = false;  ///< the picture may be taken in motion; otherwise the robot stands and waits for it
  std::string phase;          ///< "cover", "escape", "look", "confirm", "approach", "stopped", "done"
  std::string activity;       ///< what the robot does and why, one sentence
  std::vector<SearchEvent> events;
  std::vector<Point2> planned_path;  ///< frame `map`
  std::optional<SearchEnd> end;      ///< present from the last step on
};

/// A search mission. Not thread-safe; everything it does follows from its inputs.
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

  /// One control step, 10 Hz. After the end it repeats the end with a zero command.
  [[nodiscard]] SearchStep step(const SearchInput& input);

  /// The answer to wants_image: everything recognised in one picture (also nothing), with the pose and the readings at
  /// its exposure. Answers nobody asked for are welcome too (they add evidence).
  void on_sightings(RobotTime stamp, const Pose2& map_T_base_at_exposure,
                    const std::vector<vision::Sighting>& sightings, const LaserScan* laser, const SonarScan* sonar);

  /// The same by several pictures that together show all around one place: evidence counts them as one look. Their
  /// covariances are filled in here.
  void on_looks(std::vector<Look> looks);

  /// Between pause and resume nothing times out; step() must not be called. The robot may have been moved meanwhile.
  void pause();
  void resume(RobotTime now);

  /// The map moved (new epoch): `move` takes old map coordinates to new ones. Moves lists, evidence, detections.
  void transform(const MapMove& move);

  /// Evidence of an earlier search, for SearchRequest::gaps_only. Before the first step.
  void keep_evidence(EvidenceGrid evidence);
  [[nodiscard]] const EvidenceGrid& evidence() const;
  /// What other robots have searched, frame `map`; replaces what was said before. Only searches for all targets of this
  /// one count.
  void set_others(const std::vector<SearchedFloor>& others);

  [[nodiscard]] const GridLists& lists() const;
  /// Every track that has not been refuted, in the order of ids.
  [[nodiscard]] std::vector<Detection> detections() const;
  /// Certificate over the floor reachable now; from the map of the last step.
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
