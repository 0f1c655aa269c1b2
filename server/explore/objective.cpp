#include "server/explore/objective.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/core/polygon.hpp"
#include "server/slam/sp_geometry.hpp"
#include "server/slam/sp_map.hpp"
#include "server/slam/sp_rows.hpp"

namespace seeker::explore {
namespace {

using slam::Index;
using slam::kRobotRows;

constexpr double kControlPeriod_s = 0.1;  ///< spec S1.13
/// Keeps logarithms finite where nothing at all is uncertain.
constexpr double kLeast = std::numeric_limits<double>::min();

double root_det(const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  return std::sqrt(std::max(0.0, covariance.determinant()));
}

/// Nominal noise of a wall that so many beams hit, in the order y, theta, left, right.
slam::Matrix4 nominal_noise(const SensorModel& sensor, int beams) {
  const double scale = static_cast<double>(sensor.nominal_points) / static_cast<double>(std::max(1, beams));
  const slam::Vector4 sigma(sensor.sigma_y_m, sensor.sigma_theta_rad, sensor.sigma_end_m, sensor.sigma_end_m);
  return (scale * sigma.cwiseAbs2()).asDiagonal();
}

slam::SegmentRows rows_of(const SightWall& wall, Index at) { return {at, wall.real}; }

/// The measurement rows of the seen part of a wall, at zero innovation.
slam::RowGroup nominal_rows(const SightWall& wall, Index at, const Pose2& map_T_base, const SeenPart& part,
                            const SensorModel& sensor) {
  const Pose2 segment_T_part{0.5 * (part.from_m + part.to_m), 0.0, 0.0};
  const Pose2 base_T_part = inverse(map_T_base) * (wall.map_T_segment * segment_T_part);
  const slam::PairGeometry geometry = slam::pair_geometry(wall.map_T_segment, map_T_base, base_T_part);
  const slam::PairRows rows = slam::pair_rows(geometry, wall.length_m, part.to_m - part.from_m);
  const std::array<bool, 2> ends{wall.real[0] && part.ends[0], wall.real[1] && part.ends[1]};
  return slam::row_group(rows, rows_of(wall, at), 0, nominal_noise(sensor, part.beams), {true, ends});
}

/// P H^T; every group has columns for the robot and its own wall only.
Eigen::MatrixXd times_transposed(const Eigen::MatrixXd& p, const std::vector<slam::RowGroup>& groups, Index rows) {
  Eigen::MatrixXd pht(p.rows(), rows);
  Index first = 0;
  for (const slam::RowGroup& group : groups) {
    auto columns = pht.middleCols(first, group.rows());
    columns.noalias() = p.leftCols<kRobotRows>() * group.h.leftCols(kRobotRows).transpose();
    columns.noalias() += p.middleCols(group.at, group.columns) * group.h.rightCols(group.columns).transpose();
    first += group.rows();
  }
  return pht;
}

/// H P H^T + G R G^T.
Eigen::MatrixXd innovation_of(const Eigen::MatrixXd& pht, const std::vector<slam::RowGroup>& groups) {
  Eigen::MatrixXd s(pht.cols(), pht.cols());
  Index first = 0;
  for (const slam::RowGroup& group : groups) {
    auto own = s.middleRows(first, group.rows());
    own.noalias() = group.h.leftCols(kRobotRows) * pht.topRows<kRobotRows>();
    own.noalias() += group.h.rightCols(group.columns) * pht.middleRows(group.at, group.columns);
    own.middleCols(first, group.rows()) += group.g * group.observed * group.g.transpose();
    first += group.rows();
  }
  return s;
}

}  // namespace

PredictedMotion predict_motion(const Twist2& control, double tau_s, const slam::OdometryParams& odometry) {
  const int periods = std::max(1, static_cast<int>(std::round(tau_s / kControlPeriod_s)));
  const Pose2 step = integrate(control, tau_s / periods);
  const Matrix3 j = slam::transport(inverse(step));
  const Matrix3 noise = slam::increment_covariance(step, odometry);
  PredictedMotion motion;
  for (int k = 0; k < periods; ++k) {
    motion.increment = motion.increment * step;
    motion.covariance = j * motion.covariance * j.transpose() + noise;
  }
  return motion;
}

Belief::Belief(const slam::LocalBelief& filter) : filter_(filter.lines) {
  robot_ = filter.lines->robot_covariance();
  const std::vector<slam::SpSegment>& segments = filter.lines->segments();
  ids_.reserve(segments.size());
  walls_.reserve(segments.size());
  sizes_.reserve(segments.size());
  for (const slam::SpSegment& segment : segments) {
    ids_.push_back(segment.id);
    walls_.push_back({filter.map_T_lines * segment.map_T_segment, segment.length_m, segment.real});
    sizes_.push_back(root_det(filter.lines->segment_covariance(segment.id)));
  }
  all_sizes_ = std::accumulate(sizes_.begin(), sizes_.end(), 0.0);
}

Belief::Belief(const Pose2& map_T_base, const Matrix3& covariance_map, const std::vector<MapSegment>& segments,
               std::size_t max_walls)
    : robot_(slam::to_base_frame(covariance_map, map_T_base)) {
  std::vector<std::pair<double, std::size_t>> nearest;
  nearest.reserve(segments.size());
  for (std::size_t k = 0; k < segments.size(); ++k) {
    nearest.emplace_back(distance_to_segment_m(segments[k].left(), segments[k].right(), map_T_base.translation()), k);
  }
  std::sort(nearest.begin(), nearest.end());
  nearest.resize(std::min(nearest.size(), max_walls));
  for (const auto& [distance_m, k] : nearest) {
    // No row of an end is known here, so that both count as virtual.
    walls_.push_back({segments[k].map_T_segment, segments[k].length_m, {false, false}});
    covariances_.push_back(segments[k].covariance);
    sizes_.push_back(root_det(segments[k].covariance));
  }
  all_sizes_ = std::accumulate(sizes_.begin(), sizes_.end(), 0.0);
}

PredictedBelief Belief::joint(const std::vector<std::size_t>& walls) const {
  PredictedBelief joint;
  joint.other_sizes_ = all_sizes_;
  Index rows = kRobotRows;
  std::vector<slam::SegmentId> ids;
  joint.blocks_.reserve(walls.size());
  ids.reserve(walls.size());
  for (const std::size_t wall : walls) {
    const Index own = rows_of(walls_[wall], rows).count();
    joint.blocks_.push_back({wall, rows, own});
    joint.other_sizes_ -= sizes_[wall];
    rows += own;
    if (filter_ != nullptr) {
      ids.push_back(ids_[wall]);
    }
  }
  joint.other_sizes_ = std::max(0.0, joint.other_sizes_);
  if (filter_ != nullptr) {
    joint.p_ = filter_->joint_covariance(ids);
    return joint;
  }
  joint.p_ = Eigen::MatrixXd::Zero(rows, rows);
  joint.p_.topLeftCorner<3, 3>() = robot_;
  for (const PredictedBelief::Block& block : joint.blocks_) {
    joint.p_.block<2, 2>(block.at, block.at) = covariances_[block.wall];
  }
  return joint;
}

void PredictedBelief::move(const PredictedMotion& motion) {
  const Matrix3 j = slam::transport(inverse(motion.increment));
  p_.topRows<3>() = (j * p_.topRows<3>()).eval();
  p_.leftCols<3>() = (p_.leftCols<3>() * j.transpose()).eval();
  p_.topLeftCorner<3, 3>() += motion.covariance;
}

void PredictedBelief::observe(const Belief& belief, const Pose2& map_T_base, const std::vector<PredictedSight>& sights,
                              const SensorModel& sensor) {
  std::vector<slam::RowGroup> groups;
  groups.reserve(sights.size());
  for (const PredictedSight& sight : sights) {
    const auto block =
        std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& one) { return one.wall == sight.wall; });
    if (block != blocks_.end()) {
      groups.push_back(nominal_rows(belief.walls()[sight.wall], block->at, map_T_base, sight.part, sensor));
    }
  }
  const Index rows = std::accumulate(groups.begin(), groups.end(), Index{0},
                                     [](Index sum, const slam::RowGroup& group) { return sum + group.rows(); });
  if (rows == 0) {
    return;
  }
  Eigen::MatrixXd pht = times_transposed(p_, groups, rows);
  const Eigen::LLT<Eigen::MatrixXd> llt(innovation_of(pht, groups));
  if (llt.info() != Eigen::Success) {
    return;  // what cannot be computed gives no information
  }
  llt.matrixU().solveInPlace<Eigen::OnTheRight>(pht);
  p_.selfadjointView<Eigen::Lower>().rankUpdate(pht, -1.0);
  p_.triangularView<Eigen::StrictlyUpper>() = p_.transpose();
}
double PredictedBelief::uncertainty() const {
  double sum = root_det(p_.topLeftCorner<3, 3>()) + other_sizes_;
  for (const Block& block : blocks_) {
    sum += root_det(p_.block(block.at, block.at, block.rows, block.rows));
  }
  return kPi * sum;
}

