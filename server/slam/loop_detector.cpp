#include "server/slam/loop_detector.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

/// Two poses that differ only along a direction that the scans do not constrain count as one.
bool same_but_along(const VerifiedLoop& a, const VerifiedLoop& b, const GlobalSearchParams& params) {
  const Pose2& p = a.target_T_query.a_T_b;
  const Pose2& q = b.target_T_query.a_T_b;
  if (std::abs(wrap_angle(p.theta_rad - q.theta_rad)) > params.distinct_rad) {
    return false;
  }
  Point2 apart = p.translation() - q.translation();
  if (a.degenerate_direction) {
    apart -= apart.dot(*a.degenerate_direction) * *a.degenerate_direction;
  }
  return apart.norm() <= params.distinct_m;
}

}  // namespace

LoopDetector::LoopDetector(const LoopParams& params)
    : params_(params), search_(params.search), matcher_(params.match) {}

SearchWindow LoopDetector::window_of(const UncertainPose& target_T_query) const {
  const Eigen::SelfAdjointEigenSolver<Matrix2> eigen(target_T_query.covariance.topLeftCorner<2, 2>(),
                                                     Eigen::EigenvaluesOnly);
  const double sigma_m = std::sqrt(std::max(0.0, eigen.eigenvalues()[1]));
  const double sigma_rad = std::sqrt(std::max(0.0, target_T_query.covariance(2, 2)));
  return {target_T_query.a_T_b, std::clamp(params_.window_sigmas * sigma_m, params_.min_window_m, params_.max_window_m),
          std::clamp(params_.window_sigmas * sigma_rad, params_.min_window_rad, params_.max_window_rad)};
}

/// Scans as the steps of a comparison need them.
struct LoopDetector::Query {
  const std::vector<SeenPoints>& seen;
  std::vector<OrientedPoint> all;
  std::vector<OrientedPoint> points;  ///< for the match

  Query(const std::vector<SeenPoints>& seen_query, const LoopParams& params) : seen(seen_query) {
    for (const SeenPoints& one : seen) {
      all.insert(all.end(), one.points.begin(), one.points.end());
    }
    points = thin_by_cells(all, params.search.thin_cell_m, params.match_points);
  }
};

std::optional<VerifiedLoop> LoopDetector::examine(const Query& query, const LoopTarget& target,
                                                  const GlobalCandidate& start) const {
  const std::vector<OrientedPoint>& points = query.points;
  const MatchResult match = matcher_.match(target.place->cloud(), points, start.map_T_base);
  if (match.pairs < params_.match.min_pairs || match.inliers < static_cast<int>(params_.min_inliers)) {
    return std::nullopt;
  }
  VerifiedLoop loop;
  loop.id = target.id;
  loop.score = start.score;
  loop.agreement = agreement_of(target.place->pyramid(), target.place->free_space(), query.seen, match.map_T_base,
                                params_.agreement);
  const auto near = std::count_if(points.begin(), points.end(), [&](const OrientedPoint& point) {
    return target.place->cloud().nearest(match.map_T_base * point.p, params_.match.first_gate_m) != nullptr;
  });
  loop.overlap = static_cast<double>(near) / static_cast<double>(points.size()) + loop.agreement.disagreement();
  loop.consistency = match.inlier_ratio / std::max(loop.overlap, match.inlier_ratio);
  loop.degenerate_direction = match.degenerate_direction;
  const Eigen::Vector3d floor(params_.sigma_floor_m, params_.sigma_floor_m, params_.sigma_floor_rad);
  loop.target_T_query = {match.map_T_base, match.covariance + floor.cwiseAbs2().asDiagonal().toDenseMatrix()};
  loop.information = loop.target_T_query.covariance.inverse();
  if (loop.overlap < params_.min_overlap || loop.consistency < params_.min_consistency) {
    return std::nullopt;
  }
  return loop;
}

std::vector<VerifiedLoop> LoopDetector::fitting(const Query& query, const LoopTarget& target,
                                                const std::vector<GlobalCandidate>& starts) const {
  std::vector<VerifiedLoop> loops;
  for (const GlobalCandidate& start : starts) {
    if (auto loop = examine(query, target, start)) {
      loops.push_back(*std::move(loop));
    }
  }
  return loops;
}

bool LoopDetector::has_rival(const VerifiedLoop& best, const std::vector<VerifiedLoop>& loops) const {
  return std::any_of(loops.begin(), loops.end(), [&](const VerifiedLoop& other) {
    return !same_but_along(best, other, params_.search) &&
           other.consistency * other.overlap > params_.rival_consistency * best.consistency * best.overlap;
  });
}

std::optional<VerifiedLoop> LoopDetector::verify(const std::vector<SeenPoints>& seen_query,
                                                 const LoopTarget& target) const {
  const Query query(seen_query, params_);
  SearchWindow window = window_of(target.target_T_query);
  const LikelihoodPyramid& map = target.place->pyramid();
  const std::vector<VerifiedLoop> loops = fitting(query, target, search_.search(map, query.all, window).candidates);
  const auto best = std::max_element(loops.begin(), loops.end(), [](const VerifiedLoop& a, const VerifiedLoop& b) {
    return a.consistency * a.overlap < b.consistency * b.overlap;
  });
  if (best == loops.end() || has_rival(*best, loops)) {
    return std::nullopt;
  }
  if (window.half_m < params_.rival_window_m) {
    window.half_m = params_.rival_window_m;
    std::vector<GlobalCandidate> others = search_.search(map, query.all, window).candidates;
    std::erase_if(others, [&](const GlobalCandidate& other) {
      return distance_m(other.map_T_base, best->target_T_query.a_T_b) < params_.search.distinct_m;
    });
    if (has_rival(*best, fitting(query, target, others))) {
      return std::nullopt;
    }
  }
  return *best;
}

std::vector<VerifiedLoop> LoopDetector::detect(const std::vector<SeenPoints>& seen_query,
                                               const std::vector<LoopTarget>& targets) const {
  std::vector<VerifiedLoop> loops;
  for (const LoopTarget& target : targets) {
    if (auto loop = verify(seen_query, target)) {
      loops.push_back(*std::move(loop));
    }
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const VerifiedLoop& a, const VerifiedLoop& b) { return a.consistency > b.consistency; });
  return loops;
}

}  // namespace seeker::slam
