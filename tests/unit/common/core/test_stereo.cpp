#include "common/core/stereo.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace seeker {
namespace {

TEST(StereoGeometry, DefaultIsTheCameraOfThePaper) {
  const StereoGeometry geometry;
  EXPECT_TRUE(validate(geometry).has_value());
  EXPECT_DOUBLE_EQ(geometry.focal_px, 839.478943);
  EXPECT_DOUBLE_EQ(geometry.baseline_m, 0.12);
}

TEST(StereoGeometry, WhatIsNoCameraIsRefused) {
  const auto refused = [](auto change) {
    StereoGeometry geometry;
    change(geometry);
    const Status status = validate(geometry);
    return !status && status.error().code == Errc::kInvalidArgument;
  };
  EXPECT_TRUE(refused([](StereoGeometry& g) { g.width_px = 0; }));
  EXPECT_TRUE(refused([](StereoGeometry& g) { g.height_px = kMaxImageSide_px + 1; }));
  EXPECT_TRUE(refused([](StereoGeometry& g) { g.focal_px = std::nan(""); }));
  EXPECT_TRUE(refused([](StereoGeometry& g) { g.baseline_m = 0.0; }));
  EXPECT_TRUE(refused([](StereoGeometry& g) { g.centre_u_px = g.width_px; }));
  EXPECT_TRUE(refused([](StereoGeometry& g) { g.centre_v_px = -1.0; }));
}

TEST(StereoGeometry, EveryFieldChangesTheHash) {
  const StereoGeometry geometry;
  const auto changed = [&](auto change) {
    StereoGeometry other = geometry;
    change(other);
    return calibration_hash(other) != calibration_hash(geometry);
  };
  EXPECT_EQ(calibration_hash(geometry), calibration_hash(StereoGeometry{}));
  EXPECT_TRUE(changed([](StereoGeometry& g) { g.width_px += 1; }));
  EXPECT_TRUE(changed([](StereoGeometry& g) { g.height_px += 1; }));
  EXPECT_TRUE(changed([](StereoGeometry& g) { g.focal_px += 1e-9; }));
  EXPECT_TRUE(changed([](StereoGeometry& g) { g.centre_u_px += 1.0; }));
  EXPECT_TRUE(changed([](StereoGeometry& g) { g.centre_v_px += 1.0; }));
  EXPECT_TRUE(changed([](StereoGeometry& g) { g.baseline_m += 1e-6; }));
}

}  // namespace
}  // namespace seeker
