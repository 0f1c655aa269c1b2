#include "server/slam/sp_covariance.hpp"

#include <algorithm>

#include "common/core/assert.hpp"

namespace seeker::slam {
namespace {

constexpr Index kFirstCapacity = 104;
/// Columns whose distance is a power of two fall on the same lines of the cache.
constexpr Index kBadStride = 64;

/// y, theta and ends of one column, all segments.
void centre_rows(const CentringStep* step, const CentringStep* end, double* column) {
  for (; step != end; ++step) {
    double* v = column + step->at;
    const double y = v[0];
    v[0] = step->y_y * y + step->y_theta * v[1];
    for (Index k = 2; k < step->rows; ++k) {
      v[k] += step->end_y * y;
    }
  }
}

Eigen::Matrix4d centring_matrix(const CentringStep& step) {
  Eigen::Matrix4d q = Eigen::Matrix4d::Identity();
  q(0, 0) = step.y_y;
  q(0, 1) = step.y_theta;
  q(2, 0) = step.end_y;
  q(3, 0) = step.end_y;
  return q;
}

}  // namespace

SpCovariance::SpCovariance(const Matrix3& robot) : values_(Eigen::MatrixXd::Zero(kFirstCapacity, kFirstCapacity)) {
  rows_ = kRobotRows;
  values_.topLeftCorner<3, 3>() = robot;
}

SpCovariance::SmallMatrix SpCovariance::block(Index at, Index rows) const {
  SmallMatrix out(rows, rows);
  for (Index j = 0; j < rows; ++j) {
    for (Index i = j; i < rows; ++i) {
      out(i, j) = out(j, i) = values_(at + i, at + j);
    }
  }
  return out;
}

void SpCovariance::gather(Index at, Index rows, Eigen::Ref<Eigen::MatrixXd> out) const {
  for (Index j = 0; j < at; ++j) {
    for (Index k = 0; k < rows; ++k) {
      out(j, k) = values_(at + k, j);
    }
  }
  for (Index k = 0; k < rows; ++k) {
    for (Index j = 0; j < k; ++j) {
      out(at + j, k) = values_(at + k, at + j);
    }
    out.col(k).segment(at + k, rows_ - at - k) = values_.col(at + k).segment(at + k, rows_ - at - k);
  }
}

Eigen::MatrixXd SpCovariance::full() const {
  return values_.topLeftCorner(rows_, rows_).selfadjointView<Eigen::Lower>();
}

void SpCovariance::transform(Index at, const SmallMatrix& a) {
  const Index rows = a.rows();
  for (Index j = 0; j < at; ++j) {
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1> old = values_.col(j).segment(at, rows);
    values_.col(j).segment(at, rows) = a * old;
  }
  const SmallMatrix own = block(at, rows);
  values_.block(at, at, rows, rows) = a * own * a.transpose();
  const Index below = at + rows;
  for (Index i = below; i < rows_; ++i) {
    const Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 4> old = values_.row(i).segment(at, rows);
    values_.row(i).segment(at, rows) = old * a.transpose();
  }
}

void SpCovariance::add(Index at, const SmallMatrix& noise) {
  values_.block(at, at, noise.rows(), noise.cols()) += noise;
}

Index SpCovariance::append(const Eigen::Ref<const Eigen::MatrixXd>& of_robot, const SmallMatrix& noise) {
  const Index count = of_robot.rows();
  const Index at = rows_;
  reserve(rows_ + count);
  const Matrix3 robot = block(0, kRobotRows);
  values_.block(at, 0, count, kRobotRows) = of_robot * robot;
  values_.block(at, kRobotRows, count, at - kRobotRows) =
      of_robot * values_.block(kRobotRows, 0, at - kRobotRows, kRobotRows).transpose();
  values_.block(at, at, count, count) = of_robot * robot * of_robot.transpose() + noise;
  rows_ += count;
  return at;
}

void SpCovariance::insert(Index at, const Eigen::Ref<const Eigen::VectorXd>& covariances, double variance) {
  reserve(rows_ + 1);
  for (Index j = rows_; j > at; --j) {
    std::copy_n(cell(j - 1, j - 1), rows_ - j + 1, cell(j, j));
  }
  for (Index j = 0; j < at; ++j) {
    std::copy_backward(cell(at, j), cell(rows_, j), cell(rows_ + 1, j));
    values_(at, j) = covariances(j);
  }
  values_(at, at) = variance;
  values_.col(at).segment(at + 1, rows_ - at) = covariances.segment(at, rows_ - at);
  ++rows_;
}

void SpCovariance::erase(Index at, Index count) {
  const Index below = at + count;
  for (Index j = 0; j < at; ++j) {
    std::copy(cell(below, j), cell(rows_, j), cell(at, j));
  }
  for (Index j = below; j < rows_; ++j) {
    std::copy_n(cell(j, j), rows_ - j, cell(j - count, j - count));
  }
  rows_ -= count;
}

void SpCovariance::decouple(Index at, const SmallMatrix& covariance) {
  const Index rows = covariance.rows();
  values_.block(at, 0, rows, at).setZero();
  values_.block(at, at, rows_ - at, rows).setZero();
  values_.block(at, at, rows, rows) = covariance;
}

void SpCovariance::downdate(const Eigen::Ref<const Eigen::MatrixXd>& w) {
  SEEKER_ASSERT(w.rows() == rows_);
  downdate_lower(values_.topLeftCorner(rows_, rows_), w);
}

void SpCovariance::centre(const std::vector<CentringStep>& steps) {
  const CentringStep* const end = steps.data() + steps.size();
  Index column = 0;
  for (const CentringStep& step : steps) {
    for (; column < step.at; ++column) {
      centre_rows(&step, end, cell(0, column));
    }
    const Index at = step.at;
    const Index below = at + step.rows;
    const Index left = rows_ - below;
    auto y = values_.col(at).segment(below, left);
    for (Index k = 2; k < step.rows; ++k) {
      values_.col(at + k).segment(below, left) += step.end_y * y;
    }
    y = step.y_y * y + step.y_theta * values_.col(at + 1).segment(below, left);
    const SmallMatrix own = block(at, step.rows);
    const SmallMatrix q = centring_matrix(step).topLeftCorner(step.rows, step.rows);
    values_.block(at, at, step.rows, step.rows) = q * own * q.transpose();
    for (; column < below; ++column) {
      centre_rows(&step + 1, end, cell(0, column));
    }
  }
}

void SpCovariance::reserve(Index rows) {
  if (rows <= values_.rows()) {
    return;
  }
  Index capacity = std::max(rows, values_.rows() + values_.rows() / 2);
  capacity = (capacity + 7) / 8 * 8;
  capacity += capacity % kBadStride == 0 ? 8 : 0;
  Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(capacity, capacity);
  larger.topLeftCorner(rows_, rows_) = values_.topLeftCorner(rows_, rows_);
  values_.swap(larger);
}

}  // namespace seeker::slam
