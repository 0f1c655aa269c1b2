#include "server/vision/sift_features.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace seeker::vision {
namespace {

constexpr int kOctaveLayers = 3;
constexpr double kEdgeThreshold = 10.0;
constexpr double kSigma = 1.6;
constexpr int kHalvings = 2;
/// OpenCV 4.6 shifts key points by half a pixel of the doubled picture (corrected upstream in 4.8).
constexpr float kShift_px = 0.25F;
constexpr float kSamePlace_px = 0.5F;
/// Less cannot hold a key point and its border.
constexpr int kMinSide_px = 16;

bool same_place(const cv::KeyPoint& a, const cv::KeyPoint& b) {
  return std::abs(a.pt.x - b.pt.x) < kSamePlace_px && std::abs(a.pt.y - b.pt.y) < kSamePlace_px;
}

/// Indices of the key points without later ones at the same place, by column.
std::vector<int> distinct_places(const std::vector<cv::KeyPoint>& keys) {
  std::vector<int> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&keys](int a, int b) {
    return keys[static_cast<std::size_t>(a)].pt.x < keys[static_cast<std::size_t>(b)].pt.x;
  });
  std::vector<int> kept;
  for (const int i : order) {
    const cv::KeyPoint& key = keys[static_cast<std::size_t>(i)];
    bool repeated = false;
    for (auto k = kept.rbegin(); k != kept.rend() && !repeated; ++k) {
      const cv::KeyPoint& other = keys[static_cast<std::size_t>(*k)];
      if (key.pt.x - other.pt.x >= kSamePlace_px) {
        break;
      }
      repeated = same_place(key, other);
    }
    if (!repeated) {
      kept.push_back(i);
    }
  }
  return kept;
}

struct Neighbours {
  int best = -1;
  float distance = 0.0F;
  bool distinct = false;  ///< clearly nearer than the second
};

std::vector<Neighbours> nearest(const cv::Mat& query, const cv::Mat& train, double ratio) {
  std::vector<std::vector<cv::DMatch>> found;
  cv::BFMatcher(cv::NORM_L2).knnMatch(query, train, found, 2);
  std::vector<Neighbours> out(static_cast<std::size_t>(query.rows));
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) {
      continue;
    }
    const bool alone = found[i].size() < 2;
    out[i] = {found[i][0].trainIdx, found[i][0].distance,
              alone || found[i][0].distance < static_cast<float>(ratio) * found[i][1].distance};
  }
  return out;
}

}  // namespace

SiftFeatures detect_sift(const cv::Mat& grey, const FeatureParams& params) {
  SiftFeatures out;
  if (std::min(grey.rows, grey.cols) < kMinSide_px) {
    return out;
  }
  std::vector<cv::KeyPoint> keys;
  cv::Mat descriptors;
  double threshold = params.contrast_threshold;
  for (int i = 0; i <= kHalvings; ++i, threshold *= 0.5) {
    const auto sift = cv::SIFT::create(params.max_features, kOctaveLayers, threshold, kEdgeThreshold, kSigma);
    keys.clear();
    sift->detectAndCompute(grey, cv::noArray(), keys, descriptors);
    if (static_cast<int>(keys.size()) >= params.wanted_features) {
      break;
    }
  }
  for (const int i : distinct_places(keys)) {
    const cv::Point2f at = keys[static_cast<std::size_t>(i)].pt;
    out.points.emplace_back(at.x - kShift_px, at.y - kShift_px);
    out.descriptors.push_back(descriptors.row(i));
  }
  return out;
}

std::vector<FeatureMatch> match_mutually(const SiftFeatures& target, const SiftFeatures& scene, double ratio) {
  std::vector<FeatureMatch> matches;
  if (target.points.empty() || scene.points.empty()) {
    return matches;
  }
  const std::vector<Neighbours> forth = nearest(target.descriptors, scene.descriptors, ratio);
  const std::vector<Neighbours> back = nearest(scene.descriptors, target.descriptors, ratio);
  for (std::size_t i = 0; i < forth.size(); ++i) {
    const Neighbours& f = forth[i];
    if (f.best < 0 || !f.distinct) {
      continue;
    }
    const Neighbours& b = back[static_cast<std::size_t>(f.best)];
    if (b.distinct && b.best == static_cast<int>(i)) {
      matches.push_back({static_cast<int>(i), f.best});
    }
  }
  return matches;
}

}  // namespace seeker::vision
