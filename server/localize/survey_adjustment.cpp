#include "server/localize/survey_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/core/angle.hpp"

namespace seeker::localize {
namespace {

/// A point as one sighting saw it, over the floor; or where it was known to be.
struct Observation {
  bool known = false;  ///< no sighting: `p_eye` and `covariance_eye` are of the frame map
  std::size_t sighting = 0;
  Point3 p_eye = Point3::Zero();
  double disparity_px = 0.0;
  Matrix2 covariance_eye = Matrix2::Zero();
};
using Track = std::vector<Observation>;

using Block = Eigen::Matrix<double, 2, 3>;
constexpr double kLeastDisparity_px = 1.0;
/// A pose given without uncertainty is kept to a tenth of a millimetre.
constexpr double kLeastVariance = 1e-8;

/// Observations of one point at the present poses: where each puts it, what each is worth, how the poses move it.
struct Linearised {
  std::vector<Point2> places;
  std::vector<Matrix2> weights;
  std::vector<Block> jacobians;   ///< by the pose
  std::vector<Point2> by_offset;  ///< derivative by the disparities' common error
  Point2 mean = Point2::Zero();
  Matrix2 total = Matrix2::Zero();
};

class Adjustment {
 public:
  Adjustment(const StereoGeometry& geometry, const DatabaseParams& params, const std::vector<Sighting>& sightings,
             std::span<const KnownSight> known, std::span<const SightingsApart> apart)
      : geometry_(geometry),
        params_(params),
        measured_(sightings),
        known_(known),
        apart_(apart),
        adjusted_(sightings),
        led_to_(sightings.size(), false) {
    for (const SightingsApart& motion : apart_) {
      led_to_[motion.to] = true;
    }
  }

  Status run(AdjustmentReport& report);
  /// With the disparities' common error taken out.
  std::vector<Sighting> take();

 private:
  Status find_tracks();
  [[nodiscard]] Linearised linearise(const Track& track) const;
  void add_priors();
  void add(const SightingsApart& motion);
  void add(const Track& track);
  void move();
  [[nodiscard]] double rms_m() const;
  [[nodiscard]] static Eigen::Index row_of(std::size_t sighting) { return static_cast<Eigen::Index>(3 * sighting); }
  [[nodiscard]] Eigen::Index offset_row() const { return row_of(measured_.size()); }

