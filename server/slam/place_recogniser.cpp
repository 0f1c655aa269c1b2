#include "server/slam/place_recogniser.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <Eigen/LU>

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

/// With larger cells, and a field that is still wider than a cell.
PyramidParams coarser(PyramidParams params, double max_cell_m) {
  constexpr double kStep = 1.5;
  constexpr double kSigmaCells = 0.8;
  constexpr double kReachCells = 2.0;
  params.resolution_m = std::min(kStep * params.resolution_m, max_cell_m);
  params.sigma_m = std::max(params.sigma_m, kSigmaCells * params.resolution_m);
  params.reach_m = std::max(params.reach_m, kReachCells * params.resolution_m);
  return params;
}

/// Of a place that leads, but by too little for a verdict: the share of what is asked for.
double weight_of(double fit, double lead, std::size_t cells, const JudgeParams& params) {
  const bool explains = fit >= params.min_certainty - params.min_lead;
  if (!explains || lead < params.weak_lead) {
    return 0.0;
  }
  return std::min({1.0, lead / params.min_lead, lead * static_cast<double>(cells) / params.min_lead_cells});
}

}  // namespace

PlaceMap::PlaceMap(LikelihoodPyramid pyramid, std::unique_ptr<ReferenceCloud> cloud, FreeSpace free_space)
    : pyramid_(std::move(pyramid)), cloud_(std::move(cloud)), free_space_(std::move(free_space)) {}

Result<PlaceMap> PlaceMap::build(const std::vector<SeenPoints>& seen_map, const PlaceMapParams& params) {
  const std::vector<OrientedPoint> points =
      thin_by_cells(all_points(seen_map), params.cloud_cell_m, std::numeric_limits<std::size_t>::max());
  PyramidParams used = params.pyramid;
  auto pyramid = LikelihoodPyramid::build(points, used);
  while (!pyramid && pyramid.error().code == Errc::kTooLarge && used.resolution_m < params.max_cell_m) {
    used = coarser(used, params.max_cell_m);
    pyramid = LikelihoodPyramid::build(points, used);
  }
  if (!pyramid) {
    return tl::unexpected<Error>(pyramid.error());
  }
  PlaceMap map(*std::move(pyramid), std::make_unique<ReferenceCloud>(points), FreeSpace(seen_map, params.free_space));
  map.detail_ = params.pyramid;
  if (used.resolution_m > params.pyramid.resolution_m) {
    map.points_ = points;
  }
  return map;
}

std::optional<LikelihoodPyramid> PlaceMap::detail_about(const Point2& p_map, double range_m) const {
  std::vector<OrientedPoint> near;
  std::copy_if(points_.begin(), points_.end(), std::back_inserter(near),
               [&](const OrientedPoint& point) { return (point.p - p_map).norm() <= range_m; });
  if (near.empty()) {
    return std::nullopt;
  }
  auto detail = LikelihoodPyramid::build(near, detail_);
  return detail ? std::optional(*std::move(detail)) : std::nullopt;
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
    const bool unseen = best.fit.all >= params.min_fit && best.agreement.disagreement() <= params.max_through;
    answer.reason = unseen ? "much of what is seen lies where the map shows nothing; drive to where it has been made"
                           : "the points contradict even the best place";
    return answer;
  }
  const double fit = 0.5 * (best.fit.all + best.fit.standing);
  const double certainty = fit + answer.lead;
  answer.verdict = PlaceVerdict::kAmbiguous;
  if (best.match.degenerate_direction) {
    answer.reason = "the points say nothing along one direction, as in a corridor";
    answer.says_nothing = true;
  } else if (answer.lead < params.min_lead || certainty < params.min_certainty) {
    answer.reason = "another place fits nearly as well";
    answer.weight = weight_of(fit, answer.lead, cells, params);
  } else if (answer.lead * static_cast<double>(cells) < params.min_lead_cells) {
    answer.reason = "too little was observed to distinguish this place from others";
    answer.says_nothing = true;
    answer.weight = weight_of(fit, answer.lead, cells, params);
  } else {
    answer.verdict = PlaceVerdict::kUnique;
    answer.weight = 1.0;
    answer.reason = "one place fits far better than any other";
  }
  return answer;
}

