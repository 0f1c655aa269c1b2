/// \file
/// What missions have found and searched: reported as it grows, moved with the map, and forgotten with it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/api/mission.hpp"
#include "common/api/perception.hpp"
#include "common/core/map_move.hpp"
#include "common/core/pose_estimate.hpp"
#include "common/core/topology.hpp"

namespace seeker::app {

/// A correction of the map that is in use.
struct MapCorrection {
  MapMove move;                  ///< takes places in the map before to places in the map now; nothing: it only grew
  std::uint32_t from_epoch = 0;  ///< of the map before: only what belongs to it moves
  std::uint32_t to_epoch = 0;    ///< of the map now
};

/// The mission that a report comes from.
struct FindingsOrigin {
  api::MissionId mission;
  std::uint64_t detection_base = 0;  ///< added to the behaviour's own ids, which count from 1
  std::uint32_t map_epoch = 0;       ///< of the map that its places are in
};

/// Owner of the detections of all missions of this run, of the newest evidence grid, and of the floor that the last
/// search proved. Lives on the loop's thread.
class MissionFindings {
 public:
  /// `on_detection` gets each detection that is new, refined, or withdrawn.
  explicit MissionFindings(std::function<void(const api::Detection&)> on_detection);

  /// Everything that a mission's behaviour reports now. What it has reported before and reports no more is withdrawn:
  /// seen from near, it is not there. So is what an earlier part of a mission that was cut off has found, where this
  /// one finds it again.
  void take_detections(std::vector<api::Detection> reported, const FindingsOrigin& origin);
  /// What a mission had found before the program was cut off.
  void take_back(const std::vector<api::Detection>& found, std::uint32_t map_epoch);
  void take_grid(api::GridReport grid, std::uint32_t map_epoch);
  void keep_searched(SearchedFloor searched, std::uint32_t map_epoch);

  /// A mission begins: of a long list of earlier detections only the newest stay.
  void begin_mission();
  /// Places move with the map; only the grid keeps its epoch.
  void map_moved(const MapCorrection& correction);
  /// Another map takes the place of the present one: what was found and searched in that is no part of it.
  void forget_places();

  /// Of the mission that runs or ran last, and the newest of those before; by rising id.
  [[nodiscard]] const std::vector<api::Detection>& detections() const { return detections_; }
  [[nodiscard]] std::vector<api::Detection> detections_of_epoch(std::uint32_t map_epoch) const;
  [[nodiscard]] const std::optional<api::GridReport>& grid() const { return grid_; }
  /// What the last search that ended has searched, where that belongs to the map of this epoch.
  [[nodiscard]] std::optional<SearchedFloor> searched(std::uint32_t map_epoch) const;

  /// Ids continue above what an earlier run of the program gave out.
  void continue_ids(std::uint64_t highest) { highest_id_ = highest; }
  [[nodiscard]] std::uint64_t highest_id() const { return highest_id_; }

 private:
  void take(api::Detection detection);
  void withdraw(const std::function<bool(const api::Detection&)>& is_refuted);

  std::function<void(const api::Detection&)> on_detection_;
  std::vector<api::Detection> detections_;
  std::optional<api::GridReport> grid_;
  std::optional<SearchedFloor> searched_;
  std::uint32_t searched_epoch_ = 0;
  std::uint64_t highest_id_ = 0;
};

}  // namespace seeker::app
