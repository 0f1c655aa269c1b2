#include "server/vision/target_template.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "server/vision/binarise.hpp"

namespace seeker::vision {
namespace {

/// Longest sides of the prepared sizes. Above the last one nothing is gained (tests/bench/bench_vision.cpp).
constexpr std::array<int, 4> kPatchSides = {12, 16, 24, 32};
constexpr int kMinPatchSide = 3;
constexpr std::size_t kMaxInnerAnchors = 3;
constexpr double kMinAnchorShare = 0.04;  // of the picture's area
constexpr double kWholeSide = 0.92;       // a part that wide and high is the whole
constexpr double kMinGroundShare = 0.05;  // of the picture
constexpr double kMaxGroundShare = 0.90;
constexpr double kMinBorderShare = 0.60;  // of the picture's rim that is ground
constexpr int kGroundTolerance = 12;      // grey levels
constexpr double kMinTexture = 12.0;      // standard deviation of an object, grey levels

std::vector<TemplatePatch> make_patches(const cv::Mat& grey, const cv::Mat& mask) {
  std::vector<TemplatePatch> patches;
  const int longest = std::max(grey.cols, grey.rows);
  for (const int side : kPatchSides) {
    const int columns = std::max(kMinPatchSide, cvRound(static_cast<double>(side) * grey.cols / longest));
    const int rows = std::max(kMinPatchSide, cvRound(static_cast<double>(side) * grey.rows / longest));
    patches.emplace_back(grey, mask, columns, rows);
  }
  return patches;
}

cv::Rect2d relative(const cv::Rect& box, const cv::Size& whole) {
  return {static_cast<double>(box.x) / whole.width, static_cast<double>(box.y) / whole.height,
          static_cast<double>(box.width) / whole.width, static_cast<double>(box.height) / whole.height};
}

/// Where the whole is, given the box of a part of it.
cv::Rect2d whole_from_part(const cv::Rect2d& box, const cv::Rect2d& part) {
  const double width = box.width / part.width;
  const double height = box.height / part.height;
  return {box.x - part.x * width, box.y - part.y * height, width, height};
}

Anchor whole_anchor(const cv::Mat& grey) {
  return {cv::Rect2d(0.0, 0.0, 1.0, 1.0), static_cast<double>(grey.cols) / grey.rows, std::nullopt};
}

/// The largest regions inside the picture, of both classes of Otsu's threshold.
std::vector<Anchor> inner_anchors(const cv::Mat& grey, const TemplateParams& params) {
  TemplateParams plain = params;
  plain.extra_binarisations = false;
  const std::vector<Binarisation> classes = binarise(preprocess(grey, params).denoised, plain);
  if (classes.empty()) {
    return {};
  }
  std::vector<Region> regions = grow_regions(classes.front().classes);
  std::stable_sort(regions.begin(), regions.end(),
                   [](const Region& a, const Region& b) { return a.box.area() > b.box.area(); });
  std::vector<Anchor> anchors;
  for (const Region& region : regions) {
    const cv::Rect2d part = relative(region.box, grey.size());
    const bool whole = part.width > kWholeSide && part.height > kWholeSide;
    if (!whole && part.area() >= kMinAnchorShare && anchors.size() < kMaxInnerAnchors) {
      anchors.push_back({part, static_cast<double>(region.box.width) / region.box.height, region.light});
    }
  }
  return anchors;
}

/// Pixels of a picture's object (255) where its ground is of one colour and touches the rim; empty otherwise.
cv::Mat object_mask(const cv::Mat& grey) {
  std::vector<std::uint8_t> rim;
  for (int column = 0; column < grey.cols; ++column) {
    rim.push_back(grey.at<std::uint8_t>(0, column));
    rim.push_back(grey.at<std::uint8_t>(grey.rows - 1, column));
  }
  for (int row = 0; row < grey.rows; ++row) {
    rim.push_back(grey.at<std::uint8_t>(row, 0));
    rim.push_back(grey.at<std::uint8_t>(row, grey.cols - 1));
  }
  std::nth_element(rim.begin(), rim.begin() + static_cast<std::ptrdiff_t>(rim.size() / 2), rim.end());
  const int ground = rim[rim.size() / 2];
  const auto is_ground = [ground](std::uint8_t v) { return std::abs(v - ground) <= kGroundTolerance; };
  if (static_cast<double>(std::count_if(rim.begin(), rim.end(), is_ground)) <
      kMinBorderShare * static_cast<double>(rim.size())) {
    return {};
  }
  // A frame of ground joins what touches the rim; flooding from its corner leaves the object with its holes filled.
  cv::Mat like_ground;
  cv::inRange(grey, cv::Scalar(ground - kGroundTolerance), cv::Scalar(ground + kGroundTolerance), like_ground);
  cv::Mat framed;
  cv::copyMakeBorder(like_ground, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  constexpr int kFlooded = 100;
  cv::floodFill(framed, cv::Point(0, 0), cv::Scalar(kFlooded));
  cv::Mat mask = framed(cv::Rect(1, 1, grey.cols, grey.rows)) != kFlooded;
  const double ground_share = 1.0 - static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(grey.total());
  return ground_share >= kMinGroundShare && ground_share <= kMaxGroundShare ? mask : cv::Mat();
}

std::optional<TemplateVariant> object_variant(const cv::Mat& grey, const TemplateParams& params) {
  const cv::Mat mask = object_mask(grey);
  if (mask.empty()) {
    return std::nullopt;
  }
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(grey, mean, deviation, mask);
  if (deviation[0] < kMinTexture) {
    return std::nullopt;
  }
  const cv::Rect box = cv::boundingRect(mask);
  const cv::Mat object = grey(box);
  TemplateVariant variant{make_patches(object, mask(box)), {whole_anchor(object)}, relative(box, grey.size())};
  if (params.inner_anchors) {
    const std::vector<Anchor> inner = inner_anchors(object, params);
    variant.anchors.insert(variant.anchors.end(), inner.begin(), inner.end());
  }
  return variant;
}

}  // namespace

cv::Rect2d Anchor::whole(const cv::Rect& region) const { return whole_from_part(region, part); }

cv::Rect2d TemplateVariant::whole(const cv::Rect2d& box) const { return whole_from_part(box, part); }

bool Anchor::fits(const cv::Rect& region, double tolerance) const {
  const double expected_px = aspect * region.height;
  return std::abs(region.width - expected_px) <= tolerance * expected_px + 1.0;
}

const TemplatePatch& TemplateVariant::patch_for(const cv::Rect2d& box) const {
  const double longest = std::max(box.width, box.height);
  std::size_t chosen = 0;
  for (std::size_t i = 1; i < patches.size(); ++i) {
    if (std::max(patches[i].columns(), patches[i].rows()) <= longest) {
      chosen = i;
    }
  }
  return patches[chosen];
}

TargetTemplate make_target_template(const cv::Mat& grey, int target, double height_m, const TemplateParams& params) {
  TargetTemplate out{target, height_m, {}};
  TemplateVariant whole{make_patches(grey, cv::Mat()), {whole_anchor(grey)}, cv::Rect2d(0.0, 0.0, 1.0, 1.0)};
  if (params.inner_anchors) {
    const std::vector<Anchor> inner = inner_anchors(grey, params);
    whole.anchors.insert(whole.anchors.end(), inner.begin(), inner.end());
  }
  out.variants.push_back(std::move(whole));
  std::optional<TemplateVariant> object = params.object_alone ? object_variant(grey, params) : std::nullopt;
  if (object) {
    out.variants.push_back(std::move(*object));
  }
  return out;
}

}  // namespace seeker::vision
