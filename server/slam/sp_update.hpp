/// \file
/// The filter's correction (spec S1.7, S1.10).
#pragma once

#include "server/slam/sp_state.hpp"

namespace seeker::slam {

/// An observation and the segment it is of.
struct SpPair {
  std::size_t observation = 0;
  std::size_t segment = 0;
  std::array<bool, 2> ends{};
};

/// One update by the rows of all pairs together: S = H P H^T + R, rank-k downdate, centring; linearised a second time
/// where the robot moved much. Fills the figures of the report and the observability.
void update_jointly(SpState& state, const std::vector<lines::SegmentObservation>& observations,
                    const std::vector<SpPair>& pairs, SpUpdateReport& report);

/// A correction by any rows: P H^T in `pht`, S in `s` (both used up), innovation f = h(0): p = -P H^T S^-1 f.
/// False where S is not positive definite: nothing happened.
bool correct(SpState& state, Eigen::Ref<Eigen::MatrixXd> pht, Eigen::Ref<Eigen::MatrixXd> s,
             const Eigen::Ref<const Eigen::VectorXd>& f);

/// Takes the perturbation into the estimates (eqs (15)-(17)).
void centre(SpState& state, const Eigen::Ref<const Eigen::VectorXd>& p);

/// Eigen-decomposes the information that the pairs of a scan give of d_R.
void set_observability(SpState& state, const Matrix3& information);

/// Covariance of the robot against everything, n x 3.
[[nodiscard]] Eigen::Map<Eigen::MatrixXd> robot_columns(SpState& state);

}  // namespace seeker::slam