PlaceRecogniser::PlaceRecogniser(const PlaceParams& params)
    : params_(params), search_(params.search), matcher_(params.match) {}

/// Scans as the steps of a search need them.
struct PlaceRecogniser::Query {
  const std::vector<SeenPoints>& seen;
  std::vector<OrientedPoint> points;
  std::vector<OrientedPoint> sparse;  ///< for the final match
  std::vector<OrientedPoint> cells;   ///< for the fit
  double reach_m = 0.0;               ///< of the farthest point from the base

  Query(const std::vector<SeenPoints>& seen_base, const PlaceParams& params)
      : seen(seen_base),
        points(all_points(seen_base)),
        sparse(thin_out(points, params.match_points)),
        cells(thin_by_cells(points, params.search.thin_cell_m, std::numeric_limits<std::size_t>::max())) {
    for (const OrientedPoint& point : points) {
      reach_m = std::max(reach_m, point.p.norm());
    }
  }
};

/// What a search in larger cells has found, by the cells of the detail.
Pose2 PlaceRecogniser::start_in(const LikelihoodPyramid& detail, const Query& query, const Pose2& coarse,
                                double cell_m) const {
  const double leaf_m = cell_m * (1 << params_.search.leaf_level);
  const GlobalSearchResult found =
      search_.search(detail, query.points, SearchWindow{coarse, leaf_m, params_.search.max_step_rad});
  return found.candidates.empty() ? coarse : found.candidates.front().map_T_base;
}

PlaceCandidate PlaceRecogniser::refine(const PlaceMap& map, const Query& query, const Pose2& start) const {
  constexpr double kMargin_m = 2.0;  // the match moves the points by less
  const auto detail = map.detail_about(start.translation(), query.reach_m + kMargin_m);
  const LikelihoodPyramid& field = detail ? *detail : map.pyramid();
  const double cell_m = map.pyramid().frame().resolution_m;
  PlaceCandidate candidate;
  candidate.match = matcher_.match(map.cloud(), query.sparse, detail ? start_in(*detail, query, start, cell_m) : start);
  const Pose2& pose = candidate.match.map_T_base;
  candidate.fit = fit_of(field, map.free_space(), query.cells, pose);
  candidate.agreement = agreement_of(field, map.free_space(), query.seen, pose, params_.agreement);
  return candidate;
}

/// Each place once.
std::vector<PlaceCandidate> PlaceRecogniser::refine_all(const PlaceMap& map, const Query& query,
                                                        const GlobalSearchResult& found) const {
  std::vector<PlaceCandidate> candidates;
  for (const GlobalCandidate& start : found.candidates) {
    PlaceCandidate candidate = refine(map, query, start.map_T_base);
    candidate.score = start.score;
    const bool known = std::any_of(candidates.begin(), candidates.end(), [&](const PlaceCandidate& other) {
      return same_place(other.match.map_T_base, candidate.match.map_T_base, params_.search);
    });
    if (!known && candidate.match.pairs >= params_.match.min_pairs) {
      candidates.push_back(std::move(candidate));
    }
  }
  return candidates;
}

PlaceAnswer PlaceRecogniser::locate(const PlaceMap& map, const std::vector<SeenPoints>& seen_base,
                                    const std::optional<SearchWindow>& window) const {
  const Query query(seen_base, params_);
  const GlobalSearchResult found = search_.search(map.pyramid(), query.points, window);
  PlaceAnswer answer = judge(refine_all(map, query, found), query.cells.size(), params_.judge);
  if (!found.complete && answer.weight > 0.0) {
    answer.verdict = PlaceVerdict::kAmbiguous;
    answer.reason = "a place fits, but the search was cut short before all others were excluded";
    answer.says_nothing = true;
    answer.weight = 0.0;
  }
  return answer;
}

