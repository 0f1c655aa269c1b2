/// \file
/// The normal equations of a pose graph: a sparse symmetric matrix of 3x3 blocks, filled in place.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "common/core/pose2.hpp"

namespace seeker::slam {

/// The linear system H dx = b with one 3-vector per variable. The pattern is ordered (approximate minimum degree over
/// blocks, a ninth of the work of ordering scalars) and analysed once; blocks are added without searching.
class BlockSystem {
 public:
  using Pair = std::pair<std::size_t, std::size_t>;

  /// The pattern has one block on the diagonal for each of `variables` and one for each pair of different variables.
  BlockSystem(std::size_t variables, const std::vector<Pair>& pairs);

  void set_zero();
  void add_diagonal(std::size_t variable, const Matrix3& block);
  /// Adds `block` = H(a, b) of the pair with that index, as given to the constructor, and its transpose.
  void add_pair(std::size_t pair, const Matrix3& block);
  void add_right(std::size_t variable, const Eigen::Vector3d& value);

  /// Factors H + damping * diag(H). False when the matrix is not positive definite or not finite.
  [[nodiscard]] bool factor(double damping);
  /// Solves for the right side that was added; requires factor().
  void solve();
  [[nodiscard]] Eigen::Vector3d solution(std::size_t variable) const;
  /// The block H^-1(row, column of `variable`) for each requested row; requires factor().
  [[nodiscard]] std::vector<Matrix3> inverse_blocks(std::size_t variable, const std::vector<std::size_t>& rows) const;

 private:
  using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  struct Slot {
    std::size_t row = 0;      ///< block row, above the diagonal
    std::size_t column = 0;   ///< block column
    int rank = 0;             ///< rank among the blocks of the column
    bool transposed = false;  ///< the pair was given in the opposite order
  };

  void order(std::size_t variables, const std::vector<Pair>& pairs);
  void lay_out(const std::vector<Pair>& pairs);
  [[nodiscard]] double* column_values(std::size_t column, int scalar, int rank);

  std::vector<std::size_t> place_;  ///< position of each variable in the ordering
  std::vector<int> above_;          ///< number of blocks above the diagonal, by block column
  std::vector<Slot> slots_;         ///< matrix block of each pair
  Sparse matrix_;                   ///< upper triangle
  Eigen::VectorXd right_;
  Eigen::VectorXd solution_;
  Eigen::SimplicialLDLT<Sparse, Eigen::Upper, Eigen::NaturalOrdering<int>> cholesky_;
};

}  // namespace seeker::slam
