#include "server/fleet/scan_signature.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "toy_maps.hpp"

namespace seeker::fleet {
namespace {

double between(const ScanSignature& a, const ScanSignature& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kSignatureSize; ++k) {
    sum += (a[k] - b[k]) * (a[k] - b[k]);
  }
  return std::sqrt(sum);
}

/// All around: a look ahead and one back.
std::vector<slam::SeenPoints> around(const Pose2& world_T_base, std::uint64_t seed, double rotation_rad = 0.0) {
  Rng rng(seed);
  std::vector<slam::SeenPoints> seen;
  for (const double look_rad : {0.0, kPi}) {
    const Pose2 base_T_look{0.0, 0.0, look_rad};
    const LaserScan scan = scan_from(office(1), world_T_base * base_T_look, rng);
    seen.push_back(slam::transform(Pose2{0.0, 0.0, rotation_rad} * base_T_look, slam::seen_points(scan)));
  }
  return seen;
}

TEST(ScanSignature, DoesNotChangeWithTheHeadingOfTheRobot) {
  const Pose2 here{6.0, 6.0, 0.0};
  const ScanSignature straight = signature_at({0.0, 0.0}, around(here, 1));
  for (const double rotation_rad : {0.5, 1.7, -2.9}) {
    const Pose2 turned{6.0, 6.0, rotation_rad};
    EXPECT_LT(between(straight, signature_at({0.0, 0.0}, around(turned, 2))), 0.12) << rotation_rad;
  }
}

TEST(ScanSignature, DistinguishesAPlaceFromOthersOfTheSameBuilding) {
  const ScanSignature here = signature_at({0.0, 0.0}, around({3.0, 6.0, 0.3}, 1));
  const ScanSignature again = signature_at({0.0, 0.0}, around({3.2, 6.05, -1.0}, 2));
  const ScanSignature room = signature_at({0.0, 0.0}, around({2.0, 2.2, 0.0}, 3));
  EXPECT_LT(between(here, again), between(here, room));
}

TEST(ScanSignature, OfNothingSeenIsThatOfOpenSpace) {
  const ScanSignature open = signature_at({0.0, 0.0}, {});
  EXPECT_FLOAT_EQ(open[0], 1.0F);
  EXPECT_NEAR(open[1], 0.0F, 1e-6F);
}

TEST(SignatureIndex, FindsTheNearestAsLookingAtAllDoes) {
  Rng rng(5);
  const auto random = [&] {
    ScanSignature signature{};
    for (float& value : signature) {
      value = static_cast<float>(rng.uniform(0.0, 1.0));
    }
    return signature;
  };
  std::vector<std::pair<ScanSignature, std::size_t>> entries;
  for (std::size_t k = 0; k < 200; ++k) {
    entries.emplace_back(random(), 1000 + k);
  }
  const SignatureIndex index(entries);
  EXPECT_EQ(index.size(), 200U);
  for (int k = 0; k < 20; ++k) {
    const ScanSignature asked = random();
    const auto best = std::min_element(entries.begin(), entries.end(), [&](const auto& p, const auto& q) {
      return between(p.first, asked) < between(q.first, asked);
    });
    const auto found = index.nearest(asked, 3);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].value, best->second);
    EXPECT_LE(found[0].distance, found[1].distance);
    EXPECT_LE(found[1].distance, found[2].distance);
  }
}

TEST(SignatureIndex, OfNothingFindsNothing) { EXPECT_TRUE(SignatureIndex().nearest(ScanSignature{}, 3).empty()); }

}  // namespace
}  // namespace seeker::fleet