std::vector<PredictedSight> predict_sights(const Belief& belief, const SightView& view, int max_observed) {
  std::vector<std::pair<double, PredictedSight>> seen;
  for (std::size_t wall = 0; wall < belief.walls().size(); ++wall) {
    if (const std::optional<SeenPart> part = view.part_of(belief.walls()[wall])) {
      const Point2 middle = belief.walls()[wall].map_T_segment * Point2(0.5 * (part->from_m + part->to_m), 0.0);
      seen.emplace_back((middle - view.map_T_base().translation()).norm(), PredictedSight{wall, *part});
    }
  }
  std::stable_sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  seen.resize(std::min(seen.size(), static_cast<std::size_t>(std::max(0, max_observed))));
  std::vector<PredictedSight> sights;
  sights.reserve(seen.size());
  for (const auto& [distance_m, sight] : seen) {
    sights.push_back(sight);
  }
  return sights;
}

double least_uncertainty(const Belief& belief, const SensorModel& sensor) {
  const double line = sensor.sigma_y_m * sensor.sigma_theta_rad;
  double sum = sensor.sigma_y_m * line;
  for (const SightWall& wall : belief.walls()) {
    sum += line * (wall.real[0] ? sensor.sigma_end_m : 1.0) * (wall.real[1] ? sensor.sigma_end_m : 1.0);
  }
  return kPi * sum;
}

