// What missions find and search: told as it grows, moved with the map, forgotten with it.

#include <algorithm>

#include <Eigen/Cholesky>

#include "common/api/fleet.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {
namespace {

/// Chi-square with 2 degrees of freedom, 99 %.
constexpr double kSamePlace_chi2 = 9.21;

bool is_same_thing(const api::Detection& a, const api::Detection& b) {
  if (a.mission != b.mission || a.target != b.target || a.map_epoch != b.map_epoch || !a.position || !b.position) {
    return false;
  }
  const Eigen::LDLT<Matrix2> covariance(a.position_covariance + b.position_covariance);
  const Point2 apart = *a.position - *b.position;
  return covariance.vectorD().minCoeff() > 0.0 && apart.dot(covariance.solve(apart)) < kSamePlace_chi2;
}

}  // namespace

void MissionExecutor::map_moved(const MapCorrection& correction, RobotTime now) {
  const auto& [move, from_epoch, to_epoch] = correction;
  if (active_) {
    active_->behaviour->map_moved(move);
    active_->last_pose.reset();
    active_->pose = move * active_->pose;
    if (active_->so_far.start_map) {
      active_->so_far.start_map = move * *active_->so_far.start_map;
    }
    active_->map_epoch = to_epoch;
    if (move.moves()) {
      log(now, "map-moved", "the map was corrected; what was searched and found moved with it");
    }
    collect_detections();  // moved by the behaviour, which knows best how
  }
  for (api::Detection& detection : detections_) {
    if (detection.map_epoch == from_epoch) {
      const Pose2 new_T_old = move.at(detection.map_T_base.translation());
      detection = api::moved(std::move(detection), new_T_old);
      detection.map_epoch = to_epoch;
    }
  }
  if (searched_ && searched_epoch_ == from_epoch) {
    searched_->map_T_grid = move * searched_->map_T_grid;
    searched_epoch_ = to_epoch;
  }
}

void MissionExecutor::collect() {
  collect_grid();
  collect_detections();
}

void MissionExecutor::collect_grid() {
  if (std::optional<api::GridReport> grid = active_->behaviour->grid()) {
    active_->status.cells_searched = static_cast<int>(grid->lists.searched.size());
    active_->status.cells_unsearched = static_cast<int>(grid->lists.unsearched.size());
    active_->status.coverage = grid->evidence.summary;
    grid->map_epoch = grid->evidence.map_epoch = active_->map_epoch;
    grid_ = std::move(grid);
  }
}

void MissionExecutor::collect_detections() {
  std::vector<api::Detection> told = active_->behaviour->detections();
  for (api::Detection& detection : told) {
    detection.id += active_->detection_base;
    detection.map_epoch = active_->map_epoch;
    detection.mission = active_->request.id;
    take(detection);
  }
  withdraw_all_but(told);
  withdraw_found_again(told);
}

void MissionExecutor::take(api::Detection detection) {
  const auto known = std::lower_bound(detections_.begin(), detections_.end(), detection.id,
                                      [](const api::Detection& d, std::uint64_t id) { return d.id < id; });
  const bool is_known = known != detections_.end() && known->id == detection.id;
  if (is_known && *known == detection) {
    return;
  }
  highest_detection_id_ = std::max(highest_detection_id_, detection.id);
  outputs_.detection(detection);
  if (is_known) {
    *known = std::move(detection);
  } else {
    detections_.insert(known, std::move(detection));
  }
}

/// What was found before the program was cut off.
void MissionExecutor::take_back(const std::vector<api::Detection>& found, std::uint32_t map_epoch) {
  for (api::Detection detection : found) {
    detection.map_epoch = map_epoch;
    take(std::move(detection));
  }
}

/// What the behaviour has told and tells no more it has refuted: from near, it is not there.
void MissionExecutor::withdraw_all_but(const std::vector<api::Detection>& told) {
  withdraw([&](const api::Detection& listed) {
    return listed.id > active_->detection_base &&
           std::none_of(told.begin(), told.end(), [&](const api::Detection& d) { return d.id == listed.id; });
  });
}

/// A mission that was cut off and goes on knows nothing of what it found before, and finds it again.
void MissionExecutor::withdraw_found_again(const std::vector<api::Detection>& told) {
  withdraw([&](const api::Detection& listed) {
    return listed.id <= active_->detection_base &&
           std::any_of(told.begin(), told.end(), [&](const api::Detection& d) { return is_same_thing(d, listed); });
  });
}

void MissionExecutor::withdraw(const std::function<bool(const api::Detection&)>& is_none) {
  for (api::Detection detection : detections_) {
    if (is_none(detection)) {
      detection.withdrawn = true;
      outputs_.detection(detection);
    }
  }
  std::erase_if(detections_, is_none);
}

void MissionExecutor::forget_places() {
  detections_.clear();
  searched_.reset();
}

void MissionExecutor::keep_searched() {
  if (auto searched = active_->behaviour->searched(active_->pose.translation(), api::kMaxFleetSearchedSide_cells)) {
    searched_ = std::move(searched);
    searched_epoch_ = active_->map_epoch;
  }
}

std::optional<SearchedFloor> MissionExecutor::searched(const PoseEstimate& at) const {
  auto now = active_ ? active_->behaviour->searched(at.map_T_base.translation(), api::kMaxFleetSearchedSide_cells)
                     : std::nullopt;
  if (!now && searched_epoch_ == at.map_epoch) {
    return searched_;
  }
  return now;
}

}  // namespace seeker::app
