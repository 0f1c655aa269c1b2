#include "server/slam/sp_map.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/slam/sp_association.hpp"
#include "server/slam/sp_existence.hpp"
#include "server/slam/sp_features.hpp"

namespace seeker::slam {
namespace {

using lines::SegmentObservation;

/// No pose is known better than this: keeps the covariance positive definite from the start.
constexpr double kRobotFloor = 1e-12;

Matrix3 usable(const Matrix3& covariance) {
  SEEKER_ASSERT(covariance.allFinite());
  return 0.5 * (covariance + covariance.transpose()) + kRobotFloor * Matrix3::Identity();
}

std::vector<SpPair> pairs_of(const SpState& state, const Association& association) {
  std::vector<SpPair> pairs;
  for (std::size_t k = 0; k < association.matches.size(); ++k) {
    const SpMatch& match = association.matches[k];
    if (match.verdict != SpVerdict::kPaired) {
      continue;
    }
    // A segment that was forgotten since is no partner.
    if (const std::optional<std::size_t> segment = state.index_of(match.segment)) {
      const std::array<bool, 2>& real = state.segments[*segment].real;
      pairs.push_back({k, *segment, {match.ends[0] && real[0], match.ends[1] && real[1]}});
    }
  }
  return pairs;
}

void note_sighting(SpState& state, const SpPair& pair) {
  SpSegment& f = state.segments[pair.segment];
  f.hits += f.last_seen == state.scans && f.hits > 0 ? 0 : 1;
  f.last_seen = state.scans;
  for (std::size_t side = 0; side < 2; ++side) {
    if (pair.ends[side]) {
      state.note_end_used(pair.segment, side);
    }
  }
}

void update_at_once(SpState& state, const std::vector<SegmentObservation>& observations,
                    const std::vector<SpPair>& pairs, SpUpdateReport& report) {
  update_jointly(state, observations, pairs, report);
  for (const SpPair& pair : pairs) {
    note_sighting(state, pair);
    follow_ends(state, pair.segment, observations[pair.observation]);
  }
  report.paired = static_cast<int>(pairs.size());
}

/// D2 of a pair for the present state.
double present_d2(const SpState& state, const SpPair& pair, const SegmentObservation& observation) {
  PairCandidate candidate;
  candidate.observation = pair.observation;
  candidate.segment = pair.segment;
  candidate.geometry =
      pair_geometry(state.segments[pair.segment].map_T_segment, state.map_T_base, observation.base_T_segment);
  return group_d2(state.p, rows_of_pair(state, candidate, observation, {}));
}

/// S1.7 as printed: pair by pair, the nearest first, everything recomputed after each.
void update_sequentially(SpState& state, const std::vector<SegmentObservation>& observations, std::vector<SpPair> pairs,
                         SpUpdateReport& report) {
  Matrix3 information = Matrix3::Zero();
  const SpAssociationParams& association = state.params.association;
  const bool nearest_neighbour = association.method == SpAssociationMethod::kNearestNeighbour;
  const double gate = nearest_neighbour ? association.nearest_gate : association.near_gate;
  while (!pairs.empty()) {
    std::size_t nearest = 0;
    double nearest_d2 = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double d2 = present_d2(state, pairs[k], observations[pairs[k].observation]);
      if (k == 0 || d2 < nearest_d2) {
        nearest = k;
        nearest_d2 = d2;
      }
    }
    const SpPair pair = pairs[nearest];
    pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(nearest));
    if (nearest_d2 > gate) {
      ++report.rejected;
      continue;
    }
    SpUpdateReport one;
    update_at_once(state, observations, {pair}, one);
    information += state.observability.information;
    report.paired += 1;
    report.iterations = 1;
    report.d2 += one.d2;
    report.dof += one.dof;
  }
  set_observability(state, information);
}

