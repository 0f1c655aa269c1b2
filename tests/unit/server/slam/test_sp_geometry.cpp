/// Every derivative of spec S1 against central differences (S8).
#include <functional>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/slam/sp_geometry.hpp"
#include "server/slam/sp_map.hpp"

namespace seeker::slam {
namespace {

constexpr double kStep = 1e-6;
constexpr double kTolerance = 4e-9;

using Function = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Derivative of f at zero.
Eigen::MatrixXd slope(const Function& f, Eigen::Index inputs) {
  Eigen::MatrixXd out;
  for (Eigen::Index k = 0; k < inputs; ++k) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(inputs);
    d(k) = kStep;
    const Eigen::VectorXd column = (f(d) - f(-d)) / (2.0 * kStep);
    out.conservativeResize(column.size(), inputs);
    out.col(k) = column;
  }
  return out;
}

Eigen::Vector3d vector_of(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.theta_rad}; }
Pose2 pose_of(const Eigen::VectorXd& d) { return {d(0), d(1), d(2)}; }
Pose2 line_shift(const Eigen::VectorXd& p) { return {0.0, p(0), p(1)}; }

const Pose2 kRobot{1.3, -0.7, 0.8};
const Pose2 kObservation{2.1, 1.4, -0.6};
constexpr double kSegmentLength_m = 3.2;
constexpr double kObservedLength_m = 2.5;
/// Near to the observation but turned and shifted.
const Pose2 kSegment = kRobot * kObservation * Pose2{0.3, 0.12, 0.21};

/// f of S1.5 with all endpoint rows, from perturbed robot, segment and observation.
Eigen::VectorXd residual(const Eigen::VectorXd& robot, const Eigen::VectorXd& segment, const Eigen::VectorXd& seen) {
  const Pose2 x =
      inverse(kSegment * line_shift(segment)) * (kRobot * pose_of(robot)) * (kObservation * line_shift(seen));
  Eigen::VectorXd f(4);
  f(0) = x.y_m;
  f(1) = x.theta_rad;
  for (Eigen::Index e = 0; e < 2; ++e) {
    const double beta = end_sign(static_cast<std::size_t>(e));
    const double q = beta * kObservedLength_m / 2.0 + seen(2 + e);
    f(2 + e) = x.x_m + q * std::cos(x.theta_rad) - beta * kSegmentLength_m / 2.0 - segment(2 + e);
  }
  return f;
}

PairRows rows_at_zero() {
  return pair_rows(pair_geometry(kSegment, kRobot, kObservation), kSegmentLength_m, kObservedLength_m);
}

TEST(SpGeometry, PairResidualIsTheOneOfEquation12) {
  EXPECT_LT((rows_at_zero().f - residual(Eigen::VectorXd::Zero(3), Vector4::Zero(), Vector4::Zero())).norm(), 1e-12);
}

TEST(SpGeometry, PairRowsAgreeWithDifferences) {
  const PairRows rows = rows_at_zero();
  const Vector4 zero = Vector4::Zero();
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(3);
  const Eigen::MatrixXd robot = slope([&](const auto& d) { return residual(d, zero, zero); }, 3);
  const Eigen::MatrixXd segment = slope([&](const auto& d) { return residual(still, d, zero); }, 4);
  const Eigen::MatrixXd seen = slope([&](const auto& d) { return residual(still, zero, d); }, 4);
  EXPECT_LT((rows.robot - robot).cwiseAbs().maxCoeff(), kTolerance) << rows.robot << "\n" << robot;
  EXPECT_LT((rows.segment - segment).cwiseAbs().maxCoeff(), kTolerance) << rows.segment << "\n" << segment;
  EXPECT_LT((rows.observation - seen).cwiseAbs().maxCoeff(), kTolerance) << rows.observation << "\n" << seen;
}

