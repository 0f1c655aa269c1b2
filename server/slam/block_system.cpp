#include "server/slam/block_system.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/OrderingMethods>

#include "common/core/assert.hpp"

namespace seeker::slam {
namespace {

constexpr int kBlock = 3;
constexpr double kFloor = 1e-12;  ///< added to the damped diagonal, so that a variable without information stays put

int narrow(std::size_t value) { return static_cast<int>(value); }

}  // namespace

BlockSystem::BlockSystem(std::size_t variables, const std::vector<Pair>& pairs) {
  order(variables, pairs);
  lay_out(pairs);
  cholesky_.analyzePattern(matrix_);
}

void BlockSystem::order(std::size_t variables, const std::vector<Pair>& pairs) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * pairs.size() + variables);
  for (std::size_t v = 0; v < variables; ++v) {
    entries.emplace_back(narrow(v), narrow(v), 1.0);
  }
  for (const auto& [a, b] : pairs) {
    SEEKER_ASSERT(a != b && a < variables && b < variables);
    entries.emplace_back(narrow(a), narrow(b), 1.0);
    entries.emplace_back(narrow(b), narrow(a), 1.0);
  }
  Sparse pattern(narrow(variables), narrow(variables));
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern, permutation);
  place_.resize(variables);
  for (std::size_t p = 0; p < variables; ++p) {
    place_[static_cast<std::size_t>(permutation.indices()[narrow(p)])] = p;
  }
}

void BlockSystem::lay_out(const std::vector<Pair>& pairs) {
  std::vector<std::vector<std::size_t>> rows(place_.size());
  slots_.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t a = place_[pairs[k].first];
    const std::size_t b = place_[pairs[k].second];
    slots_[k] = {std::min(a, b), std::max(a, b), 0, a > b};
    rows[slots_[k].column].push_back(slots_[k].row);
  }
  std::vector<int> sizes(kBlock * rows.size());
  above_.resize(rows.size());
  for (std::size_t column = 0; column < rows.size(); ++column) {
    auto& list = rows[column];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    above_[column] = narrow(list.size());
    for (int s = 0; s < kBlock; ++s) {
      sizes[kBlock * column + static_cast<std::size_t>(s)] = kBlock * above_[column] + s + 1;
    }
  }
  for (Slot& slot : slots_) {
    const auto& list = rows[slot.column];
    slot.rank = static_cast<int>(std::lower_bound(list.begin(), list.end(), slot.row) - list.begin());
  }
  const int size = kBlock * narrow(place_.size());
  matrix_.resize(size, size);
  matrix_.reserve(sizes);
  for (std::size_t column = 0; column < rows.size(); ++column) {
    for (int s = 0; s < kBlock; ++s) {
      const int c = kBlock * narrow(column) + s;
      for (const std::size_t row : rows[column]) {
        for (int r = 0; r < kBlock; ++r) {
          matrix_.insert(kBlock * narrow(row) + r, c) = 0.0;
        }
      }
      for (int r = 0; r <= s; ++r) {
        matrix_.insert(kBlock * narrow(column) + r, c) = 0.0;
      }
    }
  }
  if (size > 0) {  // of an empty matrix it reads beyond the end
    matrix_.makeCompressed();
  }
  right_ = Eigen::VectorXd::Zero(size);
}

double* BlockSystem::column_values(std::size_t column, int scalar, int rank) {
  return matrix_.valuePtr() + matrix_.outerIndexPtr()[kBlock * narrow(column) + scalar] + kBlock * rank;
}

void BlockSystem::set_zero() {
  matrix_.coeffs().setZero();
  right_.setZero();
}

void BlockSystem::add_diagonal(std::size_t variable, const Matrix3& block) {
  const std::size_t column = place_[variable];
  for (int s = 0; s < kBlock; ++s) {
    double* values = column_values(column, s, above_[column]);
    for (int r = 0; r <= s; ++r) {
      values[r] += block(r, s);
    }
  }
}

void BlockSystem::add_pair(std::size_t pair, const Matrix3& block) {
  const Slot& slot = slots_[pair];
  for (int s = 0; s < kBlock; ++s) {
    double* values = column_values(slot.column, s, slot.rank);
    for (int r = 0; r < kBlock; ++r) {
      values[r] += slot.transposed ? block(s, r) : block(r, s);
    }
  }
}

void BlockSystem::add_right(std::size_t variable, const Eigen::Vector3d& value) {
  right_.segment<kBlock>(kBlock * narrow(place_[variable])) += value;
}

bool BlockSystem::factor(double damping) {
  std::vector<double> diagonal(static_cast<std::size_t>(matrix_.cols()));
  const auto last = [&](std::size_t column) -> double& {
    return matrix_.valuePtr()[matrix_.outerIndexPtr()[column + 1] - 1];
  };
  for (std::size_t c = 0; c < diagonal.size(); ++c) {
    diagonal[c] = last(c);
    last(c) += damping * diagonal[c] + kFloor;
  }
  cholesky_.factorize(matrix_);
  for (std::size_t c = 0; c < diagonal.size(); ++c) {
    last(c) = diagonal[c];
  }
  return cholesky_.info() == Eigen::Success && (cholesky_.vectorD().array() > 0.0).all();
}

void BlockSystem::solve() { solution_ = cholesky_.solve(right_); }

Eigen::Vector3d BlockSystem::solution(std::size_t variable) const {
  return solution_.segment<kBlock>(kBlock * narrow(place_[variable]));
}

std::vector<Matrix3> BlockSystem::inverse_blocks(std::size_t variable, const std::vector<std::size_t>& rows) const {
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(matrix_.rows(), kBlock);
  unit.middleRows<kBlock>(kBlock * narrow(place_[variable])).setIdentity();
  const Eigen::MatrixXd columns = cholesky_.solve(unit);
  std::vector<Matrix3> blocks;
  blocks.reserve(rows.size());
  for (const std::size_t row : rows) {
    blocks.emplace_back(columns.middleRows<kBlock>(kBlock * narrow(place_[row])));
  }
  return blocks;
}

}  // namespace seeker::slam