bool PlaceRecogniser::agrees(const PlaceCandidate& candidate, const Pose2& map_T_base) const {
  return candidate.match.pairs >= params_.match.min_pairs && candidate.fit.all >= params_.kept.min_fit &&
         candidate.agreement.through <= params_.judge.max_through &&
         candidate.agreement.disagreement() <= params_.kept.max_disagreement &&
         distance_m(candidate.match.map_T_base, map_T_base) < params_.kept.max_m;
}

void PlaceRecogniser::accept(PlaceCandidate candidate, PlaceAnswer& answer) const {
  // Where a corridor says nothing, the place is known by where the robot stood.
  const double stood_m2 = params_.kept.sigma_m * params_.kept.sigma_m;
  const double stood_rad2 = params_.kept.sigma_rad * params_.kept.sigma_rad;
  const Matrix3 stood = Eigen::Vector3d(stood_m2, stood_m2, stood_rad2).asDiagonal();
  candidate.match.covariance = (candidate.match.covariance.inverse() + stood.inverse()).inverse();
  answer.verdict = PlaceVerdict::kUnique;
  answer.weight = 1.0;
  answer.candidates = {std::move(candidate)};
}

/// The places within the window, best first, with the lead of the best one.
PlaceAnswer PlaceRecogniser::ranked(const PlaceMap& map, const Query& query, const SearchWindow& window) const {
  PlaceAnswer answer;
  answer.cells = query.cells.size();
  answer.candidates = refine_all(map, query, search_.search(map.pyramid(), query.points, window));
  std::vector<PlaceCandidate>& places = answer.candidates;
  std::stable_sort(places.begin(), places.end(),
                   [](const PlaceCandidate& a, const PlaceCandidate& b) { return a.support() > b.support(); });
  answer.lead = places.size() > 1 ? places[0].support() - places[1].support() : 1.0;
  return answer;
}

bool PlaceRecogniser::agrees_near(const PlaceAnswer& near, const Pose2& map_T_base) const {
  return !near.candidates.empty() && agrees(near.candidates.front(), map_T_base) &&
         near.lead >= params_.kept.min_lead && !near.candidates.front().match.degenerate_direction;
}

bool PlaceRecogniser::stands_out(const PlaceAnswer& about) const {
  if (about.candidates.empty()) {
    return false;
  }
  const PlaceCandidate& best = about.candidates.front();
  return best.fit.all >= params_.kept.about_min_fit &&
         best.agreement.disagreement() <= params_.kept.about_max_disagreement &&
         about.lead >= params_.kept.about_min_lead &&
         about.lead * static_cast<double>(about.cells) >= params_.judge.min_lead_cells &&
         !best.match.degenerate_direction;
}

PlaceAnswer PlaceRecogniser::confirm(const PlaceMap& map, const std::vector<SeenPoints>& seen_base,
                                     const Pose2& map_T_base) const {
  const Query query(seen_base, params_);
  PlaceAnswer about = ranked(map, query, {map_T_base, params_.kept.about_m, kPi});
  const double best = about.candidates.empty() ? 0.0 : about.candidates.front().support();
  const auto outdone = [&](const PlaceCandidate& place) { return best >= place.support() + params_.kept.min_lead; };
  PlaceCandidate here = refine(map, query, map_T_base);
  if (agrees(here, map_T_base) && !outdone(here)) {
    PlaceAnswer answer;
    answer.cells = query.cells.size();
    answer.expected = true;
    answer.reason = "the robot stands where it was";
    accept(std::move(here), answer);
    return answer;
  }
  PlaceAnswer near = ranked(map, query, {map_T_base, params_.kept.max_m, params_.kept.max_rad});
  if (agrees_near(near, map_T_base) && !outdone(near.candidates.front())) {
    // In one view a corner is similar to the next one, a step and a rotation by 90 degrees on: others must agree.
    near.reason = "the robot stands near to where it was";
    accept(PlaceCandidate(near.candidates.front()), near);
    return near;
  }
  if (stands_out(about)) {
    about.verdict = PlaceVerdict::kUnique;
    about.weight = 1.0;
    about.reason = "one place about where the robot was fits far better than any other";
    return about;
  }
  about.reason = "the robot does not stand where it was";
  return about;
}

}  // namespace seeker::slam