/// Two ends that were seen badly may be corrected past each other.
std::vector<SegmentId> forget_short_segments(SpState& state) {
  std::vector<SegmentId> gone;
  for (std::size_t k = state.segments.size(); k-- > 0;) {
    if (state.segments[k].length_m < state.params.features.min_length_m) {
      gone.push_back(state.segments[k].id);
      state.erase(k);
    }
  }
  return gone;
}

/// H = rows of I3 (all directions), or the two directions that are known.
struct PoseRows {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> h;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> f;
  Square r;
};

PoseRows pose_rows(const SpState& state, const Pose2& map_T_base, const Matrix3& covariance_map,
                   const std::optional<Point2>& degenerate_direction) {
  const Pose2 d = inverse(state.map_T_base) * map_T_base;
  PoseRows rows;
  rows.h = Matrix3::Identity();
  if (degenerate_direction) {
    const Pose2 rotation{0.0, 0.0, -state.map_T_base.theta_rad};
    const Point2 along = (rotation * *degenerate_direction).normalized();
    rows.h.resize(2, 3);
    rows.h << -along.y(), along.x(), 0.0, 0.0, 0.0, 1.0;
  }
  rows.f = -rows.h * Eigen::Vector3d(d.x_m, d.y_m, d.theta_rad);
  // The measurement's own noise rotated from `map` to the frame of the measured pose; d carries it on to first order.
  const Matrix3 noise = to_base_frame(covariance_map, map_T_base);
  const Matrix3 rotated = compose_jacobian_b(d, {}) * noise * compose_jacobian_b(d, {}).transpose();
  rows.r = rows.h * usable(rotated) * rows.h.transpose();
  return rows;
}

void limit_robot(SpState& state) {
  const double max_m2 = state.params.robot_sigma_max_m * state.params.robot_sigma_max_m;
  const double max_rad2 = state.params.robot_sigma_max_rad * state.params.robot_sigma_max_rad;
  if (state.p(0, 0) + state.p(1, 1) <= max_m2 && state.p(2, 2) <= max_rad2) {
    return;
  }
  state.p.decouple(0, Eigen::Vector3d(0.5 * max_m2, 0.5 * max_m2, max_rad2).asDiagonal().toDenseMatrix());
}

}  // namespace

bool is_usable(const SegmentObservation& observation) {
  const Matrix2& c = observation.covariance;
  return is_finite(observation.base_T_segment) && std::isfinite(observation.length_m) && observation.length_m > 0.0 &&
         c.allFinite() && c(0, 0) >= 0.0 && c(1, 1) >= 0.0 && c.determinant() >= 0.0 &&
         std::isfinite(observation.end_sigma_m[0]) && std::isfinite(observation.end_sigma_m[1]);
}

std::optional<std::size_t> SpState::index_of(SegmentId id) const {
  const auto found = std::lower_bound(segments.begin(), segments.end(), id,
                                      [](const SpSegment& segment, SegmentId wanted) { return segment.id < wanted; });
  if (found == segments.end() || found->id != id) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - segments.begin());
}

double SpState::end_bearing_rad(std::size_t segment, std::size_t side) const {
  const SpSegment& f = segments[segment];
  const Point2 end = inverse(map_T_base) * f.map_T_segment * Point2(0.5 * end_sign(side) * f.length_m, 0.0);
  return std::atan2(end.y(), end.x());
}

bool SpState::is_end_news(std::size_t segment, std::size_t side, double beam_step_rad) const {
  const std::optional<double>& used_rad = records[segment].end_used_rad[side];
  return !used_rad ||
         std::abs(wrap_angle(end_bearing_rad(segment, side) - *used_rad)) >= params.end_beams * beam_step_rad;
}

void SpState::note_end_used(std::size_t segment, std::size_t side) {
  records[segment].end_used_rad[side] = end_bearing_rad(segment, side);
}

void SpState::shift_rows(std::size_t first, Index by) {
  for (std::size_t k = first; k < records.size(); ++k) {
    records[k].at += by;
  }
}

