#include "server/vision/omni_camera.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"

namespace seeker::vision {
namespace {

// Spec S3.6: pixels of the paper's two detections with their exact angles; acceptance R6 of S7.
TEST(OmniCamera, BearingsOfThePaperAreExact) {
  const OmniCamera camera;
  const double a = camera.bearing_base_rad({123.0, 276.0});
  const double b = camera.bearing_base_rad({117.0, 263.0});
  EXPECT_NEAR(rad_to_deg(a), 100.6, 0.05);
  EXPECT_NEAR(rad_to_deg(b), 96.6, 0.05);
  // theta_0 = alpha' + theta_r, eq (5), from the printed 100 and 97 deg.
  EXPECT_DOUBLE_EQ(100.0 - 41.0, 59.0);
  EXPECT_NEAR(rad_to_deg(b) - 39.0, 58.0, 0.5);
}

TEST(OmniCamera, UpIsForwardAndLeftIsPositive) {
  const OmniCamera camera;
  EXPECT_NEAR(camera.bearing_base_rad({315.0, 100.0}), 0.0, 1e-12);
  EXPECT_NEAR(camera.bearing_base_rad({100.0, 240.0}), kPi / 2.0, 1e-12);
  EXPECT_NEAR(camera.bearing_base_rad({500.0, 240.0}), -kPi / 2.0, 1e-12);
  EXPECT_NEAR(std::abs(camera.bearing_base_rad({315.0, 400.0})), kPi, 1e-12);
}

TEST(OmniCamera, BearingDoesNotDependOnTheMirrorsProfile) {
  OmniCameraParams other;
  other.elevation_coefficients = {0.1, 0.4, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(OmniCamera().bearing_base_rad({400.0, 111.0}), OmniCamera(other).bearing_base_rad({400.0, 111.0}));
}

// vision.md 4.4: an error e of the centre gives up to e / r rad, 1 px at 200 px radius = 0.29 deg.
TEST(OmniCamera, AWrongCentreShiftsBearingsByErrorOverRadius) {
  OmniCameraParams shifted;
  shifted.v0_px += 1.0;
  const OmniCamera camera(shifted);
  const PixelPoint left{115.0, 240.0};
  EXPECT_NEAR(rad_to_deg(OmniCamera().bearing_base_rad(left) - camera.bearing_base_rad(left)), 0.29, 0.01);
  const PixelPoint forward{315.0, 40.0};
  EXPECT_NEAR(OmniCamera().bearing_base_rad(forward), camera.bearing_base_rad(forward), 1e-12);
}

TEST(OmniCamera, TheAffinePartIsUndone) {
  OmniCameraParams params;
  params.affine_c = 1.02;
  params.affine_d = 0.01;
  params.affine_e = -0.015;
  params.alignment_rad = 0.02;
  const OmniCamera camera(params);
  for (double bearing = -3.0; bearing < 3.1; bearing += 0.3) {
    const auto pixel = camera.pixel_of(bearing, -0.1);
    ASSERT_TRUE(pixel.has_value());
    EXPECT_NEAR(camera.bearing_base_rad(*pixel), bearing, 1e-9);
    EXPECT_NEAR(camera.elevation_rad(camera.radius_px(*pixel)), -0.1, 1e-6);
  }
  // Taken for a camera without distortion, bearings are off by about half the distortion.
  const auto diagonal = camera.pixel_of(kPi / 4.0, 0.0);
  ASSERT_TRUE(diagonal.has_value());
  const double off = OmniCamera().bearing_base_rad(*diagonal) + params.alignment_rad - kPi / 4.0;
  EXPECT_GT(std::abs(off), 0.005);
  EXPECT_LT(std::abs(off), 0.03);
}

// The real calibration of vision.md 4.4 (c 0.999845, d 4.4e-5, e 8e-6) matters less than a hundredth of a degree.
TEST(OmniCamera, ARealCalibrationsAffinePartHardlyMatters) {
  OmniCameraParams params;
  params.affine_c = 0.999845;
  params.affine_d = 0.000044;
  params.affine_e = 0.000008;
  const OmniCamera camera(params);
  for (const PixelPoint p : {PixelPoint{123.0, 276.0}, PixelPoint{450.0, 120.0}, PixelPoint{300.0, 400.0}}) {
    EXPECT_LT(std::abs(rad_to_deg(camera.bearing_base_rad(p) - OmniCamera().bearing_base_rad(p))), 0.01);
  }
}

TEST(OmniCamera, ExpectedSizeFallsWithRange) {
  const OmniCamera camera;
  const auto near = camera.expected_size_px(0.3, 0.3, 1.0);
  const auto far = camera.expected_size_px(0.3, 0.3, 4.0);
  ASSERT_TRUE(near && far);
  EXPECT_NEAR(near->width_px / far->width_px, 4.0, 0.15);
  EXPECT_NEAR(far->width_px, 0.3 / 4.0 * 172.7, 0.5);
  EXPECT_NEAR(far->height_px, 0.3 / 4.0 / 0.6391 * 100.0, 0.5);
  EXPECT_FALSE(camera.expected_size_px(0.3, 3.0, 1.0).has_value());  // beyond the rim
  EXPECT_FALSE(camera.expected_size_px(0.3, 0.3, 0.0).has_value());
}

TEST(OmniCamera, TheRingEndsAtHoodAndRim) {
  const OmniCamera camera;
  EXPECT_FALSE(camera.in_ring({315.0, 240.0}));
  EXPECT_TRUE(camera.in_ring({315.0, 100.0}));
  EXPECT_FALSE(camera.in_ring({60.0, 240.0}));
}

TEST(OmniCamera, ACalibrationThatIsNoneIsRefused) {
  const auto refused = [](auto change) {
    OmniCameraParams params;
    change(params);
    return !validate(params).has_value();
  };
  EXPECT_TRUE(validate(OmniCameraParams()).has_value());
  EXPECT_TRUE(refused([](auto& p) { p.width_px = 0; }));
  EXPECT_TRUE(refused([](auto& p) { p.u0_px = -1.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.v0_px = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](auto& p) { p.inner_radius_px = 300.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.affine_c = 0.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.elevation_coefficients = {0.0, -0.5, 0.0, 0.0}; }));
  EXPECT_TRUE(refused([](auto& p) { p.elevation_coefficients[1] = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](auto& p) { p.camera_height_m = 0.0; }));
}

}  // namespace
}  // namespace seeker::vision
