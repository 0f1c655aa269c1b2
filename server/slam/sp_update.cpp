#include "server/slam/sp_update.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "common/core/assert.hpp"

namespace seeker::slam {
namespace {

using lines::SegmentObservation;

/// Below it the second-order terms of centring are lost in rounding and noise.
constexpr double kNegligible = 1e-6;

/// p of a segment in the order y, theta, left, right, from the vector of all.
Vector4 segment_part(const Eigen::Ref<const Eigen::VectorXd>& p, const SegmentRows& rows) {
  Vector4 part(p(rows.at), p(rows.at + 1), 0.0, 0.0);
  for (std::size_t side = 0; side < 2; ++side) {
    if (rows.real[side]) {
      part(static_cast<Index>(2 + side)) = p(rows.at + rows.end(side));
    }
  }
  return part;
}

Pose2 moved_robot(const Pose2& map_T_base, const Eigen::Ref<const Eigen::VectorXd>& p) {
  return map_T_base * Pose2{p(0), p(1), p(2)};
}

/// Columns of Q_F that a segment has.
RowGroup::Rows reduced(const Matrix4& q, const SegmentRows& rows) {
  RowGroup::Rows out(rows.count(), rows.count());
  std::array<Index, 4> index{0, 1, 0, 0};
  for (std::size_t side = 0; side < 2; ++side) {
    if (rows.real[side]) {
      index[static_cast<std::size_t>(rows.end(side))] = static_cast<Index>(2 + side);
    }
  }
  for (Index i = 0; i < rows.count(); ++i) {
    for (Index j = 0; j < rows.count(); ++j) {
      out(i, j) = q(index[static_cast<std::size_t>(i)], index[static_cast<std::size_t>(j)]);
    }
  }
  return out;
}

/// The rows of all pairs, linearised where the perturbation is `p` (empty: zero), as functions of p.
std::vector<RowGroup> linearise(const SpState& state, const std::vector<SegmentObservation>& observations,
                                const std::vector<SpPair>& pairs, const Eigen::VectorXd& p) {
  std::vector<RowGroup> groups;
  groups.reserve(pairs.size());
  const Pose2 robot = p.size() == 0 ? state.map_T_base : moved_robot(state.map_T_base, p);
  for (const SpPair& pair : pairs) {
    const SegmentObservation& observation = observations[pair.observation];
    const SpSegment& segment = state.segments[pair.segment];
    const SegmentRows rows = state.rows_of(pair.segment);
    SegmentShape shape{segment.map_T_segment, segment.length_m};
    if (p.size() != 0) {
      shape = perturbed(shape, segment_part(p, rows));
    }
    const PairGeometry geometry = pair_geometry(shape.map_T_segment, robot, observation.base_T_segment);
    groups.push_back(row_group(pair_rows(geometry, shape.length_m, observation.length_m), rows, pair.observation,
                               observed_covariance(observation, state.params), {true, pair.ends}));
    if (p.size() == 0) {
      continue;
    }
    RowGroup& group = groups.back();  // derivatives with respect to p - p_i behind Q; f of the iterated filter
    group.h.leftCols(kRobotRows) = (group.h.leftCols(kRobotRows) * robot_centring(p(2))).eval();
    group.h.rightCols(group.columns) =
        (group.h.rightCols(group.columns) * reduced(segment_centring(segment_part(p, rows)), rows)).eval();
    group.f -= group.h.leftCols(kRobotRows) * p.head(kRobotRows);
    group.f -= group.h.rightCols(group.columns) * p.segment(group.at, group.columns);
  }
  return groups;
}

Index rows_of(const std::vector<RowGroup>& groups) {
  Index rows = 0;
  for (const RowGroup& group : groups) {
    rows += group.rows();
  }
  return rows;
}

/// P H^T, S and f of all groups.
struct Stacked {
  Eigen::Map<Eigen::MatrixXd> pht;
  Eigen::MatrixXd s;
  Eigen::VectorXd f;
};

Stacked stack(SpState& state, const std::vector<RowGroup>& groups) {
  const Index n = state.p.rows();
  const Index m = rows_of(groups);
  Stacked stacked{state.scratch[0].matrix(n, m), Eigen::MatrixXd(m, m), Eigen::VectorXd(m)};
  const Eigen::Map<Eigen::MatrixXd> robot = robot_columns(state);
  Index first = 0;
  for (const RowGroup& group : groups) {
    Eigen::Map<Eigen::MatrixXd> segment = state.scratch[2].matrix(n, group.columns);
    state.p.gather(group.at, group.columns, segment);
    auto target = stacked.pht.middleCols(first, group.rows());
    target.noalias() = robot * group.h.leftCols(kRobotRows).transpose();
    target.noalias() += segment * group.h.rightCols(group.columns).transpose();
    stacked.f.segment(first, group.rows()) = group.f;
    first += group.rows();
  }
  first = 0;
  for (const RowGroup& group : groups) {
    auto rows = stacked.s.middleRows(first, group.rows());
    rows.noalias() = group.h.leftCols(kRobotRows) * stacked.pht.topRows(kRobotRows);
    rows.noalias() += group.h.rightCols(group.columns) * stacked.pht.middleRows(group.at, group.columns);
    rows.middleCols(first, group.rows()) += group.g * group.observed * group.g.transpose();
    first += group.rows();
  }
  return stacked;
}

/// Turns pht into W = P H^T L^-T and f into L^-1 f, S = L L^T.
// A writable Eigen::Ref is passed by value: a view, not a copy.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
bool solve(Eigen::Ref<Eigen::MatrixXd> pht, Eigen::Ref<Eigen::MatrixXd> s, Eigen::VectorXd& f) {
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(s);
  if (llt.info() != Eigen::Success) {
    return false;
  }
  llt.matrixU().solveInPlace<Eigen::OnTheRight>(pht);
  llt.matrixL().solveInPlace(f);
  return true;
}

Matrix3 information_of(const std::vector<RowGroup>& groups) {
  Matrix3 information = Matrix3::Zero();
  for (const RowGroup& group : groups) {
    const RowGroup::Rows robot = group.h.leftCols(kRobotRows);
    const SpCovariance::SmallMatrix noise = group.g * group.observed * group.g.transpose();
    information += robot.transpose() * noise.ldlt().solve(robot);
  }
  return information;
}

void add_drift(SpState& state, const std::vector<SpPair>& pairs) {
  const double m2 = state.params.drift_sigma_m * state.params.drift_sigma_m;
  const double rad2 = state.params.drift_sigma_rad * state.params.drift_sigma_rad;
  const Vector4 drift(m2, rad2, m2, m2);
  for (const SpPair& pair : pairs) {
    const SegmentRows rows = state.rows_of(pair.segment);
    const SpCovariance::SmallMatrix noise = drift.head(rows.count()).asDiagonal().toDenseMatrix();
    state.p.add(rows.at, noise);
  }
}

}  // namespace

void set_observability(SpState& state, const Matrix3& information) {
  Observability& out = state.observability;
  out = {};
  out.information = information;
  const double heading = std::max(information(2, 2), std::numeric_limits<double>::min());
  const Matrix2 position =
      information.topLeftCorner<2, 2>() - information.block<2, 1>(0, 2) * information.block<1, 2>(2, 0) / heading;
  const Eigen::SelfAdjointEigenSolver<Matrix2> solver(position);
  // What rounding leaves of a direction that no pair holds.
  const double nothing = 1e-12 * std::max(solver.eigenvalues()(1), 0.0);
  const double weakest = solver.eigenvalues()(0);
  out.weak_sigma_m = weakest > nothing ? 1.0 / std::sqrt(weakest) : std::numeric_limits<double>::infinity();
  const Pose2 rotation{0.0, 0.0, state.map_T_base.theta_rad};
  out.weak_direction = rotation * Point2(solver.eigenvectors().col(0));
  if (out.weak_sigma_m > state.params.degenerate_sigma_m) {
    out.degenerate_direction = out.weak_direction;
  }
}

Eigen::Map<Eigen::MatrixXd> robot_columns(SpState& state) {
  Eigen::Map<Eigen::MatrixXd> columns = state.scratch[1].matrix(state.p.rows(), kRobotRows);
  state.p.gather(0, kRobotRows, columns);
  return columns;
}

void centre(SpState& state, const Eigen::Ref<const Eigen::VectorXd>& p) {
  state.map_T_base = moved_robot(state.map_T_base, p);
  state.p.transform(0, robot_centring(p(2)));
  std::vector<CentringStep>& steps = state.steps;
  steps.clear();
  for (std::size_t k = 0; k < state.segments.size(); ++k) {
    const SegmentRows rows = state.rows_of(k);
    const Vector4 part = segment_part(p, rows);
    SpSegment& segment = state.segments[k];
    const SegmentShape moved = perturbed({segment.map_T_segment, segment.length_m}, part);
    segment.map_T_segment = moved.map_T_segment;
    segment.length_m = moved.length_m;
    const double shift_m = 0.5 * (part(2) + part(3));
    if (std::abs(shift_m) > kNegligible || std::abs(part(1)) > kNegligible) {
      steps.push_back({rows.at, rows.count(), std::cos(part(1)), shift_m, std::sin(part(1))});
    }
  }
  if (!steps.empty()) {
    state.p.centre(steps);
  }
}

// A writable Eigen::Ref is passed by value: a view, not a copy.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
bool correct(SpState& state, Eigen::Ref<Eigen::MatrixXd> pht, Eigen::Ref<Eigen::MatrixXd> s,
             const Eigen::Ref<const Eigen::VectorXd>& f) {
  Eigen::VectorXd reduced_f = f;
  if (!solve(pht, s, reduced_f)) {
    return false;
  }
  const Eigen::VectorXd p = -(pht * reduced_f);
  state.p.downdate(pht);
  centre(state, p);
  return true;
}

void update_jointly(SpState& state, const std::vector<SegmentObservation>& observations,
                    const std::vector<SpPair>& pairs, SpUpdateReport& report) {
  if (pairs.empty()) {
    set_observability(state, Matrix3::Zero());
    return;
  }
  std::vector<RowGroup> groups = linearise(state, observations, pairs, {});
  Stacked stacked = stack(state, groups);
  if (!solve(stacked.pht, stacked.s, stacked.f)) {
    return;
  }
  report.iterations = 1;
  report.d2 += stacked.f.squaredNorm();
  report.dof += static_cast<int>(stacked.f.size());
  Eigen::VectorXd p = -(stacked.pht * stacked.f);
  const bool far = std::hypot(p(0), p(1)) > state.params.relinearise_m || std::abs(p(2)) > state.params.relinearise_rad;
  if (far && state.params.update == SpUpdateMethod::kJoint) {
    groups = linearise(state, observations, pairs, p);
    stacked = stack(state, groups);
    const bool solved = solve(stacked.pht, stacked.s, stacked.f);
    SEEKER_ASSERT(solved);
    p.noalias() = -(stacked.pht * stacked.f);
    report.iterations = 2;
  }
  set_observability(state, information_of(groups));
  state.p.downdate(stacked.pht);
  add_drift(state, pairs);
  centre(state, p);
}

}  // namespace seeker::slam
