#include "server/slam/pose_graph.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

const Matrix3 kOdometry = Eigen::Vector3d(1.0 / 0.01, 1.0 / 0.01, 1.0 / 0.001).asDiagonal();
const Matrix3 kLoop = Eigen::Vector3d(1.0 / 0.0009, 1.0 / 0.0009, 1.0 / 0.0001).asDiagonal();

/// Laps on a circle: odometry that drifts, and loops between the laps, true ones and false ones.
struct Laps {
  std::vector<Pose2> truth;
  PoseGraph graph;
  std::vector<std::size_t> loops;
  std::vector<std::size_t> lies;
};

void add(PoseGraph& graph, const PoseEdge& edge) { ASSERT_TRUE(graph.add_edge(edge)); }

Laps laps(int nodes, int per_lap, Rng& rng, int lies = 0, EdgeKernel kernel = EdgeKernel::kSwitchable) {
  Laps out;
  const Pose2 step{0.5, 0.0, kTwoPi / per_lap};
  Pose2 drifting;
  for (int k = 0; k < nodes; ++k) {
    out.truth.push_back(k == 0 ? Pose2{} : out.truth.back() * step);
    const Pose2 odometry = step * Pose2{rng.normal(0.02), rng.normal(0.02), 0.004 + rng.normal(0.004)};
    drifting = k == 0 ? Pose2{} : drifting * odometry;
    out.graph.add_node(drifting);
    if (k > 0) {
      const auto j = static_cast<std::size_t>(k);
      add(out.graph, {j - 1, j, odometry, kOdometry, EdgeKernel::kNone, 0.0});
    }
  }
  for (int k = per_lap; k < nodes; k += 5) {
    const auto i = static_cast<std::size_t>(k - per_lap);
    const auto j = static_cast<std::size_t>(k);
    const Pose2 seen =
        inverse(out.truth[i]) * out.truth[j] * Pose2{rng.normal(0.02), rng.normal(0.02), rng.normal(0.005)};
    out.loops.push_back(*out.graph.add_edge({i, j, seen, kLoop, kernel, 3.0}));
  }
  for (int k = 0; k < lies; ++k) {
    const auto i = static_cast<std::size_t>(rng.below(static_cast<std::uint64_t>(nodes) / 2));
    const std::size_t j = i + static_cast<std::size_t>(nodes) / 3;
    const Pose2 seen{rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), rng.uniform(-kPi, kPi)};
    out.lies.push_back(*out.graph.add_edge({i, j, seen, kLoop, EdgeKernel::kSwitchable, 3.0}));
  }
  return out;
}

double worst_m(const PoseGraph& graph, const std::vector<Pose2>& truth) {
  double worst = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    worst = std::max(worst, distance_m(graph.pose(k), truth[k]));
  }
  return worst;
}

TEST(PoseGraph, AKnownSquareIsClosedExactly) {
  PoseGraph graph;
  const Pose2 side{2.0, 0.0, kPi / 2.0};
  Pose2 pose;
  const std::vector<Pose2> distorted{{}, {2.2, 0.1, 1.4}, {2.3, 2.2, 2.9}, {-0.3, 2.4, -1.4}};
  for (const Pose2& guess : distorted) {
    graph.add_node(guess);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    add(graph, {k, (k + 1) % 4, side, kOdometry, EdgeKernel::kNone, 0.0});
  }
  const auto report = graph.optimise();
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->converged);
  EXPECT_GT(report->initial_chi2, 1.0);
  EXPECT_LT(report->final_chi2, 1e-12);
  for (std::size_t k = 0; k < 4; ++k, pose = pose * side) {
    EXPECT_THAT(graph.pose(k), Pose2Near(pose, 1e-6, 1e-6));
  }
}