  const StereoGeometry& geometry_;
  const DatabaseParams& params_;
  const std::vector<Sighting>& measured_;
  std::span<const KnownSight> known_;
  std::span<const SightingsApart> apart_;
  std::vector<Sighting> adjusted_;
  std::vector<bool> led_to_;  ///< sightings that one of `apart_` leads to
  std::vector<Track> tracks_;
  double offset_px_ = 0.0;       ///< that all disparities have too much
  Eigen::MatrixXd information_;  ///< of all poses, x, y, theta each, then of the offset
  Eigen::VectorXd gradient_;
};

/// What the survey itself would take for one point, with nothing left out for being dense.
Status Adjustment::find_tracks() {
  DatabaseParams params = params_;
  params.sparsity.on = false;
  SurveyBuilder builder(geometry_, params);
  std::map<std::pair<std::size_t, std::size_t>, const Landmark*> known;  // by sighting and feature
  for (const KnownSight& sight : known_) {
    known[{sight.sighting, sight.feature}] = sight.landmark;
  }
  std::map<LandmarkId, Track> tracks;
  std::map<LandmarkId, Track> known_tracks;
  for (std::size_t s = 0; s < adjusted_.size(); ++s) {
    if (const auto added = builder.add(adjusted_[s]); !added) {
      return tl::unexpected(added.error());
    }
    for (std::size_t i = 0; i < adjusted_[s].features.size(); ++i) {
      const auto point = builder.landmarks()[i] == 0
                             ? std::nullopt
                             : triangulate_within(geometry_, adjusted_[s].features[i], params_.noise, params_.range);
      if (!point) {
        continue;
      }
      const auto found = known.find({s, i});
      Track& track = found == known.end() ? tracks[builder.landmarks()[i]] : known_tracks[found->second->id];
      if (found != known.end() && track.empty()) {
        const Landmark& landmark = *found->second;
        track.push_back({true, 0, landmark.p_map, 0.0, landmark.covariance().topLeftCorner<2, 2>()});
      }
      track.push_back(
          {false, s, point->p, adjusted_[s].features[i].disparity_px, point->covariance.topLeftCorner<2, 2>()});
    }
  }
  tracks_.clear();
  for (auto* some : {&known_tracks, &tracks}) {
    for (auto& [id, track] : *some) {
      if (track.size() > 1) {
        tracks_.push_back(std::move(track));
      }
    }
  }
  return {};
}

Linearised Adjustment::linearise(const Track& track) const {
  const double floor_m2 = std::pow(params_.adjustment.point_sigma_m, 2);
  Linearised at;
  Point2 weighted = Point2::Zero();
  for (const Observation& seen : track) {
    if (seen.known) {
      at.places.emplace_back(seen.p_eye.head<2>());
      at.weights.emplace_back((seen.covariance_eye + floor_m2 * Matrix2::Identity()).inverse());
      at.jacobians.emplace_back(Block::Zero());
      at.by_offset.emplace_back(Point2::Zero());
      at.total += at.weights.back();
      weighted += at.weights.back() * at.places.back();
      continue;
    }
    const Pose2& map_T_eye = adjusted_[seen.sighting].map_T_eye;
    const Matrix2 turn = Eigen::Rotation2Dd(map_T_eye.theta_rad).toRotationMatrix();
    const Matrix2 covariance = turn * seen.covariance_eye * turn.transpose() + floor_m2 * Matrix2::Identity();
    // All of a point's coordinates go with 1 / disparity.
    const double disparity_px = std::max(seen.disparity_px - offset_px_, kLeastDisparity_px);
    const Point3 p_eye = seen.p_eye * (seen.disparity_px / disparity_px);
    at.places.push_back(map_T_eye * Point2(p_eye.head<2>()));
    at.weights.emplace_back(covariance.inverse());
    at.jacobians.emplace_back(to_map_jacobian(map_T_eye, p_eye).topRows<2>());
    at.by_offset.emplace_back(turn * p_eye.head<2>() / disparity_px);
    at.total += at.weights.back();
    weighted += at.weights.back() * at.places.back();
  }
  at.mean = at.total.inverse() * weighted;
  // Huber: observations far from the others' mean have a smaller weight, and the mean is computed again.
  at.total.setZero();
  weighted.setZero();
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Point2 off = at.places[i] - at.mean;
    const double sigmas = std::sqrt(off.dot(at.weights[i] * off));
    at.weights[i] *= std::min(1.0, params_.adjustment.huber_sigmas / std::max(sigmas, 1e-9));
    at.total += at.weights[i];
    weighted += at.weights[i] * at.places[i];
  }
  at.mean = at.total.inverse() * weighted;
  return at;
}

void Adjustment::add_priors() {
  for (std::size_t s = 0; s < measured_.size(); ++s) {
    if (led_to_[s]) {
      continue;
    }
    const Pose2& from = measured_[s].map_T_eye;
    const Pose2& now = adjusted_[s].map_T_eye;
    const Matrix3 weight = (measured_[s].pose_covariance + kLeastVariance * Matrix3::Identity()).inverse();
    information_.block<3, 3>(row_of(s), row_of(s)) += weight;
    gradient_.segment<3>(row_of(s)) += weight * offset_of(now, from);
  }
  const double weight = std::pow(params_.adjustment.offset_sigma_px, -2);
  information_(offset_row(), offset_row()) += weight;
  gradient_(offset_row()) += weight * offset_px_;
}

void Adjustment::add(const SightingsApart& motion) {
  const Pose2& a = adjusted_[motion.from].map_T_eye;
  const Pose2& b = adjusted_[motion.to].map_T_eye;
  const Matrix3 by_a = compose_jacobian_a(inverse(a), b) * inverse_jacobian(a);
  const Matrix3 by_b = compose_jacobian_b(inverse(a), b);
  const Eigen::Vector3d off = offset_of(inverse(a) * b, motion.from_T_to.a_T_b);
  const Matrix3 weight = (motion.from_T_to.covariance + kLeastVariance * Matrix3::Identity()).inverse();
  const Eigen::Index row_a = row_of(motion.from);
  const Eigen::Index row_b = row_of(motion.to);
  gradient_.segment<3>(row_a) += by_a.transpose() * weight * off;
  gradient_.segment<3>(row_b) += by_b.transpose() * weight * off;
  information_.block<3, 3>(row_a, row_a) += by_a.transpose() * weight * by_a;
  information_.block<3, 3>(row_b, row_b) += by_b.transpose() * weight * by_b;
  const Matrix3 between = by_a.transpose() * weight * by_b;
  information_.block<3, 3>(row_a, row_b) += between;
  information_.block<3, 3>(row_b, row_a) += between.transpose();
}

/// The normal equations of one point after its own place has been eliminated.
void Adjustment::add(const Track& track) {
  const Linearised at = linearise(track);
  const Matrix2 rest = at.total.inverse();
  Point2 mean_by_offset = Point2::Zero();
  for (std::size_t i = 0; i < track.size(); ++i) {
    mean_by_offset += rest * at.weights[i] * at.by_offset[i];
  }
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (track[i].known) {
      continue;  // neither a pose nor the offset moves it
    }
    const Point2 own = at.by_offset[i] - mean_by_offset;
    const Eigen::RowVector2d weighed = at.by_offset[i].transpose() * at.weights[i];
    gradient_(offset_row()) += weighed * (at.places[i] - at.mean);
    information_(offset_row(), offset_row()) += weighed * own;
    const Eigen::Vector3d with_pose = at.jacobians[i].transpose() * at.weights[i] * own;
    information_.block<3, 1>(row_of(track[i].sighting), offset_row()) += with_pose;
    information_.block<1, 3>(offset_row(), row_of(track[i].sighting)) += with_pose.transpose();

    const Eigen::Matrix<double, 3, 2> pull = at.jacobians[i].transpose() * at.weights[i];
    gradient_.segment<3>(row_of(track[i].sighting)) += pull * (at.places[i] - at.mean);
    for (std::size_t k = 0; k < track.size(); ++k) {
      if (track[k].known) {
        continue;
      }
      Matrix2 between = -rest * at.weights[k];
      if (i == k) {
        between += Matrix2::Identity();
      }
      information_.block<3, 3>(row_of(track[i].sighting), row_of(track[k].sighting)) +=
          pull * between * at.jacobians[k];
    }
  }
}

