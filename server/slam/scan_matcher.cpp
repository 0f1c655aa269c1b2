#include "server/slam/scan_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::slam {
namespace {

constexpr double kHoldWeight = 1.0e6;         ///< keeps the guess along a degenerate direction
constexpr double kUnseenVariance_m2 = 100.0;  ///< what a match says about a direction it does not see
constexpr double kDistinctSteps = 3.5;        ///< of the search: starts farther apart lead to different matches

/// Normal equations of one iteration; rotation about the robot, translation in the frame `map`.
struct NormalEquations {
  Matrix3 hessian = Matrix3::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Matrix2 scatter = Matrix2::Zero();  ///< of the normals: which translations are seen
  double weight = 0.0;
  double squared_residuals = 0.0;  ///< weighted
  double inlier_squares = 0.0;
  int pairs = 0;
  int inliers = 0;
};

NormalEquations linearise(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                          const Pose2& pose, double gate_m, const MatchParams& params) {
  NormalEquations sum;
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  for (const OrientedPoint& point : points_base) {
    const Point2 arm(c * point.p.x() - s * point.p.y(), s * point.p.x() + c * point.p.y());
    const Point2 p_map = arm + pose.translation();
    const OrientedPoint* partner = reference.nearest(p_map, gate_m);
    if (partner == nullptr) {
      continue;
    }
    const Point2 normal(c * point.normal.x() - s * point.normal.y(), s * point.normal.x() + c * point.normal.y());
    if (normal.dot(partner->normal) < params.min_normal_cosine) {
      continue;
    }
    const Point2& n = partner->normal;
    const double residual = n.dot(p_map - partner->p);
    const double size = std::abs(residual);
    const double weight = size <= params.huber_m ? 1.0 : params.huber_m / size;
    const Eigen::Vector3d row(n.x(), n.y(), n.y() * arm.x() - n.x() * arm.y());
    sum.hessian += weight * row * row.transpose();
    sum.gradient += weight * residual * row;
    sum.scatter += weight * n * n.transpose();
    sum.weight += weight;
    sum.squared_residuals += weight * residual * residual;
    ++sum.pairs;
    if (size <= params.inlier_m) {
      ++sum.inliers;
      sum.inlier_squares += residual * residual;
    }
  }
  return sum;
}

/// Of all points, in m^2: the squared distance from the partner, Huber's beyond huber_m, and that of the last gate for
/// a point without one.
double cost_at(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base, const Pose2& pose,
               const MatchParams& params) {
  double cost = 0.0;
  for (const OrientedPoint& point_base : points_base) {
    const OrientedPoint point = transform(pose, point_base);
    const OrientedPoint* partner = reference.nearest(point.p, params.last_gate_m);
    const bool pair = partner != nullptr && point.normal.dot(partner->normal) >= params.min_normal_cosine;
    const double size = pair ? std::abs(partner->normal.dot(point.p - partner->p)) : params.last_gate_m;
    cost += size <= params.huber_m ? size * size : params.huber_m * (2.0 * size - params.huber_m);
  }
  return cost;
}

std::optional<Point2> unseen_direction(const NormalEquations& sum, double ratio) {
  const Eigen::SelfAdjointEigenSolver<Matrix2> eigen(sum.scatter);
  if (eigen.eigenvalues()[0] >= ratio * sum.weight) {
    return std::nullopt;
  }
  return eigen.eigenvectors().col(0);
}

Matrix3 hold(const Point2& direction) {
  const Eigen::Vector3d d(direction.x(), direction.y(), 0.0);
  return kHoldWeight * d * d.transpose();
}

/// Residual variance times the inverse Hessian, inflated; the unseen direction gets what it deserves.
Matrix3 covariance_of(const NormalEquations& sum, const std::optional<Point2>& unseen, const MatchParams& params) {
  const double freedom = std::max(1.0, sum.weight - 3.0);
  const double variance = std::max(sum.squared_residuals / freedom, params.sigma_floor_m * params.sigma_floor_m);
  const Matrix3 hessian = sum.hessian + (unseen ? hold(*unseen) : Matrix3::Zero()) + 1e-9 * Matrix3::Identity();
  Matrix3 covariance = params.covariance_inflation * variance * hessian.inverse();
  if (unseen) {
    const Eigen::Vector3d d(unseen->x(), unseen->y(), 0.0);
    covariance += kUnseenVariance_m2 * d * d.transpose();
  }
  return 0.5 * (covariance + covariance.transpose());
}

/// Points that lie near the reference; fewer when more than `wanted` cannot be reached any more.
double hits_above(const ReferenceCloud& reference, const std::vector<Point2>& turned, const Point2& at, double wanted) {
  const auto allowed_misses = static_cast<double>(turned.size()) - wanted;
  int hits = 0;
  int misses = 0;
  for (const Point2& p : turned) {
    if (reference.has_near(p + at)) {
      ++hits;
    } else if (++misses > allowed_misses) {
      break;
    }
  }
  return hits;
}

/// The best place of one heading.
struct SearchBest {
  double score = 0.0;
  Pose2 map_T_base;
};

/// Best first, without those that a better one is near to: one match would find both.
std::vector<Pose2> distinct(std::vector<SearchBest> found, const MatchParams& params) {
  std::sort(found.begin(), found.end(), [](const SearchBest& a, const SearchBest& b) { return a.score > b.score; });
  std::vector<Pose2> starts;
  for (const SearchBest& best : found) {
    const bool fresh = std::none_of(starts.begin(), starts.end(), [&](const Pose2& start) {
      return distance_m(start, best.map_T_base) <= kDistinctSteps * params.search_step_m &&
             std::abs(wrap_angle(start.theta_rad - best.map_T_base.theta_rad)) <=
                 kDistinctSteps * params.search_step_rad;
    });
    if (fresh && starts.size() < params.search_starts) {
      starts.push_back(best.map_T_base);
    }
  }
  return starts;
}

}  // namespace