TEST(PoseGraph, TheStepIsTheOneOfNumericalDerivatives) {
  // One Gauss-Newton step with the edge's Jacobians against one with central differences, no small angle anywhere.
  const std::vector<Pose2> at{{0.3, -0.2, 2.9}, {1.5, 2.0, -2.6}, {-1.0, 0.7, 1.2}};
  const std::vector<PoseEdge> edges{{0, 1, {1.0, -2.0, 1.0}, kOdometry, EdgeKernel::kNone, 0.0},
                                    {1, 2, {-1.7, 2.0, -2.4}, kLoop, EdgeKernel::kNone, 0.0},
                                    {2, 0, {-0.7, -1.6, 1.8}, kOdometry, EdgeKernel::kNone, 0.0}};
  PoseGraph graph;
  for (const Pose2& pose : at) {
    graph.add_node(pose);
  }
  for (const PoseEdge& edge : edges) {
    add(graph, edge);
  }
  using Six = Eigen::Matrix<double, 6, 1>;
  const auto residuals = [&](const Six& d) {
    const std::vector<Pose2> p{at[0],
                               {at[1].x_m + d[0], at[1].y_m + d[1], at[1].theta_rad + d[2]},
                               {at[2].x_m + d[3], at[2].y_m + d[4], at[2].theta_rad + d[5]}};
    Eigen::Matrix<double, 9, 1> all;
    for (int k = 0; k < 3; ++k) {
      const PoseEdge& e = edges[static_cast<std::size_t>(k)];
      const Pose2 seen = inverse(p[e.i]) * p[e.j];
      all.segment<3>(3 * k) << seen.x_m - e.i_T_j.x_m, seen.y_m - e.i_T_j.y_m,
          wrap_angle(seen.theta_rad - e.i_T_j.theta_rad);
    }
    return all;
  };
  Eigen::Matrix<double, 9, 6> jacobian;
  for (int c = 0; c < 6; ++c) {
    const Six h = 1e-6 * Six::Unit(c);
    jacobian.col(c) = (residuals(h) - residuals(-h)) / 2e-6;
  }
  Eigen::Matrix<double, 9, 9> information = Eigen::Matrix<double, 9, 9>::Zero();
  information.block<3, 3>(0, 0) = kOdometry;
  information.block<3, 3>(3, 3) = kLoop;
  information.block<3, 3>(6, 6) = kOdometry;
  const Eigen::Matrix<double, 6, 6> hessian = jacobian.transpose() * information * jacobian;
  const Six step = -hessian.ldlt().solve(jacobian.transpose() * information * residuals(Six::Zero()));
  ASSERT_TRUE(graph.optimise(1));
  for (std::size_t k = 1; k < 3; ++k) {
    const Eigen::Vector3d d = step.segment<3>(3 * static_cast<int>(k) - 3);
    const Pose2 expected{at[k].x_m + d[0], at[k].y_m + d[1], at[k].theta_rad + d[2]};
    EXPECT_THAT(graph.pose(k), Pose2Near(expected, 1e-5, 1e-5));
  }
}

TEST(PoseGraph, LoopsTakeTheDriftAway) {
  Rng rng(1);
  Laps made = laps(300, 60, rng);
  EXPECT_GT(worst_m(made.graph, made.truth), 1.5);
  const auto report = made.graph.optimise();
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->converged);
  EXPECT_EQ(report->switched_off, 0U);
  EXPECT_LT(report->final_chi2, report->initial_chi2);
  EXPECT_LT(worst_m(made.graph, made.truth), 0.5);
}

TEST(PoseGraph, FalseLoopsAreSwitchedOffAndTrueOnesAreNot) {
  Rng rng(2);
  Laps honest = laps(300, 60, rng);
  ASSERT_TRUE(honest.graph.optimise(60));
  Rng again(2);
  Laps mixed = laps(300, 60, again, 6);
  const auto report = mixed.graph.optimise(60);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->switched_off, mixed.lies.size());
  for (const std::size_t lie : mixed.lies) {
    EXPECT_LT(mixed.graph.edge_weight(lie), 0.05);
  }
  for (const std::size_t loop : mixed.loops) {
    EXPECT_GT(mixed.graph.edge_weight(loop), 0.9);
  }
  EXPECT_LT(worst_m(mixed.graph, mixed.truth), worst_m(honest.graph, honest.truth) + 0.1);
}

TEST(PoseGraph, DisablingAnEdgeRestoresWhatWasThereBefore) {
  Rng rng(3);
  Laps made = laps(200, 50, rng);
  ASSERT_TRUE(made.graph.optimise(50));
  const PoseGraph before = made.graph;
  const auto wrong = made.graph.add_edge({10, 150, {3.0, 3.0, 1.0}, kLoop, EdgeKernel::kNone, 0.0});
  ASSERT_TRUE(wrong);
  ASSERT_TRUE(made.graph.optimise(50));
  EXPECT_GT(distance_m(made.graph.pose(100), before.pose(100)), 0.3);
  made.graph.set_enabled(*wrong, false);
  EXPECT_EQ(made.graph.edge_weight(*wrong), 0.0);
  ASSERT_TRUE(made.graph.optimise(50));
  for (std::size_t k = 0; k < 200; ++k) {
    EXPECT_THAT(made.graph.pose(k), Pose2Near(before.pose(k), 1e-3, 1e-3));
  }
  made.graph.set_enabled(*wrong, true);
  made.graph.remove_edge(*wrong);
  made.graph.set_enabled(*wrong, true);
  EXPECT_FALSE(made.graph.enabled(*wrong));
}

