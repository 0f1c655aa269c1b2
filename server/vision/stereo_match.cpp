#include "server/vision/stereo_match.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "common/core/angle.hpp"
#include "server/vision/bbf_tree.hpp"
#include "server/vision/sift_features.hpp"

namespace seeker::vision {
namespace {

/// Key points by row, so that one left point meets only those near its row.
class RowIndex {
 public:
  explicit RowIndex(const std::vector<Keypoint>& keys) : order_(keys.size()), rows_(keys.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&keys](int a, int b) {
      return keys[static_cast<std::size_t>(a)].v_px < keys[static_cast<std::size_t>(b)].v_px;
    });
    std::transform(order_.begin(), order_.end(), rows_.begin(),
                   [&keys](int i) { return keys[static_cast<std::size_t>(i)].v_px; });
  }

  /// Calls visit(i) for every key point with |v - v_px| < gate_px.
  template <class Visit>
  void near(double v_px, double gate_px, const Visit& visit) const {
    const auto first = std::upper_bound(rows_.begin(), rows_.end(), v_px - gate_px);
    for (auto row = first; row != rows_.end() && *row < v_px + gate_px; ++row) {
      visit(order_[static_cast<std::size_t>(row - rows_.begin())]);
    }
  }

 private:
  std::vector<int> order_;
  std::vector<double> rows_;
};

/// Constraints (2), (3), (4).
bool may_match(const Keypoint& left, const Keypoint& right, const StereoMatchParams& params) {
  const double disparity = static_cast<double>(left.u_px) - static_cast<double>(right.u_px);
  if (!(disparity > params.min_disparity_px && disparity < params.max_disparity_px)) {
    return false;
  }
  const double turn =
      wrap_angle(static_cast<double>(left.orientation_rad) - static_cast<double>(right.orientation_rad));
  if (!(std::abs(turn) < params.max_rotation_rad)) {
    return false;
  }
  const double smaller = std::min(left.scale_px, right.scale_px);
  const double larger = std::max(left.scale_px, right.scale_px);
  return params.scale_gate_kind == ScaleGate::kRatio ? larger <= params.scale_gate * smaller
                                                     : larger - smaller < params.scale_gate;
}

/// The best of those that may match, and the best at any other place than that.
struct Candidates {
  NearestTwo nearest;
  int places_within_gate = 0;

  void offer(int index, std::uint32_t distance, std::uint32_t gate, const std::vector<Keypoint>& keys) {
    const auto here = [&](std::int32_t other) {
      return other != NearestTwo::kNone &&
             same_place(keys[static_cast<std::size_t>(other)], keys[static_cast<std::size_t>(index)]);
    };
    const bool known_place = here(nearest.best) || here(nearest.second);
    places_within_gate += distance <= gate && !known_place ? 1 : 0;
    if (distance < nearest.best_distance) {
      if (!here(nearest.best)) {
        nearest.second = nearest.best;
        nearest.second_distance = nearest.best_distance;
      }
      nearest.best = index;
      nearest.best_distance = distance;
    } else if (distance < nearest.second_distance && !here(nearest.best)) {
      nearest.second = index;
      nearest.second_distance = distance;
    }
  }
};

/// Right points that pass constraints (1) to (4) for a left one: all of them, or those that best-bin-first search
/// examines.
class CandidateSource {
 public:
  CandidateSource(const FeatureList& right, const StereoMatchParams& params, double row_gate_px)
      : right_(right), params_(params), row_gate_px_(row_gate_px), rows_(right.keypoints) {
    if (params.bbf_leaves > 0) {
      tree_.emplace(right.descriptors, params.metric, BbfParams{.max_leaves = params.bbf_leaves});
    }
  }

