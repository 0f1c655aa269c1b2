/// For any input the filter's covariance stays valid.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/Eigenvalues>

#include "sp_world.hpp"

namespace seeker::slam {
namespace {

using lines::SegmentObservation;

/// Smallest eigenvalue of the correlation matrix, which has no units.
double smallest_correlation_eigenvalue(const SpMap& map) {
  const Eigen::MatrixXd p = map.covariance();
  if (!p.allFinite() || p.diagonal().minCoeff() <= 0.0) {
    return -1.0;
  }
  const Eigen::VectorXd scale = p.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation = scale.asDiagonal() * p * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(correlation, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

/// 10^-from .. 10^to, evenly in the exponent.
double magnitude(double from, double to, Rng& rng) { return std::pow(10.0, rng.uniform(from, to)); }

Matrix3 any_covariance(Rng& rng) {
  Matrix3 a;
  for (Eigen::Index k = 0; k < 9; ++k) {
    a(k) = rng.uniform(-1.0, 1.0);
  }
  return magnitude(-12.0, 1.0, rng) * a * a.transpose();
}

SegmentObservation any_observation(Rng& rng) {
  SegmentObservation seen;
  seen.base_T_segment = {rng.normal(3.0), rng.normal(3.0), rng.uniform(-4.0, 4.0)};
  seen.length_m = rng.below(20) == 0 ? 0.0 : magnitude(-3.0, 1.0, rng);
  seen.real = {rng.below(2) == 0, rng.below(2) == 0};
  const double y = magnitude(-6.0, 0.0, rng);
  const double theta = magnitude(-6.0, 0.0, rng);
  const double correlation = rng.uniform(-1.0, 1.0);
  seen.covariance << y * y, correlation * y * theta, correlation * y * theta, theta * theta;
  seen.end_sigma_m = {magnitude(-6.0, 0.0, rng), magnitude(-6.0, 0.0, rng)};
  seen.points = static_cast<int>(rng.below(40));
  return seen;
}

constexpr std::size_t kMostSegments = 12;

class Torture {
 public:
  Torture(std::uint64_t seed, const SpMapParams& params) : rng_(seed), map_({}, Matrix3::Zero(), params) {}

  void step() {
    const std::uint64_t kind = rng_.below(100);
    if (kind < 30) {
      map_.predict({rng_.normal(0.2), rng_.normal(0.1), rng_.normal(0.2)}, 1e-3 * any_covariance(rng_));
    } else if (kind < 32) {
      map_.predict({rng_.normal(50.0), rng_.normal(50.0), rng_.uniform(-3.0, 3.0)}, any_covariance(rng_));
    } else if (kind < 34) {
      map_.set_robot({rng_.normal(5.0), rng_.normal(5.0), rng_.uniform(-3.0, 3.0)}, any_covariance(rng_));
    } else if (kind < 38) {
      const Pose2 near = map_.robot() * Pose2{rng_.normal(0.1), rng_.normal(0.1), rng_.normal(0.1)};
      map_.observe_pose(near, any_covariance(rng_), kind == 36 ? std::optional<Point2>({0.0, 1.0}) : std::nullopt);
    } else if (kind < 70) {
      feed(rng_.below(3) == 0 ? last_ : again());
    } else {
      std::vector<SegmentObservation> seen;
      for (std::uint64_t k = rng_.below(8); k > 0; --k) {
        seen.push_back(any_observation(rng_));
      }
      feed(seen);
    }
    while (map_.segments().size() > kMostSegments) {
      map_.forget(map_.segments()[rng_.below(map_.segments().size())].id);
    }
  }
  [[nodiscard]] const SpMap& map() const { return map_; }

 private:
  void feed(const std::vector<SegmentObservation>& seen) {
    map_.update(seen, map_.associate(seen));
    last_ = seen;
  }
  /// Parts of what is in the map, as seen from where the robot believes to be, with small errors.
  std::vector<SegmentObservation> again() {
    std::vector<SegmentObservation> seen;
    for (const SpSegment& segment : map_.segments()) {
      if (rng_.below(4) != 0) {
        continue;
      }
      SegmentObservation one = any_observation(rng_);
      one.base_T_segment =
          inverse(map_.robot()) * segment.map_T_segment * Pose2{rng_.normal(0.1), rng_.normal(0.01), rng_.normal(0.01)};
      one.length_m = segment.length_m * rng_.uniform(0.2, 1.3);
      seen.push_back(one);
    }
    return seen;
  }

  Rng rng_;
  SpMap map_;
  std::vector<SegmentObservation> last_;
};

TEST(SpHostile, CovarianceStaysPositiveDefiniteOver100000Steps) {
  for (const bool printed : {false, true}) {
    SpMapParams params;
    params.association.method = printed ? SpAssociationMethod::kNearestNeighbour : SpAssociationMethod::kJoint;
    params.update = printed ? SpUpdateMethod::kSequential : SpUpdateMethod::kJoint;
    const int steps = printed ? 5'000 : 100'000;
    Torture torture(7, params);
    for (int k = 1; k <= steps; ++k) {
      torture.step();
      if (k % 500 == 0) {
        ASSERT_GT(smallest_correlation_eigenvalue(torture.map()), 0.0) << "step " << k;
        ASSERT_TRUE(is_finite(torture.map().robot()));
      }
    }
    EXPECT_GT(torture.map().segments().size(), 3U);
    for (const SpSegment& segment : torture.map().segments()) {
      EXPECT_GT(segment.length_m, 0.0);
      EXPECT_TRUE(is_finite(segment.map_T_segment));
    }
  }
}

TEST(SpHostile, LookingAtTheSameWallsForEverDoesNoHarm) {
  SpMap map({}, Matrix3::Zero());
  std::vector<SegmentObservation> seen;
  for (const test::TrueWall& wall : test::room()) {
    seen.push_back(see({}, wall, -2.0, 2.0, {true, true}, {1e-9, 1e-9, 1e-9}, Vector4::Zero()));
  }
  for (int k = 0; k < 10'000; ++k) {
    map.update(seen, map.associate(seen));
  }
  EXPECT_GT(smallest_correlation_eigenvalue(map), 0.0);
  EXPECT_EQ(map.segments().size(), 4U);
}

TEST(SpHostile, ARobotThatIsNowhereIsCutLoose) {
  SpMap map({}, Matrix3::Zero());
  const std::vector<SegmentObservation> seen{see({}, test::room()[0], -2.0, 2.0, {true, true}, {}, Vector4::Zero())};
  map.update(seen, map.associate(seen));
  for (int k = 0; k < 100; ++k) {
    map.predict({100.0, 0.0, 1.0}, 10.0 * Matrix3::Identity());
  }
  EXPECT_LE(map.robot_covariance()(0, 0), 1e4 + 20.0);
  EXPECT_GT(smallest_correlation_eigenvalue(map), 0.0);
  EXPECT_LT(map.segment_covariance(1)(0, 0), 1e-3);
}

RC_GTEST_PROP(SpHostile, AnyShortStoryEndsWithACovariance, ()) {
  Torture torture(*rc::gen::arbitrary<std::uint64_t>(), {});
  const int steps = *rc::gen::inRange(1, 200);
  for (int k = 0; k < steps; ++k) {
    torture.step();
  }
  RC_ASSERT(smallest_correlation_eigenvalue(torture.map()) > 0.0);
}

RC_GTEST_PROP(SpHostile, IdsRiseAndRowsFitTheCovariance, ()) {
  Torture torture(*rc::gen::arbitrary<std::uint64_t>(), {});
  for (int k = 0; k < 100; ++k) {
    torture.step();
    SegmentId last = 0;
    Eigen::Index rows = 3;
    for (const SpSegment& segment : torture.map().segments()) {
      RC_ASSERT(segment.id > last);
      last = segment.id;
      RC_ASSERT(torture.map().segment_covariance(segment.id).rows() == 2 + segment.real[0] + segment.real[1]);
      rows += 2 + segment.real[0] + segment.real[1];
    }
    RC_ASSERT(torture.map().covariance().rows() == rows);
  }
}

}  // namespace
}  // namespace seeker::slam