MatchResult ScanMatcher::match(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                               const Pose2& guess) const {
  return iterate(reference, points_base, guess, std::nullopt);
}

MatchResult ScanMatcher::iterate(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                 const Pose2& guess, const std::optional<Point2>& held) const {
  MatchResult result;
  result.map_T_base = guess;
  double gate_m = params_.first_gate_m;
  for (int k = 0; k < params_.max_iterations && !result.converged; ++k) {
    const NormalEquations sum = linearise(reference, points_base, result.map_T_base, gate_m, params_);
    if (sum.pairs < params_.min_pairs) {
      break;
    }
    const auto unseen = held ? held : unseen_direction(sum, params_.degenerate_ratio);
    const Matrix3 hessian = sum.hessian + (unseen ? hold(*unseen) : Matrix3::Zero()) + 1e-9 * Matrix3::Identity();
    const Eigen::Vector3d step = -hessian.ldlt().solve(sum.gradient);
    Pose2& pose = result.map_T_base;
    pose = {pose.x_m + step[0], pose.y_m + step[1], wrap_angle(pose.theta_rad + step[2])};
    const bool small = step.head<2>().norm() < params_.stop_m && std::abs(step[2]) < params_.stop_rad;
    result.converged = small && gate_m <= params_.last_gate_m;
    gate_m = small ? params_.last_gate_m : std::max(params_.last_gate_m, params_.gate_shrink * gate_m);
  }
  const NormalEquations sum = linearise(reference, points_base, result.map_T_base, params_.last_gate_m, params_);
  result.pairs = sum.pairs;
  result.inliers = sum.inliers;
  result.inlier_ratio =
      points_base.empty() ? 0.0 : static_cast<double>(sum.inliers) / static_cast<double>(points_base.size());
  result.rms_m = sum.inliers > 0 ? std::sqrt(sum.inlier_squares / sum.inliers) : 0.0;
  if (sum.pairs < params_.min_pairs) {
    result.converged = false;
    return result;
  }
  result.degenerate_direction = held ? held : unseen_direction(sum, params_.degenerate_ratio);
  result.covariance = covariance_of(sum, result.degenerate_direction, params_);
  return result;
}

