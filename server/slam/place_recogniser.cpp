#include "server/slam/place_recogniser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

std::vector<OrientedPoint> all_points(const std::vector<SeenPoints>& scans) {
  std::vector<OrientedPoint> points;
  for (const SeenPoints& seen : scans) {
    points.insert(points.end(), seen.points.begin(), seen.points.end());
  }
  return points;
}

bool same_place(const Pose2& a, const Pose2& b, const GlobalSearchParams& params) {
  return distance_m(a, b) < params.distinct_m && std::abs(wrap_angle(a.theta_rad - b.theta_rad)) < params.distinct_rad;
}

}  // namespace

PlaceMap::PlaceMap(LikelihoodPyramid pyramid, std::unique_ptr<ReferenceCloud> cloud, FreeSpace free_space)
    : pyramid_(std::move(pyramid)), cloud_(std::move(cloud)), free_space_(std::move(free_space)) {}

Result<PlaceMap> PlaceMap::build(const std::vector<SeenPoints>& seen_map, const PlaceMapParams& params) {
  const std::vector<OrientedPoint> points =
      thin_by_cells(all_points(seen_map), params.cloud_cell_m, std::numeric_limits<std::size_t>::max());
  auto pyramid = LikelihoodPyramid::build(points, params.pyramid);
  if (!pyramid) {
    return tl::unexpected<Error>(pyramid.error());
  }
  return PlaceMap(*std::move(pyramid), std::make_unique<ReferenceCloud>(points),
                  FreeSpace(seen_map, params.free_space));
}

std::string_view to_string(PlaceVerdict verdict) {
  switch (verdict) {
    case PlaceVerdict::kNone: return "none";
    case PlaceVerdict::kAmbiguous: return "ambiguous";
    case PlaceVerdict::kUnique: return "unique";
  }
  return "unknown";
}

PlaceAnswer judge(std::vector<PlaceCandidate> candidates, std::size_t cells, const JudgeParams& params) {
  PlaceAnswer answer;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const PlaceCandidate& a, const PlaceCandidate& b) { return a.support() > b.support(); });
  answer.candidates = std::move(candidates);
  answer.cells = cells;
  if (answer.candidates.empty()) {
    answer.reason = "no place of the map explains the points";
    return answer;
  }
  const PlaceCandidate& best = answer.candidates.front();
  answer.lead = best.fit.all;
  for (std::size_t k = 1; k < answer.candidates.size(); ++k) {
    const PlaceCandidate& rival = answer.candidates[k];
    const double through = std::max(0.0, rival.agreement.through - best.agreement.through);
    answer.lead = std::min(answer.lead, best.fit.all - rival.fit.all + params.through_weight * through);
  }
  if (best.fit.all < params.min_fit || best.fit.standing < params.min_standing ||
      best.agreement.through > params.max_through) {
    answer.reason = "the points contradict even the best place";
    return answer;
  }
  const double certainty = 0.5 * (best.fit.all + best.fit.standing) + answer.lead;
  answer.verdict = PlaceVerdict::kAmbiguous;
  if (best.match.degenerate_direction) {
    answer.reason = "the points say nothing along one direction, as in a corridor";
  } else if (answer.lead < params.min_lead || certainty < params.min_certainty) {
    answer.reason = "another place fits nearly as well";
  } else if (answer.lead * static_cast<double>(cells) < params.min_lead_cells) {
    answer.reason = "too little was seen to tell this place from others";
  } else {
    answer.verdict = PlaceVerdict::kUnique;
    answer.reason = "one place fits far better than any other";
  }
  return answer;
}

PlaceRecogniser::PlaceRecogniser(const PlaceParams& params)
    : params_(params), search_(params.search), matcher_(params.match) {}

PlaceAnswer PlaceRecogniser::locate(const PlaceMap& map, const std::vector<SeenPoints>& seen_base,
                                    const std::optional<SearchWindow>& window) const {
  const std::vector<OrientedPoint> points = all_points(seen_base);
  const GlobalSearchResult found = search_.search(map.pyramid(), points, window);
  const std::vector<OrientedPoint> sparse = thin_out(points, params_.match_points);
  const std::vector<OrientedPoint> cells =
      thin_by_cells(points, params_.search.thin_cell_m, std::numeric_limits<std::size_t>::max());
  std::vector<PlaceCandidate> candidates;
  for (const GlobalCandidate& start : found.candidates) {
    PlaceCandidate candidate;
    candidate.match = matcher_.match(map.cloud(), sparse, start.map_T_base);
    candidate.score = start.score;
    const Pose2& pose = candidate.match.map_T_base;
    const bool known = std::any_of(candidates.begin(), candidates.end(), [&](const PlaceCandidate& other) {
      return same_place(other.match.map_T_base, pose, params_.search);
    });
    if (!known && candidate.match.pairs >= params_.match.min_pairs) {
      candidate.fit = fit_of(map.pyramid(), map.free_space(), cells, pose);
      candidate.agreement = agreement_of(map.pyramid(), map.free_space(), seen_base, pose, params_.agreement);
      candidates.push_back(std::move(candidate));
    }
  }
  PlaceAnswer answer = judge(std::move(candidates), cells.size(), params_.judge);
  answer.complete = found.complete;
  return answer;
}

}  // namespace seeker::slam