TEST(SpGeometry, RobotColumnsOfTheFrameAgreeWithDifferences) {
  const PairGeometry pair = pair_geometry(kSegment, kRobot, kObservation);
  const Eigen::MatrixXd j =
      slope([](const auto& d) { return vector_of(inverse(kSegment) * (kRobot * pose_of(d)) * kObservation); }, 3);
  EXPECT_LT((pair.robot_x - j.row(0)).cwiseAbs().maxCoeff(), kTolerance);
  EXPECT_LT((pair.robot_y - j.row(1)).cwiseAbs().maxCoeff(), kTolerance);
  EXPECT_LT((Eigen::RowVector3d(0.0, 0.0, 1.0) - j.row(2)).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(SpGeometry, TransportCarriesAPerturbationThroughAFrame) {
  const Pose2 a{0.4, -1.1, 0.7};
  const Eigen::MatrixXd j = slope([&](const auto& d) { return vector_of(a * pose_of(d) * inverse(a)); }, 3);
  EXPECT_LT((transport(a) - j).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(SpGeometry, PredictionTransportsTheRobotsErrorAsEquation10b) {
  const Pose2 increment{0.3, 0.1, 0.4};
  const auto after = [&](const auto& d) {
    return vector_of(inverse(kRobot * increment) * (kRobot * pose_of(d) * increment));
  };
  EXPECT_LT((transport(inverse(increment)) - slope(after, 3)).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(SpGeometry, NewSegmentRowsAgreeWithDifferences) {
  // p_F of the true line in the frame of the new segment, as the robot's error moves it.
  const auto moved = [](const auto& d) {
    const Pose2 x = inverse(kRobot * kObservation) * (kRobot * pose_of(d) * kObservation);
    Eigen::VectorXd p(4);
    p << x.y_m, x.theta_rad, x.x_m, x.x_m;
    return p;
  };
  EXPECT_LT((new_segment_rows(kObservation) - slope(moved, 3)).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(SpGeometry, EndRowsAgreeWithDifferences) {
  const PairGeometry pair = pair_geometry(kSegment, kRobot, kObservation);
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const EndRow row = end_row(pair, side, kObservedLength_m);
    const auto end_x = [&](const Eigen::VectorXd& robot, const Eigen::VectorXd& segment, double own) {
      Vector4 seen = Vector4::Zero();
      seen(static_cast<Eigen::Index>(2 + side)) = own;
      Vector4 p = Vector4::Zero();
      p.head<2>() = segment;
      return Eigen::VectorXd(residual(robot, p, seen).segment<1>(static_cast<Eigen::Index>(2 + side)));
    };
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(3);
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(2);
    EXPECT_LT((row.robot - slope([&](const auto& d) { return end_x(d, at_rest, 0.0); }, 3)).norm(), kTolerance);
    EXPECT_LT((row.segment - slope([&](const auto& d) { return end_x(still, d, 0.0); }, 2)).norm(), kTolerance);
    EXPECT_NEAR(row.own, slope([&](const auto& d) { return end_x(still, at_rest, d(0)); }, 1)(0), kTolerance);
  }
}

TEST(SpGeometry, MergeRowsAgreeWithDifferences) {
  const Pose2 other = kSegment * Pose2{1.5, 0.05, 0.08};
  const MergeRows rows = merge_rows(kSegment, other);
  const auto f = [&](const Eigen::VectorXd& i, const Eigen::VectorXd& j) {
    const Pose2 x = inverse(kSegment * line_shift(i)) * (other * line_shift(j));
    return Eigen::VectorXd(Eigen::Vector2d(x.y_m, x.theta_rad));
  };
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(2);
  EXPECT_LT((rows.f - f(zero, zero)).norm(), 1e-12);
  EXPECT_LT((rows.first - slope([&](const auto& d) { return f(d, zero); }, 2)).norm(), kTolerance);
  EXPECT_LT((rows.second - slope([&](const auto& d) { return f(zero, d); }, 2)).norm(), kTolerance);
}

/// Place of an end of the perturbed segment, in the old frame.
Point2 end_of(const SegmentShape& shape, const Pose2& frame, std::size_t side) {
  return inverse(frame) * (shape.map_T_segment * Point2(0.5 * end_sign(side) * shape.length_m, 0.0));
}

TEST(SpGeometry, PerturbedEndsLieWhereEquation8PutsThem) {
  const Vector4 p(0.07, -0.2, 0.11, -0.05);
  const SegmentShape moved = perturbed({kSegment, kSegmentLength_m}, p);
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    // Local x = beta L/2 + p_e on the line through (0, p_y) at angle p_theta.
    const double x = 0.5 * end_sign(side) * kSegmentLength_m + p(static_cast<Eigen::Index>(2 + side));
    const Point2 expected(x * std::cos(p(1)), p(0) + x * std::sin(p(1)));
    EXPECT_LT((end_of(moved, kSegment, side) - expected).norm(), 1e-12);
  }
}

/// The perturbation that turns `shape` into the line and ends of `target`.
Vector4 perturbation_of(const SegmentShape& shape, const SegmentShape& target) {
  const Pose2 d = inverse(shape.map_T_segment) * target.map_T_segment;
  Vector4 p;
  p(0) = d.y_m - d.x_m * std::tan(d.theta_rad);
  p(1) = d.theta_rad;
  for (std::size_t side = 0; side < 2; ++side) {
    const Point2 end = end_of(target, shape.map_T_segment, side);
    const Point2 along(std::cos(p(1)), std::sin(p(1)));
    p(static_cast<Eigen::Index>(2 + side)) = along.dot(end - Point2(0.0, p(0))) - 0.5 * end_sign(side) * shape.length_m;
  }
  return p;
}

TEST(SpGeometry, SegmentCentringAgreesWithDifferences) {
  const Vector4 p(0.07, -0.2, 0.11, 0.05);
  const SegmentShape old{kSegment, kSegmentLength_m};
  const SegmentShape centred = perturbed(old, p);
  const auto seen_from_new = [&](const auto& d) {
    return Eigen::VectorXd(perturbation_of(centred, perturbed(old, p + Vector4(d))));
  };
  EXPECT_LT((segment_centring(p) - slope(seen_from_new, 4)).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(SpGeometry, RobotCentringAgreesWithDifferences) {
  const Eigen::Vector3d p(0.1, -0.05, 0.3);
  const auto seen_from_new = [&](const auto& d) {
    return vector_of(inverse(kRobot * pose_of(p)) * (kRobot * pose_of(p + Eigen::Vector3d(d))));
  };
  EXPECT_LT((robot_centring(p(2)) - slope(seen_from_new, 3)).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(SpGeometry, MovingTheOriginAlongTheLineIsTOfS) {
  const double s = 0.8;
  const SegmentShape old{kSegment, kSegmentLength_m};
  const SegmentShape shifted{kSegment * Pose2{s, 0.0, 0.0}, kSegmentLength_m};
  const auto after = [&](const Eigen::VectorXd& d) {
    Vector4 p = Vector4::Zero();
    p.head<2>() = d;
    return Eigen::VectorXd(perturbation_of(shifted, perturbed(old, p)).head<2>());
  };
  Matrix2 t;
  t << 1.0, s, 0.0, 1.0;
  EXPECT_LT((t - slope(after, 2)).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(SpGeometry, CovarianceRotatesBetweenFrames) {
  const Matrix3 base = Eigen::Vector3d(0.04, 0.01, 0.0025).asDiagonal().toDenseMatrix();
  const Pose2 quarter{3.0, 2.0, kPi / 2.0};
  const Matrix3 map = to_map_frame(base, quarter);
  EXPECT_NEAR(map(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(map(1, 1), 0.04, 1e-12);
  EXPECT_LT((to_base_frame(map, quarter) - base).norm(), 1e-12);
}

}  // namespace
}  // namespace seeker::slam
