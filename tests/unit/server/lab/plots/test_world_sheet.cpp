#include "server/lab/plots/world_sheet.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace seeker::lab {
namespace {

bool is_dark(const Image& image, int u, int v) {
  constexpr int kDark = 128;
  const std::uint8_t* rgb = image.at(u, v);
  return rgb[0] < kDark && rgb[1] < kDark && rgb[2] < kDark;
}

/// How long the bar's upper edge is: the longest row of dark pixels near the lower end of the picture.
int bar_length_px(const Image& image) {
  constexpr int kStrip_px = 30;
  int longest = 0;
  for (int v = image.height_px() - kStrip_px; v < image.height_px(); ++v) {
    int run = 0;
    for (int u = 0; u < image.width_px(); ++u) {
      run = is_dark(image, u, v) ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  }
  return longest;
}

TEST(WorldSheet, BarIsOfTheScaleOfTheWorld) {
  // The longest of 1, 2, 5, 10, .. m within a quarter of the picture.
  for (const auto& [side_m, bar_m] : {std::pair{9.2, 2.0}, {35.2, 5.0}, {99.2, 20.0}}) {
    sim::World world;
    world.max_corner = {side_m, side_m};
    WorldSheet sheet(world, {.margin_m = 0.4});
    sheet.foot({{"wall", {image::kGrey, 2.0}}});
    EXPECT_NEAR(bar_length_px(sheet.canvas().image()), bar_m * sheet.px_per_m(), 3.0) << side_m << " m";
    EXPECT_NEAR((sheet.px({1.0, 0.0}) - sheet.px({0.0, 0.0})).x(), sheet.px_per_m(), 1e-9);
  }
}

TEST(WorldSheet, PaintsOnlyTheWorldAndThereInItsPlace) {
  WorldSheet sheet({2.0, 1.0}, {6.0, 3.0}, {.margin_m = 0.0});
  sheet.paint([](const Point2& p) { return p.x() < 4.0 ? std::optional(image::kBlack) : std::nullopt; });
  const Image image = sheet.canvas().image();
  const auto dark_at = [&](const Point2& p) {
    const Point2 px = sheet.px(p);
    return is_dark(image, static_cast<int>(px.x()), static_cast<int>(px.y()));
  };
  EXPECT_TRUE(dark_at({2.1, 1.1}));
  EXPECT_TRUE(dark_at({3.9, 2.9}));
  EXPECT_FALSE(dark_at({4.1, 2.0}));
  EXPECT_FALSE(is_dark(image, 0, 0)) << "the header";
  EXPECT_FALSE(is_dark(image, 0, image.height_px() - 1)) << "the footer";
}

TEST(WorldSheet, WorldLiesBetweenHeaderAndFooter) {
  sim::World world;
  world.max_corner = {20.0, 10.0};
  WorldSheet sheet(world, {.header_px = 90});
  EXPECT_GT(sheet.px(world.max_corner).y(), 90.0);
  EXPECT_LT(sheet.px(world.min_corner).y(), sheet.canvas().image().height_px() - 70.0);
}

}  // namespace
}  // namespace seeker::lab
