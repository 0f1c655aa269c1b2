/// The lower triangle behaves like the full matrix it stands for.
#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "common/core/rng.hpp"
#include "server/slam/sp_covariance.hpp"

namespace seeker::slam {
namespace {

Eigen::MatrixXd random_matrix(Index rows, Index columns, Rng& rng) {
  Eigen::MatrixXd m(rows, columns);
  for (Index j = 0; j < columns; ++j) {
    for (Index i = 0; i < rows; ++i) {
      m(i, j) = rng.uniform(-1.0, 1.0);
    }
  }
  return m;
}

SpCovariance::SmallMatrix unit(Index rows) { return SpCovariance::SmallMatrix::Identity(rows, rows); }

/// Robot and segments of 2, 3, 4, 2, ... rows, all correlated.
SpCovariance random_covariance(Rng& rng, Index segments) {
  const Eigen::MatrixXd a = random_matrix(3, 3, rng);
  SpCovariance p{Matrix3(a * a.transpose() + Matrix3::Identity())};
  for (Index k = 0; k < segments; ++k) {
    const Index rows = 2 + k % 3;
    p.append(random_matrix(rows, 3, rng), unit(rows));
  }
  return p;
}

double difference(const SpCovariance& p, const Eigen::MatrixXd& expected) {
  const Eigen::MatrixXd full = p.full();
  EXPECT_EQ(full.rows(), expected.rows());
  return (full - expected).cwiseAbs().maxCoeff();
}

TEST(SpCovariance, AppendsRowsThatFollowTheRobot) {
  Rng rng(1);
  SpCovariance p = random_covariance(rng, 5);
  const Eigen::MatrixXd before = p.full();
  const Eigen::MatrixXd m = random_matrix(3, 3, rng);
  p.append(m, 2.0 * unit(3));
  Eigen::MatrixXd expected(before.rows() + 3, before.rows() + 3);
  expected.topLeftCorner(before.rows(), before.rows()) = before;
  expected.bottomLeftCorner(3, before.rows()) = m * before.topRows(3);
  expected.topRightCorner(before.rows(), 3) = (m * before.topRows(3)).transpose();
  expected.bottomRightCorner(3, 3) = m * before.topLeftCorner(3, 3) * m.transpose() + 2.0 * unit(3);
  EXPECT_LT(difference(p, expected), 1e-12);
}

TEST(SpCovariance, TransformsABlock) {
  Rng rng(2);
  for (const Index at : {Index{0}, Index{3}, Index{8}}) {
    SpCovariance p = random_covariance(rng, 4);
    const Index n = p.rows();
    const Eigen::MatrixXd small = random_matrix(3, 3, rng);
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
    a.block(at, at, 3, 3) = small;
    const Eigen::MatrixXd expected = a * p.full() * a.transpose();
    p.transform(at, small);
    EXPECT_LT(difference(p, expected), 1e-12);
  }
}

TEST(SpCovariance, InsertsAndErasesRows) {
  Rng rng(3);
  for (const Index at : {Index{3}, Index{7}, Index{12}}) {
    SpCovariance p = random_covariance(rng, 3);
    const Eigen::MatrixXd before = p.full();
    const Index n = before.rows();
    ASSERT_EQ(n, 12);
    const Eigen::VectorXd row = random_matrix(n, 1, rng);
    p.insert(at, row, 5.0);
    for (Index k = 0; k < n; ++k) {
      EXPECT_EQ(p(at, k < at ? k : k + 1), row(k));
    }
    EXPECT_EQ(p(at, at), 5.0);
    p.erase(at, 1);
    EXPECT_EQ(difference(p, before), 0.0);
  }
}

TEST(SpCovariance, GathersFullColumns) {
  Rng rng(4);
  const SpCovariance p = random_covariance(rng, 6);
  const Eigen::MatrixXd full = p.full();
  for (Index at = 0; at + 4 <= p.rows(); ++at) {
    Eigen::MatrixXd out(p.rows(), 4);
    p.gather(at, 4, out);
    EXPECT_EQ((out - full.middleCols(at, 4)).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ((p.block(at, 4) - full.block(at, at, 4, 4)).cwiseAbs().maxCoeff(), 0.0);
  }
}

TEST(SpCovariance, DowndatesTheLowerTriangleForEverySize) {
  Rng rng(5);
  for (Index segments = 0; segments < 14; ++segments) {
    SpCovariance p = random_covariance(rng, segments);
    const Eigen::MatrixXd before = p.full();
    const Eigen::MatrixXd w = random_matrix(p.rows(), 1 + segments % 7, rng);
    p.downdate(w);
    EXPECT_LT(difference(p, before - w * w.transpose()), 1e-12) << "rows " << p.rows();
  }
}

TEST(SpCovariance, CentresSomeSegmentsInOnePass) {
  Rng rng(6);
  SpCovariance p = random_covariance(rng, 9);
  Eigen::MatrixXd q = Eigen::MatrixXd::Identity(p.rows(), p.rows());
  std::vector<CentringStep> steps;
  Index at = 3;
  for (Index k = 0; k < 9; ++k) {
    const Index rows = 2 + k % 3;
    if (k % 4 != 1) {
      const Vector4 move(0.1, rng.uniform(-0.5, 0.5), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
      const Matrix4 full = segment_centring(move);
      q.block(at, at, rows, rows) = full.topLeftCorner(rows, rows);
      steps.push_back({at, rows, full(0, 0), full(0, 1), full(2, 0)});
    }
    at += rows;
  }
  const Eigen::MatrixXd expected = q * p.full() * q.transpose();
  p.centre(steps);
  EXPECT_LT(difference(p, expected), 1e-12);
}

TEST(SpCovariance, DecouplesABlock) {
  Rng rng(7);
  SpCovariance p = random_covariance(rng, 3);
  Eigen::MatrixXd expected = p.full();
  expected.topRows(3).setZero();
  expected.leftCols(3).setZero();
  expected.topLeftCorner(3, 3) = 4.0 * Matrix3::Identity();
  p.decouple(0, 4.0 * Matrix3::Identity());
  EXPECT_EQ(difference(p, expected), 0.0);
}

TEST(SpCovariance, GrowsWithoutLosingAnything) {
  Rng rng(8);
  SpCovariance p = random_covariance(rng, 20);
  for (int k = 0; k < 100; ++k) {
    const Eigen::MatrixXd before = p.full();
    p.append(random_matrix(4, 3, rng), unit(4));
    ASSERT_EQ((p.full().topLeftCorner(before.rows(), before.rows()) - before).cwiseAbs().maxCoeff(), 0.0);
  }
  EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(p.full()).info(), Eigen::Success);
}

}  // namespace
}  // namespace seeker::slam