void Adjustment::move() {
  const Eigen::LDLT<Eigen::MatrixXd> solver(information_);
  const Eigen::VectorXd step = solver.solve(gradient_);
  const Eigen::MatrixXd covariance = solver.solve(Eigen::MatrixXd::Identity(information_.rows(), information_.cols()));
  for (std::size_t s = 0; s < adjusted_.size(); ++s) {
    Pose2& pose = adjusted_[s].map_T_eye;
    const Eigen::Index row = row_of(s);
    pose = {pose.x_m - step(row), pose.y_m - step(row + 1), wrap_angle(pose.theta_rad - step(row + 2))};
    const Matrix3 own = covariance.block<3, 3>(row, row);
    adjusted_[s].pose_covariance = 0.5 * (own + own.transpose());
  }
  offset_px_ -= step(offset_row());
}

double Adjustment::rms_m() const {
  double square = 0.0;
  std::size_t count = 0;
  for (const Track& track : tracks_) {
    const Linearised at = linearise(track);
    for (const Point2& place : at.places) {
      square += (place - at.mean).squaredNorm();
    }
    count += track.size();
  }
  return count > 0 ? std::sqrt(square / static_cast<double>(count)) : 0.0;
}

Status Adjustment::run(AdjustmentReport& report) {
  const Eigen::Index size = offset_row() + 1;
  for (int round = 0; round < params_.adjustment.rounds; ++round) {
    if (Status ok = find_tracks(); !ok) {
      return ok;
    }
    if (round == 0) {
      report.rms_before_m = rms_m();
    }
    for (int i = 0; i < params_.adjustment.iterations && !(tracks_.empty() && apart_.empty()); ++i) {
      information_ = Eigen::MatrixXd::Zero(size, size);
      gradient_ = Eigen::VectorXd::Zero(size);
      add_priors();
      for (const SightingsApart& motion : apart_) {
        add(motion);
      }
      for (const Track& track : tracks_) {
        add(track);
      }
      move();
    }
  }
  report.rms_after_m = rms_m();
  report.offset_px = offset_px_;
  report.points = static_cast<int>(tracks_.size());
  for (const Track& track : tracks_) {
    report.observations += static_cast<int>(track.size());
  }
  return {};
}

std::vector<Sighting> Adjustment::take() {
  for (Sighting& sighting : adjusted_) {
    for (vision::StereoFeature& feature : sighting.features) {
      feature.disparity_px = std::max(feature.disparity_px - offset_px_, kLeastDisparity_px);
    }
  }
  return std::move(adjusted_);
}

}  // namespace

Result<AdjustmentReport> adjust_poses(const StereoGeometry& geometry, const DatabaseParams& params,
                                      std::vector<Sighting>& sightings, std::span<const KnownSight> known,
                                      std::span<const SightingsApart> apart) {
  AdjustmentReport report;
  if (!params.adjustment.on) {
    return report;
  }
  Adjustment adjustment(geometry, params, sightings, known, apart);
  if (const Status ok = adjustment.run(report); !ok) {
    return tl::unexpected(ok.error());
  }
  sightings = adjustment.take();
  return report;
}

}  // namespace seeker::localize