  /// Calls visit(right index, distance of the descriptors) for every one.
  template <class Visit>
  void for_each(const Keypoint& left, const Descriptor& descriptor, const Visit& visit) const {
    if (!tree_) {
      rows_.near(left.v_px, row_gate_px_, [&](int index) {
        const auto r = static_cast<std::size_t>(index);
        if (may_match(left, right_.keypoints[r], params_)) {
          visit(index, descriptor_distance(descriptor, right_.descriptors[r], params_.metric));
        }
      });
      return;
    }
    // By counting only points within the gate matter; otherwise the second best does, however far it is.
    const std::uint32_t reach =
        params_.paper_uniqueness ? byte_distance(params_.max_distance, params_.metric) : NearestTwo::kFar - 1;
    for (const NearCandidate& near : tree_->within(descriptor, reach)) {
      const Keypoint& right = right_.keypoints[static_cast<std::size_t>(near.index)];
      const double rows_px = std::abs(static_cast<double>(right.v_px) - static_cast<double>(left.v_px));
      if (rows_px < row_gate_px_ && may_match(left, right, params_)) {
        visit(near.index, near.distance);
      }
    }
  }

 private:
  const FeatureList& right_;
  const StereoMatchParams& params_;
  double row_gate_px_;
  RowIndex rows_;
  std::optional<BbfTree> tree_;
};

}  // namespace

std::vector<FeatureMatch> match_by_descriptor(const FeatureList& left, const FeatureList& right,
                                              const StereoMatchParams& params) {
  if (params.bbf_leaves == 0) {
    return match_mutually(left.descriptors, right.descriptors,
                          {params.metric, params.max_distance, params.paper_uniqueness ? 1.0 : params.max_ratio});
  }
  const std::uint32_t gate = byte_distance(params.max_distance, params.metric);
  const auto nearest = nearest_two(left.descriptors, right.descriptors, params.metric, params.bbf_leaves);
  std::vector<FeatureMatch> matches;
  for (std::size_t l = 0; l < nearest.size(); ++l) {
    if (nearest[l].best == NearestTwo::kNone || nearest[l].best_distance > gate) {
      continue;
    }
    // Orientations of one position follow each other: it counts once.
    const bool repeated = !matches.empty() &&
                          same_place(left.keypoints[l], left.keypoints[static_cast<std::size_t>(matches.back().first)]);
    if (!repeated) {
      matches.push_back({static_cast<int>(l), nearest[l].best});
    }
  }
  return matches;
}

std::vector<FeatureMatch> match_stereo(const FeatureList& left, const FeatureList& right,
                                       const StereoMatchParams& params, double row_gate_px) {
  const CandidateSource candidates(right, params, row_gate_px);
  const std::uint32_t gate = byte_distance(params.max_distance, params.metric);
  std::vector<Candidates> forth(left.size());
  std::vector<Candidates> back(right.size());
  for (std::size_t l = 0; l < left.size(); ++l) {
    candidates.for_each(left.keypoints[l], left.descriptors[l], [&](int r, std::uint32_t distance) {
      forth[l].offer(r, distance, gate, right.keypoints);
      back[static_cast<std::size_t>(r)].offer(static_cast<int>(l), distance, gate, left.keypoints);
    });
  }
  const auto clear = [&](const NearestTwo& n) {
    return is_distinct(n.best_distance, n.second_distance, params.metric, params.max_ratio);
  };
  std::vector<FeatureMatch> matches;
  for (std::size_t l = 0; l < left.size(); ++l) {
    const NearestTwo& f = forth[l].nearest;
    if (f.best == NearestTwo::kNone || f.best_distance > gate) {
      continue;
    }
    const NearestTwo& b = back[static_cast<std::size_t>(f.best)].nearest;
    const bool mutual = b.best == static_cast<std::int32_t>(l) && clear(f) && clear(b);
    // Orientations of one place follow each other; its first that matches stands for it, so that the next picture of
    // the place likely gives the same one.
    const bool repeated = !matches.empty() &&
                          same_place(left.keypoints[l], left.keypoints[static_cast<std::size_t>(matches.back().first)]);
    if (!repeated && (params.paper_uniqueness ? forth[l].places_within_gate == 1 : mutual)) {
      matches.push_back({static_cast<int>(l), f.best});
    }
  }
  return matches;
}

}  // namespace seeker::vision
