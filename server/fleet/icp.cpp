#include "server/fleet/icp.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"

namespace seeker::fleet {
namespace {

struct Pair {
  double square_m2 = 0.0;
  Point2 p_a;
  Point2 p_b;
};

std::vector<Pair> pairs_within(const slam::ReferenceCloud& reference, const std::vector<slam::OrientedPoint>& points,
                               const Pose2& a_T_b, double gate_m) {
  std::vector<Pair> pairs;
  pairs.reserve(points.size());
  for (const slam::OrientedPoint& point : points) {
    const Point2 p_a = a_T_b * point.p;
    if (const slam::OrientedPoint* partner = reference.nearest(p_a, gate_m)) {
      pairs.push_back({(partner->p - p_a).squaredNorm(), partner->p, point.p});
    }
  }
  return pairs;
}

/// The nearest share of them; their mean square.
double keep_nearest(std::vector<Pair>& pairs, double share) {
  const auto kept = static_cast<std::size_t>(std::ceil(share * static_cast<double>(pairs.size())));
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.square_m2 < b.square_m2; });
  pairs.resize(kept);
  double sum = 0.0;
  for (const Pair& pair : pairs) {
    sum += pair.square_m2;
  }
  return sum / static_cast<double>(kept);
}

Pose2 fit_of(const std::vector<Pair>& pairs) {
  std::vector<Point2> a(pairs.size());
  std::vector<Point2> b(pairs.size());
  std::transform(pairs.begin(), pairs.end(), a.begin(), [](const Pair& pair) { return pair.p_a; });
  std::transform(pairs.begin(), pairs.end(), b.begin(), [](const Pair& pair) { return pair.p_b; });
  return rigid_fit(a, b);
}

std::optional<IcpResult> iterate(const slam::ReferenceCloud& reference, const std::vector<slam::OrientedPoint>& points,
                                 const Pose2& start, const IcpParams& params) {
  IcpResult result{.a_T_b = start};
  double gate_m = params.first_gate_m;
  double last_m2 = gate_m * gate_m;
  while (!result.converged && result.iterations < params.max_iterations) {
    std::vector<Pair> pairs = pairs_within(reference, points, result.a_T_b, gate_m);
    if (pairs.size() < params.min_pairs) {
      return std::nullopt;
    }
    result.mean_square_m2 = keep_nearest(pairs, params.keep);
    result.a_T_b = fit_of(pairs);
    ++result.iterations;
    result.converged = gate_m <= params.last_gate_m && std::abs(last_m2 - result.mean_square_m2) < params.stop_m2;
    last_m2 = result.mean_square_m2;
    gate_m = std::max(params.last_gate_m, params.gate_shrink * gate_m);
  }
  const std::size_t partners = pairs_within(reference, points, result.a_T_b, params.last_gate_m).size();
  result.pair_share = static_cast<double>(partners) / static_cast<double>(points.size());
  return result;
}

}  // namespace

Pose2 rigid_fit(const std::vector<Point2>& points_a, const std::vector<Point2>& points_b) {
  SEEKER_ASSERT(!points_a.empty() && points_a.size() == points_b.size());
  Point2 mean_a = Point2::Zero();
  Point2 mean_b = Point2::Zero();
  for (std::size_t k = 0; k < points_a.size(); ++k) {
    mean_a += points_a[k] / static_cast<double>(points_a.size());
    mean_b += points_b[k] / static_cast<double>(points_a.size());
  }
  double cosine = 0.0;
  double sine = 0.0;
  for (std::size_t k = 0; k < points_a.size(); ++k) {
    const Point2 a = points_a[k] - mean_a;
    const Point2 b = points_b[k] - mean_b;
    cosine += a.dot(b);
    sine += b.x() * a.y() - b.y() * a.x();
  }
  const Pose2 turn{0.0, 0.0, std::atan2(sine, cosine)};
  const Point2 shift = mean_a - turn * mean_b;
  return {shift.x(), shift.y(), turn.theta_rad};
}

std::optional<IcpResult> icp(const slam::ReferenceCloud& reference_a, const std::vector<slam::OrientedPoint>& points_b,
                             const Pose2& guess, const IcpParams& params) {
  std::optional<IcpResult> best;
  for (const double rotation_rad : params.restarts_rad) {
    const Pose2 start{guess.x_m, guess.y_m, wrap_angle(guess.theta_rad + rotation_rad)};
    const std::optional<IcpResult> found = iterate(reference_a, points_b, start, params);
    const auto rank = [](const IcpResult& r) { return std::pair(r.pair_share, -r.mean_square_m2); };
    if (found && (!best || rank(*found) > rank(*best))) {
      best = found;
    }
  }
  return best;
}

}  // namespace seeker::fleet