MatchResult ScanMatcher::weighed(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                 const Pose2& guess, MatchResult found) const {
  const Point2 off = found.map_T_base.translation() - guess.translation();
  const double off_m = off.norm();
  if (off_m < params_.weighed_m || found.pairs < params_.min_pairs) {
    return found;
  }
  const Point2 direction = off / off_m;
  const Pose2 start{guess.x_m, guess.y_m, found.map_T_base.theta_rad};
  MatchResult held = iterate(reference, points_base, start, direction);
  if (held.pairs < params_.min_pairs) {
    return found;
  }
  const double more_m2 = cost_at(reference, points_base, held.map_T_base, params_) -
                         cost_at(reference, points_base, found.map_T_base, params_);
  // As in covariance_of(): deviations squared that the points speak for the one and against the other.
  const double floor2 = params_.sigma_floor_m * params_.sigma_floor_m;
  const double chi2 = more_m2 / (params_.covariance_inflation * std::max(floor2, found.rms_m * found.rms_m));
  if (chi2 < 1.0) {
    return held;
  }
  const Eigen::Vector3d d(direction.x(), direction.y(), 0.0);
  const double stated_m2 = d.dot(found.covariance * d);
  found.covariance += std::max(0.0, off_m * off_m / chi2 - stated_m2) * d * d.transpose();
  return found;
}

double ScanMatcher::handicap(const Expected& expected, const Pose2& pose) const {
  const Eigen::Vector3d off = offset_of(pose, expected.map_T_base);
  return std::min(params_.max_surprise_share, params_.surprise_share * off.dot(expected.information * off));
}

std::vector<Pose2> ScanMatcher::search(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                       const Expected& expected) const {
  const std::vector<OrientedPoint> sparse = thin_out(points_base, params_.search_points);
  const auto count = static_cast<double>(sparse.size());
  const Pose2& guess = expected.map_T_base;
  const int turns = static_cast<int>(std::lround(params_.search_rad / params_.search_step_rad));
  const int moves = static_cast<int>(std::lround(params_.search_m / params_.search_step_m));
  std::vector<Point2> turned(sparse.size());
  std::vector<SearchBest> found;
  for (int t = -turns; t <= turns; ++t) {
    const Pose2 rotation{0.0, 0.0, wrap_angle(guess.theta_rad + t * params_.search_step_rad)};
    std::transform(sparse.begin(), sparse.end(), turned.begin(),
                   [&](const OrientedPoint& q) { return rotation * q.p; });
    SearchBest best{params_.search_ratio * count - params_.max_surprise_share * count, {}};
    bool any = false;
    for (int j = -moves; j <= moves; ++j) {
      for (int i = -moves; i <= moves; ++i) {
        const Point2 at = guess.translation() + params_.search_step_m * Point2(i, j);
        const Pose2 pose{at.x(), at.y(), rotation.theta_rad};
        const double penalty = count * handicap(expected, pose);
        const double wanted = std::max(best.score + penalty, params_.search_ratio * count);
        const double hits = hits_above(reference, turned, at, wanted);
        if (hits > wanted) {
          best = {hits - penalty, pose};
          any = true;
        }
      }
    }
    if (any) {
      found.push_back(best);
    }
  }
  return distinct(std::move(found), params_);
}

MatchResult ScanMatcher::kept_along(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                    const Pose2& guess, MatchResult found) const {
  const Point2& at = found.map_T_base.translation();
  const Point2& direction = *found.degenerate_direction;
  const Point2 kept = at - direction.dot(at - guess.translation()) * direction;
  MatchResult back = match(reference, points_base, {kept.x(), kept.y(), found.map_T_base.theta_rad});
  return back.inliers >= params_.kept_share * found.inliers ? back : found;
}

MatchResult ScanMatcher::match_widely(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points_base,
                                      const Pose2& guess, const Matrix3& covariance, MatchResult from_guess) const {
  // Places between the steps of the grid are no surprise.
  const Eigen::Vector3d steps(params_.search_step_m, params_.search_step_m, params_.search_step_rad);
  const Matrix3 widened = covariance + steps.cwiseAbs2().asDiagonal().toDenseMatrix() / 12.0;
  const Expected expected{guess, widened.inverse()};
  const auto count = static_cast<double>(points_base.size());
  const auto rank = [&](const MatchResult& match) {
    return match.inliers - count * handicap(expected, match.map_T_base);
  };
  MatchResult best = std::move(from_guess);
  for (const Pose2& start : search(reference, points_base, expected)) {
    MatchResult other = match(reference, points_base, start);
    if (rank(other) > rank(best)) {
      best = std::move(other);
    }
  }
  return best.degenerate_direction ? kept_along(reference, points_base, guess, std::move(best)) : best;
}

}  // namespace seeker::slam
