#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "server/slam/sp_features.hpp"

namespace seeker::slam {
namespace {

/// Regularises the constraint of S1.9.
constexpr double kConstraintVariance = 1e-10;

/// Places of the two segments on the x axis of the first.
bool are_neighbours(const SpState& state, std::size_t first, std::size_t second) {
  const SpFeatureParams& params = state.params.features;
  const SpSegment& i = state.segments[first];
  const SpSegment& j = state.segments[second];
  // Most pairs are far apart: no trigonometry for them.
  const double reach_m = 0.5 * (i.length_m + j.length_m) + params.merge_gap_m + params.merge_offset_m;
  const Point2 apart = j.map_T_segment.translation() - i.map_T_segment.translation();
  if (apart.squaredNorm() > reach_m * reach_m) {
    return false;
  }
  const Pose2 d = inverse(i.map_T_segment) * j.map_T_segment;
  if (std::abs(d.theta_rad) > params.merge_angle_rad || std::abs(d.y_m) > params.merge_offset_m) {
    return false;
  }
  const double gap_m = std::abs(d.x_m) - 0.5 * (i.length_m + j.length_m);
  const std::size_t facing = d.x_m < 0.0 ? lines::kLeft : lines::kRight;
  const bool doorway = i.real[facing] && j.real[1 - facing] && gap_m > params.doorway_m;
  return gap_m <= params.merge_gap_m && !doorway;
}

Matrix2 cross_block(const SpCovariance& p, Index a, Index b) {
  Matrix2 block;
  block << p(a, b), p(a, b + 1), p(a + 1, b), p(a + 1, b + 1);
  return block;
}

/// Whether two segments are one line: they agree, and their covariances are small enough for that to be significant.
bool are_one_line(const SpState& state, std::size_t first, std::size_t second) {
  const MergeRows rows = merge_rows(state.segments[first].map_T_segment, state.segments[second].map_T_segment);
  const Index a = state.records[first].at;
  const Index b = state.records[second].at;
  const Matrix2 cross = rows.first * cross_block(state.p, a, b) * rows.second.transpose();
  const Matrix2 s = rows.first * cross_block(state.p, a, a) * rows.first.transpose() + cross + cross.transpose() +
                    rows.second * cross_block(state.p, b, b) * rows.second.transpose() +
                    kConstraintVariance * Matrix2::Identity();
  const SpFeatureParams& params = state.params.features;
  const bool known = params.merge_sigma_m <= 0.0 || s(0, 0) <= params.merge_sigma_m * params.merge_sigma_m;
  return known && rows.f.dot(s.ldlt().solve(rows.f)) <= params.merge_gate;
}

bool constrain(SpState& state, std::size_t first, std::size_t second) {
  const MergeRows rows = merge_rows(state.segments[first].map_T_segment, state.segments[second].map_T_segment);
  const Index a = state.records[first].at;
  const Index b = state.records[second].at;
  const Index n = state.p.rows();
  Eigen::Map<Eigen::MatrixXd> pht = state.scratch[0].matrix(n, 2);
  Eigen::Map<Eigen::MatrixXd> columns = state.scratch[2].matrix(n, 2);
  state.p.gather(a, 2, columns);
  pht.noalias() = columns * rows.first.transpose();
  state.p.gather(b, 2, columns);
  pht.noalias() += columns * rows.second.transpose();
  Eigen::MatrixXd s = rows.first * pht.middleRows<2>(a) + rows.second * pht.middleRows<2>(b);
  s += kConstraintVariance * Eigen::MatrixXd::Identity(2, 2);
  return correct(state, pht, s, rows.f);
}

/// i takes over the real end of j, both already one line: row of S1.9.
void take_end(SpState& state, std::size_t first, std::size_t second, std::size_t side, const Pose2& i_T_j) {
  const SegmentRows j = state.rows_of(second);
  const double q = 0.5 * end_sign(side) * state.segments[second].length_m;
  const double c = std::cos(i_T_j.theta_rad);
  const double s = std::sin(i_T_j.theta_rad);
  const Index n = state.p.rows();
  const Index at = state.records[first].at;
  Eigen::Map<Eigen::MatrixXd> columns = state.scratch[2].matrix(n, 2);
  state.p.gather(at, 2, columns);
  const double of_theta = i_T_j.y_m + q * s;
  Eigen::VectorXd covariances = columns.col(1) * of_theta;
  state.p.gather(j.at, 2, columns);
  covariances += columns * Eigen::Vector2d(-s, -q * s);
  Eigen::Map<Eigen::MatrixXd> end = state.scratch[2].matrix(n, 1);
  state.p.gather(j.at + j.end(side), 1, end);
  covariances += end.col(0) * c;
  const double variance = of_theta * covariances(at + 1) - s * covariances(j.at) - q * s * covariances(j.at + 1) +
                          c * covariances(j.at + j.end(side));
  state.segments[first].real[side] = true;
  state.records[first].end_used_rad[side] = state.records[second].end_used_rad[side];
  state.p.insert(at + state.rows_of(first).end(side), covariances, variance);
  state.shift_rows(first + 1, 1);
}

/// On each side the outermost end; a real one that is nearly so.
void transfer_end(SpState& state, std::size_t first, std::size_t second, std::size_t side) {
  const SpSegment& i = state.segments[first];
  const SpSegment& j = state.segments[second];
  Pose2 i_T_j = inverse(i.map_T_segment) * j.map_T_segment;
  const double x_m = i_T_j.x_m + 0.5 * end_sign(side) * j.length_m * std::cos(i_T_j.theta_rad);
  const double past_m = end_sign(side) * x_m - 0.5 * i.length_m;
  const double slack_m = state.params.features.end_slack_m;
  const double least_m = i.real[side] ? slack_m : j.real[side] ? -slack_m : 0.0;
  if (past_m <= least_m) {
    return;
  }
  if (i.real[side]) {
    state.p.erase(state.records[first].at + state.rows_of(first).end(side), 1);
    state.segments[first].real[side] = false;
    state.shift_rows(first + 1, -1);
  }
  move_end(state, first, side, x_m);
  if (j.real[side]) {
    i_T_j = inverse(i.map_T_segment) * j.map_T_segment;
    take_end(state, first, second, side, i_T_j);
  }
}

/// The first of these two stays.
void merge_pair(SpState& state, std::size_t first, std::size_t second, SpUpdateReport& report) {
  if (!constrain(state, first, second)) {
    return;
  }
  for (const std::size_t side : {lines::kLeft, lines::kRight}) {
    transfer_end(state, first, second, side);
  }
  SpSegment& kept = state.segments[first];
  const SpSegment& gone = state.segments[second];
  kept.hits += gone.hits;
  kept.misses = std::min(kept.misses, gone.misses);
  kept.last_seen = std::max(kept.last_seen, gone.last_seen);
  report.merged.push_back({kept.id, gone.id});
  state.erase(second);
}

std::optional<std::size_t> partner_of(const SpState& state, std::size_t segment) {
  for (std::size_t other = 0; other < state.segments.size(); ++other) {
    if (other == segment) {
      continue;
    }
    const auto [first, second] = std::minmax(segment, other);
    if (are_neighbours(state, first, second) && are_one_line(state, first, second)) {
      return other;
    }
  }
  return std::nullopt;
}

}  // namespace

void merge_segments(SpState& state, const std::vector<SegmentId>& touched, SpUpdateReport& report) {
  for (const SegmentId id : touched) {
    std::optional<std::size_t> segment = state.index_of(id);
    while (segment) {
      const std::optional<std::size_t> other = partner_of(state, *segment);
      if (!other) {
        break;
      }
      const std::size_t before = state.segments.size();
      merge_pair(state, std::min(*segment, *other), std::max(*segment, *other), report);
      if (state.segments.size() == before) {
        break;
      }
      segment = *other < *segment ? other : segment;
    }
  }
}

}  // namespace seeker::slam
