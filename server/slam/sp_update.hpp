/// \file
/// The filter's correction (spec S1.7, S1.10).
#pragma once

#include "server/slam/sp_state.hpp"

namespace seeker::slam {

/// An observation and its segment.
struct SpPair {
  std::size_t observation = 0;
  std::size_t segment = 0;
  std::array<bool, 2> ends{};
};

/// One update by the rows of all pairs together: S = H P H^T + R, rank-k downdate, centring; linearised a second time
/// after a large correction of the robot. Fills the report and the observability.
void update_jointly(SpState& state, const std::vector<lines::SegmentObservation>& observations,
                    const std::vector<SpPair>& pairs, SpUpdateReport& report);

/// A correction by any rows: P H^T in `pht` and S in `s` (both overwritten), innovation f = h(0): p = -P H^T S^-1 f.
/// False without any change where S is not positive definite.
bool correct(SpState& state, Eigen::Ref<Eigen::MatrixXd> pht, Eigen::Ref<Eigen::MatrixXd> s,
             const Eigen::Ref<const Eigen::VectorXd>& f);

/// Applies the perturbation to the estimates (eqs (15)-(17)).
void centre(SpState& state, const Eigen::Ref<const Eigen::VectorXd>& p);

/// Decomposes the information of the pairs of a scan about d_R into eigenvectors.
void set_observability(SpState& state, const Matrix3& information);

/// Covariance of the robot with the whole state, n x 3.
[[nodiscard]] Eigen::Map<Eigen::MatrixXd> robot_columns(SpState& state);

}  // namespace seeker::slam
