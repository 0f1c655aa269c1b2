/// \file
/// The joint covariance of robot and segments. Only the lower triangle is kept; the robot's three rows come first, so
/// that a prediction touches the first three columns only. No operation of a step costs more than O(n^2).
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "server/slam/sp_geometry.hpp"

namespace seeker::slam {

using Index = Eigen::Index;

/// Number of rows of the robot, and of a segment: y, theta and its real ends.
inline constexpr Index kRobotRows = 3;
inline constexpr Index kMaxSegmentRows = 4;

/// The linear map of one segment's rows in centring, eq (17): y <- c y + s theta, ends += e y.
struct CentringStep {
  Index at = 0;
  Index rows = 2;
  double y_y = 1.0;
  double y_theta = 0.0;
  double end_y = 0.0;
};

class SpCovariance {
 public:
  using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

  /// The covariance of the robot alone.
  explicit SpCovariance(const Matrix3& robot);

  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] double operator()(Index i, Index j) const { return i >= j ? values_(i, j) : values_(j, i); }
  [[nodiscard]] SmallMatrix block(Index at, Index rows) const;
  /// Copies the rows [at, at + rows) against all columns into `out`: n x rows.
  void gather(Index at, Index rows, Eigen::Ref<Eigen::MatrixXd> out) const;
  [[nodiscard]] Eigen::MatrixXd full() const;

  /// Replaces the rows x = [at, at + rows) by A x; A has that number of rows.
  void transform(Index at, const SmallMatrix& a);
  /// Adds independent noise to a diagonal block.
  void add(Index at, const SmallMatrix& noise);
  /// Appends rows that are `of_robot` times the robot's plus independent noise, and returns their first index.
  Index append(const Eigen::Ref<const Eigen::MatrixXd>& of_robot, const SmallMatrix& noise);
  /// Inserts a row before `at` with these covariances to the present rows, and this variance.
  void insert(Index at, const Eigen::Ref<const Eigen::VectorXd>& covariances, double variance);
  void erase(Index at, Index count);
  /// Makes the rows independent of all others, with this covariance.
  void decouple(Index at, const SmallMatrix& covariance);
  /// P <- P - W W^T on the lower triangle; W has rows() rows.
  void downdate(const Eigen::Ref<const Eigen::MatrixXd>& w);
  /// Applies the centring in one pass; `steps` are in the order of their rows. Rows without a step are left unchanged.
  void centre(const std::vector<CentringStep>& steps);

 private:
  void reserve(Index rows);
  [[nodiscard]] double* cell(Index i, Index j) { return values_.data() + j * values_.outerStride() + i; }

  Eigen::MatrixXd values_;  ///< capacity x capacity; above the diagonal is scratch
  Index rows_ = 0;
};

/// P(i, j) -= sum_k W(i, k) W(j, k) for i >= j, which dominates the cost of an update. Uses the processor's vector unit
/// where available; may write above the diagonal.
void downdate_lower(Eigen::Ref<Eigen::MatrixXd> p, const Eigen::Ref<const Eigen::MatrixXd>& w);

}  // namespace seeker::slam