void SpState::erase(std::size_t segment) {
  const SegmentRows rows = rows_of(segment);
  p.erase(rows.at, rows.count());
  shift_rows(segment + 1, -rows.count());
  segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(segment));
  records.erase(records.begin() + static_cast<std::ptrdiff_t>(segment));
}

Matrix3 to_base_frame(const Matrix3& covariance_map, const Pose2& map_T_base) {
  const Matrix3 rotation = compose_jacobian_b(map_T_base, {});
  return rotation.transpose() * covariance_map * rotation;
}

Matrix3 to_map_frame(const Matrix3& covariance_base, const Pose2& map_T_base) {
  const Matrix3 rotation = compose_jacobian_b(map_T_base, {});
  return rotation * covariance_base * rotation.transpose();
}

SpMap::SpMap(const Pose2& map_T_base, const Matrix3& covariance, const SpMapParams& params)
    : state_(std::make_unique<SpState>(params, map_T_base, usable(covariance))) {
  SEEKER_ASSERT(is_finite(map_T_base));
}
SpMap::SpMap(const SpMap& other) : state_(std::make_unique<SpState>(*other.state_)) {}
SpMap& SpMap::operator=(const SpMap& other) {
  *this = SpMap(other);
  return *this;
}
SpMap::SpMap(SpMap&&) noexcept = default;
SpMap& SpMap::operator=(SpMap&&) noexcept = default;
SpMap::~SpMap() = default;

void SpMap::predict(const Pose2& increment, const Matrix3& covariance) {
  SEEKER_ASSERT(is_finite(increment));
  SpState& state = *state_;
  state.map_T_base = state.map_T_base * increment;
  state.p.transform(0, transport(inverse(increment)));
  state.p.add(0, usable(covariance));
  limit_robot(state);
}

Association SpMap::associate(const std::vector<SegmentObservation>& observations) const {
  return state_->params.association.method == SpAssociationMethod::kJoint ? associate_jointly(*state_, observations)
                                                                          : associate_nearest(*state_, observations);
}

SpUpdateReport SpMap::update(const std::vector<SegmentObservation>& observations, const Association& association) {
  SEEKER_ASSERT(association.matches.size() == observations.size());
  SpState& state = *state_;
  ++state.scans;
  SpUpdateReport report;
  std::vector<SegmentId> touched;
  for (const SpMatch& match : association.matches) {
    report.ambiguous += match.verdict == SpVerdict::kAmbiguous ? 1 : 0;
    report.rejected += match.verdict == SpVerdict::kRejected ? 1 : 0;
  }
  const std::vector<SpPair> pairs = pairs_of(state, association);
  for (const SpPair& pair : pairs) {
    touched.push_back(state.segments[pair.segment].id);
    report.ends += static_cast<int>(pair.ends[0]) + static_cast<int>(pair.ends[1]);
  }
  if (state.params.update == SpUpdateMethod::kJoint) {
    update_at_once(state, observations, pairs, report);
  } else {
    update_sequentially(state, observations, pairs, report);
  }
  report.lost = forget_short_segments(state);
  add_new_segments(state, observations, association, report);
  touched.insert(touched.end(), report.created.begin(), report.created.end());
  merge_segments(state, touched, report);
  for (const SegmentId id : forget_short_segments(state)) {
    report.lost.push_back(id);
  }
  return report;
}

std::vector<SegmentId> SpMap::observe_free_space(const LaserScan& scan) {
  SpState& state = *state_;
  const SpExistenceParams& params = state.params.existence;
  std::vector<SegmentId> gone;
  for (std::size_t k = state.segments.size(); k-- > 0;) {
    const Sight sight = look_at(state, k, scan);
    SpSegment& segment = state.segments[k];
    segment.misses = sight == Sight::kDenied ? segment.misses + 1 : sight == Sight::kConfirmed ? 0 : segment.misses;
    const int limit = segment.hits <= params.young_hits ? params.young_misses : params.misses;
    if (segment.misses >= limit) {
      gone.push_back(segment.id);
      state.erase(k);
    }
  }
  return gone;
}

