#include "server/app/missions/mission_findings.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <Eigen/Cholesky>

namespace seeker::app {
namespace {

/// Chi-square with 2 degrees of freedom, 99 %.
constexpr double kSamePlace_chi2 = 9.21;
/// What earlier missions have found and is still listed: more than anybody reads, and far less than a list may hold.
constexpr std::size_t kMaxEarlierDetections = 1000;

bool is_same_object(const api::Detection& a, const api::Detection& b) {
  if (a.mission != b.mission || a.target != b.target || a.map_epoch != b.map_epoch || !a.position || !b.position) {
    return false;
  }
  const Eigen::LDLT<Matrix2> covariance(a.position_covariance + b.position_covariance);
  const Point2 apart = *a.position - *b.position;
  return covariance.vectorD().minCoeff() > 0.0 && apart.dot(covariance.solve(apart)) < kSamePlace_chi2;
}

}  // namespace

MissionFindings::MissionFindings(std::function<void(const api::Detection&)> on_detection)
    : on_detection_(std::move(on_detection)) {}

void MissionFindings::take_detections(std::vector<api::Detection> reported, const FindingsOrigin& origin) {
  for (api::Detection& detection : reported) {
    detection.id += origin.detection_base;
    detection.map_epoch = origin.map_epoch;
    detection.mission = origin.mission;
    take(detection);
  }
  withdraw([&](const api::Detection& listed) {
    return listed.id > origin.detection_base &&
           std::none_of(reported.begin(), reported.end(), [&](const api::Detection& d) { return d.id == listed.id; });
  });
  withdraw([&](const api::Detection& listed) {
    return listed.id <= origin.detection_base &&
           std::any_of(reported.begin(), reported.end(),
                       [&](const api::Detection& d) { return is_same_object(d, listed); });
  });
}

void MissionFindings::take(api::Detection detection) {
  const auto known = std::lower_bound(detections_.begin(), detections_.end(), detection.id,
                                      [](const api::Detection& d, std::uint64_t id) { return d.id < id; });
  const bool is_known = known != detections_.end() && known->id == detection.id;
  if (is_known && *known == detection) {
    return;
  }
  highest_id_ = std::max(highest_id_, detection.id);
  on_detection_(detection);
  if (is_known) {
    *known = std::move(detection);
  } else {
    detections_.insert(known, std::move(detection));
  }
}

void MissionFindings::take_back(const std::vector<api::Detection>& found, std::uint32_t map_epoch) {
  for (api::Detection detection : found) {
    detection.map_epoch = map_epoch;
    take(std::move(detection));
  }
}

void MissionFindings::take_grid(api::GridReport grid, std::uint32_t map_epoch) {
  grid.map_epoch = grid.evidence.map_epoch = map_epoch;
  grid_ = std::move(grid);
}

void MissionFindings::keep_searched(SearchedFloor searched, std::uint32_t map_epoch) {
  searched_ = std::move(searched);
  searched_epoch_ = map_epoch;
}

void MissionFindings::begin_mission() {
  if (detections_.size() > kMaxEarlierDetections) {
    detections_.erase(detections_.begin(), detections_.end() - kMaxEarlierDetections);
  }
}

void MissionFindings::withdraw(const std::function<bool(const api::Detection&)>& is_refuted) {
  for (api::Detection detection : detections_) {
    if (is_refuted(detection)) {
      detection.withdrawn = true;
      on_detection_(detection);
    }
  }
  std::erase_if(detections_, is_refuted);
}

void MissionFindings::map_moved(const MapCorrection& correction) {
  const auto& [move, from_epoch, to_epoch] = correction;
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

void MissionFindings::forget_places() {
  detections_.clear();
  searched_.reset();
}

std::vector<api::Detection> MissionFindings::detections_of_epoch(std::uint32_t map_epoch) const {
  std::vector<api::Detection> these;
  std::copy_if(detections_.begin(), detections_.end(), std::back_inserter(these),
               [&](const api::Detection& d) { return d.map_epoch == map_epoch; });
  return these;
}

std::optional<SearchedFloor> MissionFindings::searched(std::uint32_t map_epoch) const {
  return searched_epoch_ == map_epoch ? searched_ : std::nullopt;
}

}  // namespace seeker::app
