#include "server/vision/regions.hpp"

#include <algorithm>
#include <tuple>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <opencv2/imgproc.hpp>

#include "common/core/rng.hpp"
#include "server/vision/binarise.hpp"

namespace seeker::vision {
namespace {

using Key = std::tuple<int, int, int, int, int, bool>;

std::vector<Key> keys(const std::vector<Region>& regions) {
  std::vector<Key> out;
  for (const Region& r : regions) {
    out.emplace_back(r.box.x, r.box.y, r.box.width, r.box.height, r.area_px, r.light);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Region> by_opencv(const cv::Mat& classes) {
  std::vector<Region> out;
  for (const std::uint8_t value : {kDarkClass, kLightClass}) {
    cv::Mat labels;
    cv::Mat stats;
    cv::Mat centres;
    const cv::Mat mask = classes == value;
    const int n = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
    for (int i = 1; i < n; ++i) {
      out.push_back({cv::Rect(stats.at<int>(i, 0), stats.at<int>(i, 1), stats.at<int>(i, 2), stats.at<int>(i, 3)),
                     stats.at<int>(i, 4), value == kLightClass});
    }
  }
  return out;
}

RC_GTEST_PROP(Regions, AreThoseOfTheLibrary, (std::uint64_t seed)) {
  Rng rng(seed);
  cv::Mat classes(1 + static_cast<int>(rng.below(40)), 1 + static_cast<int>(rng.below(60)), CV_8UC1);
  const double light = rng.uniform(0.1, 0.9);
  for (int row = 0; row < classes.rows; ++row) {
    for (int column = 0; column < classes.cols; ++column) {
      const double draw = rng.uniform();
      classes.at<std::uint8_t>(row, column) = draw < 0.9 * light ? kLightClass : (draw < light ? kNoClass : kDarkClass);
    }
  }
  RC_ASSERT(keys(grow_regions(classes)) == keys(by_opencv(classes)));
}

TEST(Regions, ThatTouchAtACornerAreOne) {
  cv::Mat classes(4, 4, CV_8UC1, cv::Scalar(kNoClass));
  classes.at<std::uint8_t>(1, 1) = kLightClass;
  classes.at<std::uint8_t>(2, 2) = kLightClass;
  const std::vector<Region> regions = grow_regions(classes);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0], (Region{cv::Rect(1, 1, 2, 2), 2, true}));
}

TEST(Binarise, OtsuPartsTwoPopulations) {
  Histogram counts{};
  counts[40] = 300;
  counts[45] = 200;
  counts[200] = 100;
  const auto threshold = otsu_threshold(counts, 0, 255);
  ASSERT_TRUE(threshold.has_value());
  EXPECT_GE(*threshold, 45);
  EXPECT_LT(*threshold, 200);
}

TEST(Binarise, OneGreyLevelHasNoThreshold) {
  EXPECT_FALSE(otsu_threshold(histogram(cv::Mat(9, 9, CV_8UC1, cv::Scalar(7))), 0, 255).has_value());
  EXPECT_TRUE(binarise(cv::Mat(9, 9, CV_8UC1, cv::Scalar(7)), TemplateParams()).empty());
}

TEST(Binarise, StretchMapsThePercentilesToBlackAndWhite) {
  Histogram counts{};
  for (std::size_t level = 100; level < 200; ++level) {
    counts[level] = 10;
  }
  const auto table = stretch_table(counts, 0.01, 0.99);
  EXPECT_EQ(table[101], 0);
  EXPECT_EQ(table[199], 255);
  EXPECT_NEAR(table[150], 127, 3);
}

}  // namespace
}  // namespace seeker::vision