double SpMap::pose_d2(const Pose2& map_T_base, const Matrix3& covariance_map,
                      const std::optional<Point2>& degenerate_direction) const {
  const PoseRows rows = pose_rows(*state_, map_T_base, covariance_map, degenerate_direction);
  const PoseRows::Square s = rows.h * state_->p.block(0, kRobotRows) * rows.h.transpose() + rows.r;
  return rows.f.dot(s.ldlt().solve(rows.f));
}

double SpMap::observe_pose(const Pose2& map_T_base, const Matrix3& covariance_map,
                           const std::optional<Point2>& degenerate_direction) {
  SEEKER_ASSERT(is_finite(map_T_base));
  const double d2 = pose_d2(map_T_base, covariance_map, degenerate_direction);
  const PoseRows rows = pose_rows(*state_, map_T_base, covariance_map, degenerate_direction);
  Eigen::MatrixXd pht = robot_columns(*state_) * rows.h.transpose();
  Eigen::MatrixXd s = rows.h * pht.topRows(kRobotRows) + rows.r;
  correct(*state_, pht, s, rows.f);
  forget_short_segments(*state_);
  return d2;
}

void SpMap::set_robot(const Pose2& map_T_base, const Matrix3& covariance) {
  SEEKER_ASSERT(is_finite(map_T_base));
  state_->map_T_base = map_T_base;
  state_->p.decouple(0, usable(covariance));
}

bool SpMap::forget(SegmentId id) {
  const std::optional<std::size_t> segment = state_->index_of(id);
  if (segment) {
    state_->erase(*segment);
  }
  return segment.has_value();
}

const Pose2& SpMap::robot() const { return state_->map_T_base; }
Matrix3 SpMap::robot_covariance() const { return state_->p.block(0, kRobotRows); }
Matrix3 SpMap::robot_covariance_map() const { return to_map_frame(robot_covariance(), state_->map_T_base); }
const std::vector<SpSegment>& SpMap::segments() const { return state_->segments; }
const SpSegment* SpMap::find(SegmentId id) const {
  const std::optional<std::size_t> segment = state_->index_of(id);
  return segment ? &state_->segments[*segment] : nullptr;
}
SegmentCovariance SpMap::segment_covariance(SegmentId id) const {
  const std::optional<std::size_t> segment = state_->index_of(id);
  SEEKER_ASSERT(segment.has_value());
  const SegmentRows rows = state_->rows_of(*segment);
  return state_->p.block(rows.at, rows.count());
}
Eigen::MatrixXd SpMap::segment_robot_covariance(SegmentId id) const {
  const std::optional<std::size_t> segment = state_->index_of(id);
  SEEKER_ASSERT(segment.has_value());
  const SegmentRows rows = state_->rows_of(*segment);
  Eigen::MatrixXd columns(state_->p.rows(), kRobotRows);
  state_->p.gather(0, kRobotRows, columns);
  return columns.middleRows(rows.at, rows.count());
}
Eigen::MatrixXd SpMap::covariance() const { return state_->p.full(); }
Eigen::MatrixXd SpMap::joint_covariance(const std::vector<SegmentId>& ids) const {
  std::vector<Index> rows{0, 1, 2};
  rows.reserve(kRobotRows + kMaxSegmentRows * ids.size());
  for (const SegmentId id : ids) {
    const std::optional<std::size_t> segment = state_->index_of(id);
    SEEKER_ASSERT(segment.has_value());
    const SegmentRows own = state_->rows_of(*segment);
    for (Index k = 0; k < own.count(); ++k) {
      rows.push_back(own.at + k);
    }
  }
  const auto n = static_cast<Index>(rows.size());
  Eigen::MatrixXd joint(n, n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      joint(i, j) = state_->p(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
    }
  }
  return joint;
}
const Observability& SpMap::observability() const { return state_->observability; }
std::uint64_t SpMap::scans() const { return state_->scans; }
const SpMapParams& SpMap::params() const { return state_->params; }

}  // namespace seeker::slam
