#include "server/vision/sift_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "common/core/angle.hpp"
#include "server/vision/bounds.hpp"
#include "server/vision/contrast_threshold.hpp"

namespace seeker::vision {
namespace {

constexpr int kOctaveLayers = 3;
constexpr double kSigma = 1.6;
/// OpenCV 4.6 shifts key points by half a pixel of the doubled picture (corrected upstream in 4.8).
constexpr float kShift_px = 0.25F;
constexpr float kSamePlace_px = 0.5F;
/// Less cannot hold a key point and its border.
constexpr int kMinSide_px = 16;
/// More are described than kept, since about a sixth share a place with another. Each costs 0.02 % of a detection.
constexpr double kOversupply = 1.15;

using Indices = std::vector<std::size_t>;

bool same_place(const cv::KeyPoint& a, const cv::KeyPoint& b) {
  return std::abs(a.pt.x - b.pt.x) < kSamePlace_px && std::abs(a.pt.y - b.pt.y) < kSamePlace_px;
}

/// Key points by place: each place's indices in the order of `keys`.
std::vector<Indices> places_of(const std::vector<cv::KeyPoint>& keys) {
  Indices order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&keys](std::size_t a, std::size_t b) { return keys[a].pt.x < keys[b].pt.x; });
  std::vector<Indices> places;
  for (const std::size_t i : order) {
    auto place = places.rbegin();
    while (place != places.rend() && keys[i].pt.x - keys[place->front()].pt.x < kSamePlace_px &&
           !same_place(keys[i], keys[place->front()])) {
      ++place;
    }
    if (place != places.rend() && same_place(keys[i], keys[place->front()])) {
      place->push_back(i);
    } else {
      places.push_back({i});
    }
  }
  return places;
}

/// The strongest of each cell of the grid, then every cell's second, and so on, until there are `at_most`.
std::vector<Indices> spread(const std::vector<cv::KeyPoint>& keys, std::vector<Indices> places, const cv::Size& size,
                            const DetectorParams& params) {
  const auto at_most = static_cast<std::size_t>(params.at_most > 0 ? params.at_most : params.wanted);
  std::stable_sort(places.begin(), places.end(), [&keys](const Indices& a, const Indices& b) {
    return keys[a.front()].response > keys[b.front()].response;
  });
  if (places.size() <= at_most) {
    return places;
  }
  const auto cell_of = [&](const cv::Point2f& p) {
    const auto along = [](float at, int length, int cells) {
      return std::clamp(static_cast<int>(at / static_cast<float>(length) * static_cast<float>(cells)), 0, cells - 1);
    };
    return static_cast<std::size_t>(along(p.y, size.height, params.grid_rows) * params.grid_columns +
                                    along(p.x, size.width, params.grid_columns));
  };
  std::vector<int> taken(static_cast<std::size_t>(params.grid_columns) * static_cast<std::size_t>(params.grid_rows));
  std::vector<std::pair<int, std::size_t>> ranked;  // how many of its cell are stronger, place
  ranked.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    ranked.emplace_back(taken[cell_of(keys[places[i].front()].pt)]++, i);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Indices> kept;
  kept.reserve(at_most);
  for (std::size_t i = 0; i < at_most; ++i) {
    kept.push_back(std::move(places[ranked[i].second]));
  }
  return kept;
}

/// OpenCV's floats are whole numbers, 512 times the unit descriptor.
Descriptor describe(const float* row, DescriptorKind kind) {
  Descriptor out;
  if (kind == DescriptorKind::kSift) {
    std::transform(row, row + kDescriptorSize, out.begin(), [](float v) { return static_cast<std::uint8_t>(v); });
    return out;
  }
  constexpr auto kUnit = static_cast<float>(kDescriptorUnit);
  const float scale = kUnit * kUnit / std::max(1.0F, std::accumulate(row, row + kDescriptorSize, 0.0F));
  std::transform(row, row + kDescriptorSize, out.begin(),
                 [scale](float v) { return static_cast<std::uint8_t>(std::min(255.0F, std::sqrt(v * scale) + 0.5F)); });
  return out;
}

/// OpenCV's angle grows clockwise as seen, its size is twice sigma; `pixel` is the width of the detector's pixels.
Keypoint keypoint_of(const cv::KeyPoint& key, float pixel) {
  const auto in_picture = [pixel](float at) { return pixel * (at - kShift_px + 0.5F) - 0.5F; };
  return {in_picture(key.pt.x), in_picture(key.pt.y), pixel * 0.5F * key.size,
          static_cast<float>(wrap_angle(-deg_to_rad(static_cast<double>(key.angle))))};
}

}  // namespace

Status validate(const DetectorParams& p) {
  constexpr double kMost = 20000.0;
  return check_bounds(
      std::array<Bound, 7>{{{"detector.wanted", static_cast<double>(p.wanted), 1.0, kMost},
                            {"detector.at_most", static_cast<double>(p.at_most), 0.0, kMost},
                            {"detector.contrast_threshold", p.contrast_threshold, 0.001, 0.5},
                            {"detector.contrast_halvings", static_cast<double>(p.contrast_halvings), 0.0, 5.0},
                            {"detector.edge_threshold", p.edge_threshold, 1.0, 1000.0},
                            {"detector.grid_columns", static_cast<double>(p.grid_columns), 1.0, 100.0},
                            {"detector.grid_rows", static_cast<double>(p.grid_rows), 1.0, 100.0}}});
}

bool same_place(const Keypoint& a, const Keypoint& b) {
  return std::abs(a.u_px - b.u_px) < kSamePlace_px && std::abs(a.v_px - b.v_px) < kSamePlace_px;
}

FeatureList detect_sift(const cv::Mat& grey, const DetectorParams& params, Orientations orientations) {
  if (std::min(grey.rows, grey.cols) < kMinSide_px * (params.half_resolution ? 2 : 1)) {
    return {};
  }
  cv::Mat picture = grey;
  if (params.half_resolution) {
    cv::resize(grey, picture, cv::Size(grey.cols / 2, grey.rows / 2), 0.0, 0.0, cv::INTER_AREA);
  }
  const int described = cvCeil(kOversupply * (params.at_most > 0 ? params.at_most : params.wanted));
  const auto sift = cv::SIFT::create(described, kOctaveLayers, pick_contrast_threshold(picture, params),
                                     params.edge_threshold, kSigma);
  std::vector<cv::KeyPoint> keys;
  cv::Mat descriptors;
  sift->detectAndCompute(picture, cv::noArray(), keys, descriptors);
  FeatureList out;
  out.keypoints.reserve(keys.size());
  out.descriptors.reserve(keys.size());
  for (const Indices& place : spread(keys, places_of(keys), picture.size(), params)) {
    const std::size_t described_here = orientations == Orientations::kAll ? place.size() : 1;
    for (std::size_t k = 0; k < described_here; ++k) {
      out.keypoints.push_back(keypoint_of(keys[place[k]], params.half_resolution ? 2.0F : 1.0F));
      out.descriptors.push_back(describe(descriptors.ptr<float>(static_cast<int>(place[k])), params.kind));
    }
  }
  return out;
}

}  // namespace seeker::vision