TEST(PoseGraph, RobustKernelsLimitTheHarmOfOneLie) {
  for (const EdgeKernel kernel : {EdgeKernel::kHuber, EdgeKernel::kCauchy, EdgeKernel::kSwitchable}) {
    Rng rng(4);
    Laps made = laps(120, 40, rng, 0, EdgeKernel::kNone);
    ASSERT_TRUE(made.graph.optimise(60));
    PoseGraph trusting = made.graph;
    add(trusting, {5, 100, {4.0, -1.0, 2.0}, kLoop, EdgeKernel::kNone, 0.0});
    add(made.graph, {5, 100, {4.0, -1.0, 2.0}, kLoop, kernel, 3.0});
    ASSERT_TRUE(trusting.optimise(60));
    ASSERT_TRUE(made.graph.optimise(60));
    // Huber's pull does not grow with the error; the others' vanishes.
    const double share = kernel == EdgeKernel::kHuber ? 0.9 : 0.1;
    EXPECT_LT(worst_m(made.graph, made.truth), share * worst_m(trusting, made.truth)) << static_cast<int>(kernel);
  }
}

TEST(PoseGraph, AChainsCovarianceIsThatOfItsCompositions) {
  PoseGraph graph;
  Pose2 pose{1.0, 2.0, 0.7};
  const Pose2 step{1.0, 0.2, 0.3};
  Pose2 travelled;
  Matrix3 expected = Matrix3::Zero();
  for (std::size_t k = 0; k < 12; ++k, pose = pose * step) {
    graph.add_node(pose);
    if (k > 0) {
      add(graph, {k - 1, k, step, kOdometry, EdgeKernel::kNone, 0.0});
    }
    if (k > 4) {
      const Matrix3 a = compose_jacobian_a(travelled, step);
      const Matrix3 b = compose_jacobian_b(travelled, step);
      expected = a * expected * a.transpose() + b * kOdometry.inverse() * b.transpose();
      travelled = travelled * step;
    }
  }
  const auto covariance = graph.relative_covariance(4, 11);
  ASSERT_TRUE(covariance);
  EXPECT_LT((*covariance - expected).norm(), 1e-9 * expected.norm());
  graph.fix(4);
  EXPECT_LT((*graph.relative_covariance(4, 11) - expected).norm(), 1e-9 * expected.norm());
  graph.fix(11);
  EXPECT_LT((*graph.relative_covariance(4, 11) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_EQ(graph.relative_covariance(3, 3)->norm(), 0.0);
  EXPECT_FALSE(graph.relative_covariance(3, 12));
}

TEST(PoseGraph, ALoopShrinksTheCovariance) {
  Rng rng(5);
  Laps made = laps(60, 50, rng);
  ASSERT_TRUE(made.graph.optimise(50));
  const double closed = made.graph.relative_covariance(0, 50)->trace();
  made.graph.set_enabled(made.loops.front(), false);
  made.graph.set_enabled(made.loops.back(), false);
  EXPECT_GT(made.graph.relative_covariance(0, 50)->trace(), 3.0 * closed);
}

TEST(PoseGraph, NodesWithoutAPathToTheFixedOneAreAnError) {
  PoseGraph graph;
  EXPECT_EQ(graph.optimise().error().code, Errc::kNotReady);
  graph.add_node({});
  ASSERT_TRUE(graph.optimise());
  graph.add_node({1.0, 0.0, 0.0});
  const auto lonely = graph.optimise();
  ASSERT_FALSE(lonely);
  EXPECT_EQ(lonely.error().code, Errc::kNotReady);
  EXPECT_NE(lonely.error().message.find("node 1"), std::string::npos);
  const auto edge = graph.add_edge({0, 1, {1.1, 0.0, 0.0}, kOdometry, EdgeKernel::kNone, 0.0});
  ASSERT_TRUE(graph.optimise());
  EXPECT_NEAR(graph.pose(1).x_m, 1.1, 1e-9);
  graph.set_enabled(*edge, false);
  EXPECT_FALSE(graph.optimise());
  EXPECT_NEAR(graph.pose(1).x_m, 1.1, 1e-9);
}

TEST(PoseGraph, WhatIsHeldStaysWhereItIsAndWhatIsJoinedToItMoves) {
  PoseGraph graph;
  const std::vector<Pose2> held{{}, {3.0, 0.1, 0.2}, {6.0, -0.3, 0.1}};
  for (const Pose2& pose : held) {
    graph.hold(graph.add_node(pose));
  }
  const std::size_t free = graph.add_node({2.0, 2.0, 0.5});
  add(graph, {0, 1, {2.5, 0.0, 0.0}, kOdometry, EdgeKernel::kNone, 0.0});  // contradicts where they are held
  ASSERT_FALSE(graph.optimise()) << "the last node has no path to any that is held";
  add(graph, {2, free, {1.0, 2.0, 0.3}, kLoop, EdgeKernel::kNone, 0.0});
  const auto report = graph.optimise();
  ASSERT_TRUE(report);
  EXPECT_LT(report->initial_chi2 + report->final_chi2, 1e6);
  for (std::size_t k = 0; k < held.size(); ++k) {
    EXPECT_EQ(graph.pose(k), held[k]);
  }
  EXPECT_THAT(graph.pose(free), Pose2Near(held[2] * Pose2{1.0, 2.0, 0.3}, 1e-6, 1e-6));
  EXPECT_EQ(graph.relative_covariance(1, 2)->norm(), 0.0);
  EXPECT_LT((*graph.relative_covariance(2, free) - kLoop.inverse()).norm(), 1e-9);
  for (const Pose2& pose : held) {
    PoseGraph alone;
    alone.hold(alone.add_node(pose));
    EXPECT_TRUE(alone.optimise()) << "nothing that could move";
  }
}

TEST(PoseGraph, DroppedNodesTakeTheirEdgesAlongAndLeaveNoGaps) {
  Rng rng(6);
  Laps made = laps(30, 20, rng);
  PoseGraph graph;
  for (std::size_t k = 0; k < made.graph.node_count(); ++k) {
    graph.add_node(made.graph.pose(k));
  }
  for (std::size_t k = 0; k + 1 < graph.node_count(); ++k) {
    add(graph, {k, k + 1, {0.5, 0.0, 0.1}, kOdometry, EdgeKernel::kNone, 0.0});
  }
  add(graph, {0, 12, inverse(graph.pose(0)) * graph.pose(12), kLoop, EdgeKernel::kSwitchable, 3.0});
  add(graph, {0, 7, {}, kLoop, EdgeKernel::kSwitchable, 3.0});
  const auto removed = graph.add_edge({2, 15, {}, kLoop, EdgeKernel::kSwitchable, 3.0});
  graph.remove_edge(*removed);
  const std::vector<Pose2> after{graph.pose(10), graph.pose(12), graph.pose(29)};
  graph.drop_nodes(5, 10);
  ASSERT_EQ(graph.node_count(), 25U);
  EXPECT_EQ(graph.pose(5), after[0]);
  EXPECT_EQ(graph.pose(7), after[1]);
  EXPECT_EQ(graph.pose(24), after[2]);
  EXPECT_EQ(graph.edge_count(), 29U - 6U + 1U) << "of the chain six lead to a node that is gone";
  EXPECT_EQ(graph.edge(graph.edge_count() - 1).i, 0U);
  EXPECT_EQ(graph.edge(graph.edge_count() - 1).j, 7U);
  EXPECT_TRUE(graph.optimise()) << "the loop joins both halves";
}

TEST(PoseGraph, RefusesEdgesThatAreNone) {
  PoseGraph graph;
  graph.add_node({});
  graph.add_node({1.0, 0.0, 0.0});
  const double nan = std::nan("");
  Matrix3 lopsided = kLoop;
  lopsided(0, 1) = 50.0;
  EXPECT_FALSE(graph.add_edge({0, 2, {}, kLoop, EdgeKernel::kNone, 0.0}));
  EXPECT_FALSE(graph.add_edge({1, 1, {}, kLoop, EdgeKernel::kNone, 0.0}));
  EXPECT_FALSE(graph.add_edge({0, 1, {nan, 0.0, 0.0}, kLoop, EdgeKernel::kNone, 0.0}));
  EXPECT_FALSE(graph.add_edge({0, 1, {}, lopsided, EdgeKernel::kNone, 0.0}));
  EXPECT_FALSE(graph.add_edge({0, 1, {}, Matrix3(-kLoop), EdgeKernel::kNone, 0.0}));
  EXPECT_FALSE(graph.add_edge({0, 1, {}, kLoop, EdgeKernel::kHuber, 0.0}));
  EXPECT_EQ(graph.edge_count(), 0U);
}

TEST(PoseGraph, AnEdgeBlindAlongACorridorLeavesTheOthersToDecide) {
  PoseGraph graph;
  graph.add_node({});
  graph.add_node({5.3, 0.4, 0.0});
  add(graph, {0, 1, {5.0, 0.5, 0.0}, kOdometry, EdgeKernel::kNone, 0.0});
  Matrix3 across = kLoop;
  across(0, 0) = 0.0;
  add(graph, {0, 1, {9.0, 0.0, 0.0}, across, EdgeKernel::kNone, 0.0});
  ASSERT_TRUE(graph.optimise());
  EXPECT_NEAR(graph.pose(1).x_m, 5.0, 1e-6);
  EXPECT_LT(graph.pose(1).y_m, 0.06);
}

}  // namespace
}  // namespace seeker::slam
