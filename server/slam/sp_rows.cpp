#include "server/slam/sp_rows.hpp"

#include <algorithm>

namespace seeker::slam {

Matrix4 observed_covariance(const lines::SegmentObservation& observation, const SpMapParams& params) {
  Matrix4 c = Matrix4::Identity();
  c.topLeftCorner<2, 2>() = 0.5 * (observation.covariance + observation.covariance.transpose());
  c(0, 0) += params.sigma_floor_m * params.sigma_floor_m;
  c(1, 1) += params.sigma_floor_rad * params.sigma_floor_rad;
  for (std::size_t side = 0; side < 2; ++side) {
    if (observation.real[side]) {
      const auto k = static_cast<Index>(2 + side);
      c(k, k) = end_variance_m2(observation, side, params);
    }
  }
  return c;
}

double end_variance_m2(const lines::SegmentObservation& observation, std::size_t side, const SpMapParams& params) {
  const double sigma_m = std::max(observation.end_sigma_m[side], params.sigma_floor_m);
  return sigma_m * sigma_m;
}

RowGroup row_group(const PairRows& rows, const SegmentRows& segment, std::size_t observation, const Matrix4& observed,
                   const RowChoice& choice) {
  std::array<Index, 4> wanted{};
  Index count = 0;
  if (choice.line) {
    wanted[0] = 0;
    wanted[1] = 1;
    count = 2;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (choice.ends[side]) {
      wanted[static_cast<std::size_t>(count++)] = static_cast<Index>(2 + side);
    }
  }
  RowGroup group;
  group.observation = observation;
  group.at = segment.at;
  group.columns = segment.count();
  group.observed = observed;
  group.f.resize(count);
  group.h.setZero(count, kRobotRows + group.columns);
  group.g.resize(count, 4);
  for (Index r = 0; r < count; ++r) {
    const Index row = wanted[static_cast<std::size_t>(r)];
    group.f(r) = rows.f(row);
    group.h.block<1, 3>(r, 0) = rows.robot.row(row);
    group.h.block<1, 2>(r, 3) = rows.segment.block<1, 2>(row, 0);
    for (std::size_t side = 0; side < 2; ++side) {
      if (segment.real[side]) {
        group.h(r, kRobotRows + segment.end(side)) = rows.segment(row, static_cast<Index>(2 + side));
      }
    }
    group.g.row(r) = rows.observation.row(row);
  }
  return group;
}

Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> innovation_covariance(const SpCovariance& p,
                                                                                     const RowGroup& a,
                                                                                     const RowGroup& b) {
  const Index na = kRobotRows + a.columns;
  const Index nb = kRobotRows + b.columns;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 7, 7> joint(na, nb);
  for (Index j = 0; j < nb; ++j) {
    const Index column = j < kRobotRows ? j : b.at + j - kRobotRows;
    for (Index i = 0; i < na; ++i) {
      joint(i, j) = p(i < kRobotRows ? i : a.at + i - kRobotRows, column);
    }
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> s = a.h * joint * b.h.transpose();
  if (a.observation == b.observation) {
    s += a.g * a.observed * b.g.transpose();
  }
  return s;
}

}  // namespace seeker::slam
