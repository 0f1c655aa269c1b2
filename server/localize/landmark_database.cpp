#include "server/localize/landmark_database.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>

#include "common/core/assert.hpp"

namespace seeker::localize {
namespace {

constexpr int kSalientSeen = 3;  ///< spec S2.7

/// What is wrong with a landmark from a file; empty: nothing.
std::string_view problem_of(const Landmark& landmark, LandmarkId next_id) {
  constexpr double kUnitTolerance = 1e-3;
  const auto is_unit = [](const Point3& v) { return v.allFinite() && std::abs(v.norm() - 1.0) < kUnitTolerance; };
  if (landmark.id == 0 || landmark.id >= next_id) {
    return "its id was never given out";
  }
  if (!landmark.p_map.allFinite() || landmark.p_map.cwiseAbs().maxCoeff() > kMaxCoordinate_m) {
    return "its place is out of range";
  }
  if (!landmark.information.allFinite() ||
      Eigen::SelfAdjointEigenSolver<Matrix3>(landmark.information, Eigen::EigenvaluesOnly).eigenvalues().minCoeff() <=
          0.0) {
    return "its information matrix is not positive definite";
  }
  if (landmark.views.empty() || landmark.views.size() > kMaxViews) {
    return "it has no view or too many";
  }
  const bool directions =
      is_unit(landmark.to_eye) && std::all_of(landmark.views.begin(), landmark.views.end(),
                                              [&](const LandmarkView& view) { return is_unit(view.to_eye); });
  if (!directions || !(landmark.concentration >= 0.0 && landmark.concentration <= 1.0)) {
    return "its view directions are not unit vectors";
  }
  if (!(landmark.scale_m >= 0.0) || !std::isfinite(landmark.scale_m) || !std::isfinite(landmark.log_odds)) {
    return "its size or its log-odds is not finite";
  }
  return landmark.seen < 1 || landmark.expected < 0 || landmark.misses < 0 ? "its counts are negative" : "";
}

}  // namespace

Result<LandmarkDatabase> LandmarkDatabase::restore(std::uint64_t calibration, LandmarkId next_id,
                                                   std::uint64_t sightings, std::vector<Landmark> landmarks) {
  if (landmarks.size() > kMaxLandmarks) {
    return fail(Errc::kTooLarge, "the database has " + std::to_string(landmarks.size()) +
                                     " landmarks, over the limit of " + std::to_string(kMaxLandmarks));
  }
  LandmarkDatabase database(calibration);
  database.next_id_ = next_id;
  database.sightings_ = sightings;
  database.landmarks_ = std::move(landmarks);
  for (const Landmark& landmark : database.landmarks_) {
    if (const std::string_view problem = problem_of(landmark, next_id); !problem.empty()) {
      return fail(Errc::kCorrupt, "landmark " + std::to_string(landmark.id) + ": " + std::string(problem) +
                                      "; restore the database from a copy or survey again");
    }
  }
  database.rebuild_index();
  if (database.by_id_.size() != database.size()) {
    return fail(Errc::kCorrupt, "two landmarks have the same id; restore the database from a copy or survey again");
  }
  return database;
}

const Landmark* LandmarkDatabase::find(LandmarkId id) const {
  const auto found = by_id_.find(id);
  return found != by_id_.end() ? &landmarks_[found->second] : nullptr;
}

DatabaseStatistics LandmarkDatabase::statistics() const {
  DatabaseStatistics statistics;
  statistics.landmarks = size();
  if (empty()) {
    return statistics;
  }
  std::vector<double> sigmas_m;
  sigmas_m.reserve(size());
  statistics.low = statistics.high = landmarks_.front().p_map;
  for (const Landmark& landmark : landmarks_) {
    statistics.salient += landmark.seen >= kSalientSeen ? 1 : 0;
    statistics.views += landmark.views.size();
    statistics.mean_seen += static_cast<double>(landmark.seen) / static_cast<double>(size());
    statistics.low = statistics.low.cwiseMin(landmark.p_map);
    statistics.high = statistics.high.cwiseMax(landmark.p_map);
    sigmas_m.push_back(largest_sigma(landmark.covariance().topLeftCorner<2, 2>()));
  }
  const auto middle = sigmas_m.begin() + static_cast<std::ptrdiff_t>(sigmas_m.size() / 2);
  std::nth_element(sigmas_m.begin(), middle, sigmas_m.end());
  statistics.median_sigma_m = *middle;
  return statistics;
}

LandmarkId LandmarkDatabase::insert(Landmark landmark) {
  SEEKER_ASSERT(!landmark.views.empty() && landmark.p_map.allFinite());
  const LandmarkId id = next_id_++;
  landmark.id = id;
  by_id_.emplace(id, size());
  grid_.insert(size(), landmark.p_map);
  indexed_at_.push_back(landmark.p_map);
  landmarks_.push_back(std::move(landmark));
  return id;
}

void LandmarkDatabase::change(std::size_t index, const std::function<void(Landmark&)>& change) {
  Landmark& landmark = landmarks_[index];
  const LandmarkId id = landmark.id;
  change(landmark);
  landmark.id = id;
  SEEKER_ASSERT(landmark.p_map.allFinite());
  if ((landmark.p_map - indexed_at_[index]).norm() > kGridSlack_m) {
    grid_.move(index, indexed_at_[index], landmark.p_map);
    indexed_at_[index] = landmark.p_map;
  }
}

std::size_t LandmarkDatabase::erase_if(const std::function<bool(const Landmark&)>& condition) {
  const std::size_t removed = std::erase_if(landmarks_, condition);
  if (removed > 0) {
    rebuild_index();
  }
  return removed;
}

void LandmarkDatabase::rebuild_index() {
  grid_.clear();
  by_id_.clear();
  indexed_at_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    by_id_.emplace(landmarks_[i].id, i);
    grid_.insert(i, landmarks_[i].p_map);
    indexed_at_.push_back(landmarks_[i].p_map);
  }
}

}  // namespace seeker::localize
