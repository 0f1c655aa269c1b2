/// \file
/// The measurement rows of one pair of observation and segment, with the part of the state they depend on.
#pragma once

#include <array>

#include "server/lines/observation.hpp"
#include "server/slam/sp_covariance.hpp"
#include "server/slam/sp_map.hpp"

namespace seeker::slam {

/// The rows of a segment in the state.
struct SegmentRows {
  Index at = 0;
  std::array<bool, 2> real{};

  [[nodiscard]] Index count() const { return 2 + Index{real[0]} + Index{real[1]}; }
  /// Row of a real end, relative to `at`.
  [[nodiscard]] Index end(std::size_t side) const { return side == 1 && real[0] ? 3 : 2; }
};

/// Selected rows of S1.5 of one pair, over the robot's three columns and the segment's own ones.
struct RowGroup {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 7>;
  using NoiseRows = Eigen::Matrix<double, Eigen::Dynamic, 4, 0, 4, 4>;
  using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;

  std::size_t observation = 0;
  Index at = 0;       ///< first row of the segment
  Index columns = 2;  ///< number of rows of the segment
  Values f;
  Rows h;                                  ///< first 3 columns: d_R; then p_F
  NoiseRows g;                             ///< derivatives by p_O in the order y, theta, left, right
  Matrix4 observed = Matrix4::Identity();  ///< covariance of p_O

  [[nodiscard]] Index rows() const { return f.size(); }
};

/// Selection of the rows: y and theta together, the left end and the right end.
struct RowChoice {
  bool line = true;
  std::array<bool, 2> ends{};
};

/// Covariance of p_O with its lower limit; virtual ends have the variance 1, which no row uses.
[[nodiscard]] Matrix4 observed_covariance(const lines::SegmentObservation& observation, const SpMapParams& params);

/// Variance of p_e of a real end.
[[nodiscard]] double end_variance_m2(const lines::SegmentObservation& observation, std::size_t side,
                                     const SpMapParams& params);

[[nodiscard]] RowGroup row_group(const PairRows& rows, const SegmentRows& segment, std::size_t observation,
                                 const Matrix4& observed, const RowChoice& choice);

/// H_a P H_b^T, plus the common noise where both are rows of one observation.
[[nodiscard]] Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> innovation_covariance(
    const SpCovariance& p, const RowGroup& a, const RowGroup& b);

}  // namespace seeker::slam
