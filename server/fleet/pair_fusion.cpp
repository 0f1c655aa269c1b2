#include "server/fleet/pair_fusion.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::fleet {
namespace {

/// What a pair says of the whole map, were it alone.
Pose2 map_a_T_map_b(const PairPlace& pair) { return pair.map_a_T_node.a_T_b * inverse(pair.map_b_T_node); }

/// One step of Gauss-Newton: what is left, weighted, and the information.
struct Normal {
  Matrix3 information = Matrix3::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
};

Normal normal_at(const Pose2& map_a_T_map_b, const std::vector<PairPlace>& pairs, const DistortionParams& params) {
  Normal normal;
  for (const PairPlace& pair : pairs) {
    const Pose2 now = map_a_T_map_b * pair.map_b_T_node;
    Matrix3 jacobian = Matrix3::Identity();
    jacobian(0, 2) = -(now.y_m - map_a_T_map_b.y_m);
    jacobian(1, 2) = now.x_m - map_a_T_map_b.x_m;
    const Matrix3 weight =
        slam::information_of(slam::with_floor(pair.map_a_T_node.covariance, params.sigma_m, params.sigma_rad));
    normal.information += jacobian.transpose() * weight * jacobian;
    normal.right += jacobian.transpose() * weight * offset_of(pair.map_a_T_node.a_T_b, now);
  }
  return normal;
}

}  // namespace

PairPlace pair_place(const UncertainPose& node_a_T_node_b, const Pose2& map_a_T_node_a, const Pose2& map_b_T_node_b) {
  return {compose({map_a_T_node_a, Matrix3::Zero()}, node_a_T_node_b), map_b_T_node_b};
}

UncertainPose fuse(const std::vector<PairPlace>& pairs, const DistortionParams& params) {
  SEEKER_ASSERT(!pairs.empty());
  constexpr int kMaxSteps = 20;
  constexpr double kStop = 1e-9;
  const auto surest = std::min_element(pairs.begin(), pairs.end(), [](const PairPlace& p, const PairPlace& q) {
    return p.map_a_T_node.covariance.trace() < q.map_a_T_node.covariance.trace();
  });
  Pose2 a_T_b = map_a_T_map_b(*surest);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Normal normal = normal_at(a_T_b, pairs, params);
    const Eigen::Vector3d change = normal.information.ldlt().solve(normal.right);
    a_T_b = {a_T_b.x_m + change.x(), a_T_b.y_m + change.y(), wrap_angle(a_T_b.theta_rad + change.z())};
    if (change.norm() < kStop) {
      break;
    }
  }
  return {a_T_b, slam::information_of(normal_at(a_T_b, pairs, params).information)};
}

Pose2 carried(const std::vector<PairPlace>& pairs, const Pose2& whole, const Pose2& map_b_T_node,
              const DistortionParams& params) {
  SEEKER_ASSERT(!pairs.empty());
  const auto nearest = std::min_element(pairs.begin(), pairs.end(), [&](const PairPlace& p, const PairPlace& q) {
    return distance_m(p.map_b_T_node, map_b_T_node) < distance_m(q.map_b_T_node, map_b_T_node);
  });
  const Pose2 rigid = whole * map_b_T_node;
  const Pose2 pair_T_node = inverse(nearest->map_b_T_node) * map_b_T_node;
  const Matrix3 no_error = Matrix3::Zero();
  const UncertainPose own = compose(nearest->map_a_T_node, {pair_T_node, no_error});
  const Matrix3 rigid_covariance = slam::with_floor(no_error, params.whole_sigma_m, params.whole_sigma_rad);
  const Matrix3 own_covariance = slam::with_floor(own.covariance, params.sigma_m, params.sigma_rad);
  const Eigen::Vector3d change =
      rigid_covariance * (rigid_covariance + own_covariance).ldlt().solve(offset_of(own.a_T_b, rigid));
  return {rigid.x_m + change.x(), rigid.y_m + change.y(), wrap_angle(rigid.theta_rad + change.z())};
}

}  // namespace seeker::fleet
