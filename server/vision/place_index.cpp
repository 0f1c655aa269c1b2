#include "server/vision/place_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/calib3d.hpp>

#include "common/core/assert.hpp"
#include "server/vision/bounds.hpp"

namespace seeker::vision {
namespace {

constexpr double kConfidence = 0.999;
constexpr int kMostSamples = 2000;
constexpr std::size_t kMinPairs = 8;  // of the linear solution

using Points = std::vector<cv::Point2d>;

/// Matched places, row by row.
struct Pairs {
  Points first;
  Points second;
};

Pairs pairs_of(const FeatureList& first, const FeatureList& second, const std::vector<FeatureMatch>& matches) {
  Pairs out;
  const auto point = [](const Keypoint& key) { return cv::Point2d(key.u_px, key.v_px); };
  for (const FeatureMatch& m : matches) {
    out.first.push_back(point(first.keypoints[static_cast<std::size_t>(m.first)]));
    out.second.push_back(point(second.keypoints[static_cast<std::size_t>(m.second)]));
  }
  return out;
}

/// p2' F p1 = 0. Nothing where the library finds none, or several.
std::optional<cv::Matx33d> fundamental(const Pairs& pairs, int method, double epipolar_px) {
  if (pairs.first.size() < kMinPairs) {
    return std::nullopt;
  }
  const cv::Mat model =
      cv::findFundamentalMat(pairs.first, pairs.second, method, epipolar_px, kConfidence, kMostSamples);
  if (model.rows != 3 || model.cols != 3 || model.type() != CV_64F || !cv::checkRange(model)) {
    return std::nullopt;
  }
  return cv::Matx33d(model.ptr<double>());
}

/// Larger of the distances of both points from the other's epipolar line; infinite without a line.
double epipolar_distance(const cv::Matx33d& f, const cv::Point2d& p1, const cv::Point2d& p2) {
  const cv::Vec3d line2 = f * cv::Vec3d(p1.x, p1.y, 1.0);
  const cv::Vec3d line1 = f.t() * cv::Vec3d(p2.x, p2.y, 1.0);
  const double residual = std::abs(line2.dot(cv::Vec3d(p2.x, p2.y, 1.0)));
  return residual / std::min(std::hypot(line1[0], line1[1]), std::hypot(line2[0], line2[1]));
}

std::vector<std::size_t> agreeing(const cv::Matx33d& f, const Pairs& pairs, double epipolar_px) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    if (epipolar_distance(f, pairs.first[i], pairs.second[i]) <= epipolar_px) {
      out.push_back(i);
    }
  }
  return out;
}

Pairs pick(const Pairs& pairs, const std::vector<std::size_t>& indices) {
  Pairs out;
  out.first.reserve(indices.size());
  out.second.reserve(indices.size());
  for (const std::size_t i : indices) {
    out.first.push_back(pairs.first[i]);
    out.second.push_back(pairs.second[i]);
  }
  return out;
}

/// Smallest standard deviation of the points in any direction: a line or a spot of points says little of the views.
double spread_px(const Points& points) {
  cv::Point2d mean;
  for (const cv::Point2d& p : points) {
    mean += p / static_cast<double>(points.size());
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const cv::Point2d& p : points) {
    const cv::Point2d d = p - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double smallest = 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy);
  return std::sqrt(std::max(0.0, smallest) / static_cast<double>(points.size()));
}

/// RANSAC's model, and that of its inliers if more agree with it.
std::vector<std::size_t> largest_agreement(const Pairs& pairs, double epipolar_px) {
  const auto rough = fundamental(pairs, cv::FM_RANSAC, epipolar_px);
  if (!rough) {
    return {};
  }
  const std::vector<std::size_t> first = agreeing(*rough, pairs, epipolar_px);
  const auto refined = fundamental(pick(pairs, first), cv::FM_8POINT, epipolar_px);
  if (!refined) {
    return first;
  }
  const std::vector<std::size_t> second = agreeing(*refined, pairs, epipolar_px);
  return second.size() > first.size() ? second : first;
}

}  // namespace

Status validate(const PlaceParams& p) {
  return check_bounds(std::array<Bound, 6>{{{"places.match.max_distance", p.match.max_distance, 0.01, 20.0},
                                            {"places.match.max_ratio", p.match.max_ratio, 0.1, 1.0},
                                            {"places.max_epipolar_px", p.max_epipolar_px, 0.1, 50.0},
                                            {"places.min_inliers", static_cast<double>(p.min_inliers), 8.0, 1000.0},
                                            {"places.min_inlier_share", p.min_inlier_share, 0.0, 1.0},
                                            {"places.min_spread_px", p.min_spread_px, 0.0, 1000.0}}});
}

DetectorParams place_detector_params() {
  constexpr int kKeyPoints = 400;
  DetectorParams params;
  params.wanted = kKeyPoints;
  return params;
}

std::optional<PlaceEvidence> compare_places(const FeatureList& first, const FeatureList& second,
                                            const PlaceParams& params) {
  const std::vector<FeatureMatch> matches = match_mutually(first.descriptors, second.descriptors, params.match);
  const auto needed = static_cast<std::size_t>(params.min_inliers);
  if (matches.size() < needed) {
    return std::nullopt;
  }
  const Pairs pairs = pairs_of(first, second, matches);
  const std::vector<std::size_t> inliers = largest_agreement(pairs, params.max_epipolar_px);
  if (inliers.size() < needed ||
      static_cast<double>(inliers.size()) < params.min_inlier_share * static_cast<double>(matches.size())) {
    return std::nullopt;
  }
  const Pairs agreed = pick(pairs, inliers);
  if (std::min(spread_px(agreed.first), spread_px(agreed.second)) < params.min_spread_px) {
    return std::nullopt;
  }
  PlaceEvidence evidence;
  evidence.matches = static_cast<int>(matches.size());
  evidence.inliers.reserve(inliers.size());
  for (const std::size_t i : inliers) {
    evidence.inliers.push_back(matches[i]);
  }
  return evidence;
}

PlaceIndex::PlaceIndex(const PlaceParams& params) : params_(params) { SEEKER_ASSERT(validate(params).has_value()); }

void PlaceIndex::add(std::uint64_t id, FeatureList features) {
  const auto at = std::lower_bound(places_.begin(), places_.end(), id,
                                   [](const Place& place, std::uint64_t wanted) { return place.id < wanted; });
  if (at != places_.end() && at->id == id) {
    at->features = std::move(features);
  } else {
    places_.insert(at, {id, std::move(features)});
  }
}

std::vector<PlaceMatch> PlaceIndex::best_matches(const FeatureList& features, std::size_t at_most,
                                                 const std::function<bool(std::uint64_t)>& may_match) const {
  std::vector<PlaceMatch> found;
  for (const Place& place : places_) {
    if (may_match && !may_match(place.id)) {
      continue;
    }
    if (auto evidence = compare_places(features, place.features, params_)) {
      found.push_back({place.id, std::move(*evidence)});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const PlaceMatch& a, const PlaceMatch& b) {
    return a.evidence.inliers.size() > b.evidence.inliers.size();
  });
  found.resize(std::min(found.size(), at_most));
  return found;
}

}  // namespace seeker::vision
