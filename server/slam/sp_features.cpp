#include "server/slam/sp_features.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

using lines::SegmentObservation;

constexpr double kSigmas = 3.0;

/// Of the place of the observation along the segment, as far as the robot is to blame for it.
double along_sigma_m(const SpState& state, const PairGeometry& pair) {
  const double variance = (pair.robot_x * state.p.block(0, kRobotRows) * pair.robot_x.transpose())(0);
  return std::sqrt(std::max(variance, 0.0));
}

/// Virtual -> real: nominal end where it was seen, and its row.
void make_real(SpState& state, std::size_t segment, std::size_t side, const SegmentObservation& observation) {
  SpSegment& f = state.segments[segment];
  const PairGeometry before = pair_geometry(f.map_T_segment, state.map_T_base, observation.base_T_segment);
  move_end(state, segment, side, before.end_x_m(side, observation.length_m));
  const PairGeometry pair = pair_geometry(f.map_T_segment, state.map_T_base, observation.base_T_segment);
  const EndRow row = end_row(pair, side, observation.length_m);
  const Index at = state.records[segment].at;
  Eigen::Map<Eigen::MatrixXd> own = state.scratch[2].matrix(state.p.rows(), 2);
  state.p.gather(at, 2, own);
  const Eigen::VectorXd covariances = robot_columns(state) * row.robot.transpose() + own * row.segment.transpose();
  const double variance = row.robot.dot(covariances.head<3>()) + row.segment.dot(covariances.segment<2>(at)) +
                          row.own * row.own * end_variance_m2(observation, side, state.params);
  f.real[side] = true;
  state.p.insert(at + state.rows_of(segment).end(side), covariances, variance);
  state.shift_rows(segment + 1, 1);
  state.note_end_used(segment, side);
}

void make_virtual(SpState& state, std::size_t segment, std::size_t side) {
  state.p.erase(state.records[segment].at + state.rows_of(segment).end(side), 1);
  state.segments[segment].real[side] = false;
  state.shift_rows(segment + 1, -1);
}

void follow_end(SpState& state, std::size_t segment, std::size_t side, const SegmentObservation& observation) {
  SpSegment& f = state.segments[segment];
  SegmentRecord& record = state.records[segment];
  const SpFeatureParams& params = state.params.features;
  const PairGeometry pair = pair_geometry(f.map_T_segment, state.map_T_base, observation.base_T_segment);
  const double x_m = pair.end_x_m(side, observation.length_m);
  const double past_m = end_sign(side) * x_m - 0.5 * f.length_m;
  const double slack_m = params.end_slack_m + kSigmas * along_sigma_m(state, pair);
  if (past_m < -slack_m) {
    return;  // this part of the wall ends before: it holds no information about the wall's end
  }
  if (f.real[side]) {
    record.overrun_votes[side] = past_m > slack_m ? record.overrun_votes[side] + 1 : 0;
    if (record.overrun_votes[side] < params.demote_scans) {
      return;
    }
    make_virtual(state, segment, side);
    record.overrun_votes[side] = 0;
  }
  record.real_votes[side] = observation.real[side] ? record.real_votes[side] + 1 : 0;
  if (record.real_votes[side] >= params.real_scans) {
    record.real_votes[side] = 0;
    make_real(state, segment, side, observation);
  } else if (past_m > 0.0) {
    move_end(state, segment, side, x_m);
  }
}

/// Whether it is the same wall as in the last scan, by a coarse comparison.
bool is_same(const Tentative& old, const Pose2& map_T_segment, double length_m, const SpFeatureParams& params) {
  const Pose2 d = inverse(old.map_T_segment) * map_T_segment;
  return std::abs(d.theta_rad) < params.tentative_rad && std::abs(d.y_m) < params.tentative_m &&
         std::abs(d.x_m) < 0.5 * (old.length_m + length_m);
}

}  // namespace

void move_end(SpState& state, std::size_t segment, std::size_t side, double x_m) {
  SpSegment& f = state.segments[segment];
  const double moved_m = x_m - 0.5 * end_sign(side) * f.length_m;
  const double length_m = f.length_m + end_sign(side) * moved_m;
  if (!(length_m > 0.0)) {
    return;
  }
  const double shift_m = 0.5 * moved_m;
  f.length_m = length_m;
  f.map_T_segment = f.map_T_segment * Pose2{shift_m, 0.0, 0.0};
  Matrix2 t;
  t << 1.0, shift_m, 0.0, 1.0;
  state.p.transform(state.records[segment].at, t);
}

void follow_ends(SpState& state, std::size_t segment, const SegmentObservation& observation) {
  for (const std::size_t side : {lines::kLeft, lines::kRight}) {
    follow_end(state, segment, side, observation);
  }
}

SegmentId add_segment(SpState& state, const SegmentObservation& observation) {
  SpSegment segment;
  segment.id = state.next_id++;
  segment.map_T_segment = state.map_T_base * observation.base_T_segment;
  segment.length_m = observation.length_m;
  segment.hits = 1;
  segment.created = state.scans;
  segment.last_seen = state.scans;
  SegmentRecord record;
  const bool ends_at_once = state.params.features.real_scans <= 1;
  for (std::size_t side = 0; side < 2; ++side) {
    segment.real[side] = ends_at_once && observation.real[side];
    record.real_votes[side] = observation.real[side] ? 1 : 0;
  }
  const SegmentRows rows{0, segment.real};
  const Matrix43 all = new_segment_rows(observation.base_T_segment);
  const Matrix4 noise = observed_covariance(observation, state.params);
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 4, 3> of_robot(rows.count(), 3);
  SpCovariance::SmallMatrix own = SpCovariance::SmallMatrix::Zero(rows.count(), rows.count());
  of_robot.topRows<2>() = all.topRows<2>();
  own.topLeftCorner<2, 2>() = noise.topLeftCorner<2, 2>();
  for (std::size_t side = 0; side < 2; ++side) {
    if (segment.real[side]) {
      const auto k = static_cast<Index>(2 + side);
      of_robot.row(rows.end(side)) = all.row(k);
      own(rows.end(side), rows.end(side)) = noise(k, k);
    }
  }
  record.at = state.p.append(of_robot, own);
  state.segments.push_back(segment);
  state.records.push_back(record);
  for (std::size_t side = 0; side < 2; ++side) {
    if (segment.real[side]) {
      state.note_end_used(state.segments.size() - 1, side);
    }
  }
  return segment.id;
}

void add_new_segments(SpState& state, const std::vector<SegmentObservation>& observations,
                      const Association& association, SpUpdateReport& report) {
  const SpFeatureParams& params = state.params.features;
  std::vector<Tentative> waiting;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (association.matches[k].verdict != SpVerdict::kNew || !is_usable(observations[k]) ||
        observations[k].length_m < params.min_length_m) {
      continue;
    }
    const Pose2 map_T_segment = state.map_T_base * observations[k].base_T_segment;
    int scans = 1;
    for (const Tentative& old : state.tentatives) {
      if (is_same(old, map_T_segment, observations[k].length_m, params)) {
        scans = std::max(scans, old.scans + 1);
      }
    }
    if (scans >= params.new_scans || observations[k].points >= params.new_points) {
      report.created.push_back(add_segment(state, observations[k]));
    } else {
      waiting.push_back({map_T_segment, observations[k].length_m, scans});
    }
  }
  state.tentatives = std::move(waiting);
}

}  // namespace seeker::slam