Terms combine(double least_uncertainty, double uncertainty, const Growth& growth, const SightScene& scene,
              const OneStepParams& params) {
  double length_m = scene.map_length_m();
  auto walls = static_cast<double>(scene.map_segments());
  if (!params.all_segments) {
    length_m = std::accumulate(scene.walls().begin(), scene.walls().end(), 0.0,
                               [](double sum, const SightWall& wall) { return sum + wall.length_m; });
    walls = static_cast<double>(scene.walls().size());
  }
  Terms terms;
  terms.j1 = std::max(least_uncertainty, kLeast) / std::max(uncertainty, kLeast);
  terms.j21 = length_m > 0.0 ? growth.extension_m / length_m : 0.0;
  terms.j22 = walls > 0.0 ? growth.new_ends / (2.0 * walls) : 0.0;
  terms.lg_j1 = std::log10(terms.j1);
  terms.lg_j21 = std::log10(std::max(terms.j21, params.log_floor));
  terms.lg_j22 = std::log10(std::max(terms.j22, params.log_floor));
  terms.score = params.weight_certainty * terms.lg_j1 + params.weight_extension * terms.lg_j21 +
                params.weight_ends * terms.lg_j22;
  return terms;
}

std::vector<Terms> evaluate(const Pose2& map_T_base, const std::vector<PredictedMotion>& motions,
                            const SightScene& scene, const Belief& belief, const OneStepParams& params) {
  std::vector<SightView> views;
  std::vector<std::vector<PredictedSight>> sights;
  std::vector<std::size_t> needed;
  views.reserve(motions.size());
  sights.reserve(motions.size());
  for (const PredictedMotion& motion : motions) {
    views.push_back(scene.look(map_T_base * motion.increment));
    sights.push_back(predict_sights(belief, views.back(), params.max_observed));
    for (const PredictedSight& sight : sights.back()) {
      needed.push_back(sight.wall);
    }
  }
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  const PredictedBelief now = belief.joint(needed);
  const double least = least_uncertainty(belief, params.sensor);
  std::vector<Terms> terms;
  terms.reserve(motions.size());
  for (std::size_t k = 0; k < motions.size(); ++k) {
    PredictedBelief then = now;
    then.move(motions[k]);
    then.observe(belief, views[k].map_T_base(), sights[k], params.sensor);
    terms.push_back(combine(least, then.uncertainty(), views[k].growth(), scene, params));
  }
  return terms;
}

}  // namespace seeker::explore
