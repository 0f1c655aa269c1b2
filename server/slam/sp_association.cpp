#include "server/slam/sp_association.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "server/slam/sp_joint_search.hpp"

namespace seeker::slam {
namespace {

using lines::SegmentObservation;

using Innovation = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

double d2_of(const RowGroup& group, const Innovation& s) { return group.f.dot(s.ldlt().solve(group.f)); }

/// Of the shorter of two observations of one segment that may overlap without being two claims to it.
constexpr double kTouch_m = 0.05;

/// What culling needs of an observation: bounds that no pair within the near gate exceeds.
struct Cull {
  Pose2 map_T_observation;
  Point2 tangent;
  double variance = 0.0;  ///< of y: part of robot and observation
};

Cull cull_of(const SpState& state, const SegmentObservation& observation) {
  Cull cull;
  cull.map_T_observation = state.map_T_base * observation.base_T_segment;
  cull.tangent = {std::cos(cull.map_T_observation.theta_rad), std::sin(cull.map_T_observation.theta_rad)};
  const double lever_m = observation.base_T_segment.translation().norm();
  // |a + b + c|^2 <= 3 (|a|^2 + |b|^2 + |c|^2), for the robot's position and heading and the observation.
  const double position = state.p(0, 0) + state.p(1, 1);
  cull.variance = 3.0 * (position + lever_m * lever_m * state.p(2, 2) + observation.covariance(0, 0));
  return cull;
}

/// Cheap test without matrices: distance, direction, then the two coordinates of the mid-point.
bool may_pair(const SpState& state, std::size_t segment, const Cull& cull, double observed_length_m, double reach_m,
              double min_cosine) {
  const SpSegment& f = state.segments[segment];
  const Point2 d = cull.map_T_observation.translation() - f.map_T_segment.translation();
  const double half_m = 0.5 * (f.length_m + observed_length_m) + reach_m;
  const Index at = state.records[segment].at;
  const double own = state.p(at, at) + half_m * half_m * state.p(at + 1, at + 1);
  const double most_y2 = state.params.association.near_gate * 2.0 * (cull.variance + 2.0 * own);
  if (d.squaredNorm() > half_m * half_m + most_y2) {
    return false;
  }
  const Point2 tangent(std::cos(f.map_T_segment.theta_rad), std::sin(f.map_T_segment.theta_rad));
  const double y_m = tangent.x() * d.y() - tangent.y() * d.x();
  return tangent.dot(cull.tangent) >= min_cosine && std::abs(tangent.dot(d)) <= half_m && y_m * y_m <= most_y2;
}

/// Overlap test of S1.6; false: they lie apart.
bool lies_on(const SpState& state, PairCandidate& pair, const SegmentObservation& observation) {
  const SpSegment& f = state.segments[pair.segment];
  const SpAssociationParams& params = state.params.association;
  pair.low_m = pair.geometry.end_x_m(lines::kLeft, observation.length_m);
  pair.high_m = pair.geometry.end_x_m(lines::kRight, observation.length_m);
  const double half_m = 0.5 * f.length_m;
  const double overlap_m = std::min(pair.high_m, half_m) - std::max(pair.low_m, -half_m);
  const double shorter_m = std::min(pair.high_m - pair.low_m, f.length_m);
  pair.apart = 1.0 - std::clamp(shorter_m > 0.0 ? overlap_m / shorter_m : 0.0, 0.0, 1.0);
  if (overlap_m >= 0.0) {
    return true;
  }
  const double variance = (pair.geometry.robot_x * state.p.block(0, kRobotRows) * pair.geometry.robot_x.transpose())(0);
  pair.beside = -overlap_m > params.real_gap_sigmas * std::sqrt(std::max(variance, 0.0));
  const std::size_t facing = pair.geometry.x_m < 0.0 ? lines::kLeft : lines::kRight;
  if (!f.real[facing]) {
    return -overlap_m <= params.virtual_gap_m;
  }
  const Index end = state.records[pair.segment].at + state.rows_of(pair.segment).end(facing);
  return -overlap_m <=
         params.real_gap_m + params.real_gap_sigmas * std::sqrt(std::max(variance + state.p(end, end), 0.0));
}

/// Half the touch allowed to two observations of one segment, off either end.
JointItem::Option option_of(const SpState& state, const PairCandidate& pair, const SegmentObservation& observation) {
  JointItem::Option option;
  option.group = rows_of_pair(state, pair, observation, {});
  option.segment = pair.segment;
  const double touch_m = std::min(kTouch_m, 0.25 * observation.length_m);
  option.low_m = pair.low_m + touch_m;
  option.high_m = pair.high_m - touch_m;
  option.penalty = state.params.association.apart_penalty * pair.apart;
  return option;
}

/// Whether what lies beside the segment may be more of it: SpFeatureParams::merge_sigma_m.
bool may_go_on(const PairCandidate& pair, const SpFeatureParams& params) {
  const bool beside = pair.apart > 0.5 && params.merge_sigma_m > 0.0;
  return !beside || (pair.sigma_m <= params.merge_sigma_m && pair.d2 <= params.merge_gate);
}

/// Everything the joint search decides on, the clear ones first.
struct Problem {
  std::vector<JointItem> items;
  std::vector<std::vector<PairCandidate>> candidates;  ///< per item
};

Problem make_problem(const SpState& state, const std::vector<SegmentObservation>& observations, double gate,
                     Association& association) {
  std::vector<std::vector<PairCandidate>> all;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    SpMatch& match = association.matches[k];
    if (!is_usable(observations[k])) {
      match.verdict = SpVerdict::kRejected;
      continue;
    }
    std::vector<PairCandidate> candidates = candidates_of(state, k, observations[k]);
    if (candidates.empty()) {
      continue;
    }
    match.verdict = SpVerdict::kRejected;
    match.d2 = candidates.front().d2;
    std::erase_if(candidates,
                  [&](const PairCandidate& c) { return c.d2 > gate || !may_go_on(c, state.params.features); });
    if (std::any_of(candidates.begin(), candidates.end(), [](const PairCandidate& c) { return c.apart < 0.5; })) {
      std::erase_if(candidates, [](const PairCandidate& c) { return c.beside; });
    }
    if (!candidates.empty()) {
      match.verdict = SpVerdict::kAmbiguous;
      all.push_back(std::move(candidates));
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() < b.size() : a.front().d2 < b.front().d2;
  });
  Problem problem;
  for (std::vector<PairCandidate>& candidates : all) {
    JointItem item;
    for (const PairCandidate& pair : candidates) {
      item.options.push_back(option_of(state, pair, observations[pair.observation]));
    }
    problem.items.push_back(std::move(item));
    problem.candidates.push_back(std::move(candidates));
  }
  return problem;
}

/// An endpoint row that may be used.
struct EndCandidate {
  std::size_t observation = 0;
  std::size_t side = 0;
  double d2 = 0.0;
  RowGroup group;
};

/// Whether the scan shows the segment's end wherever its beams fall. Asked of where the map has the end: asked of the
/// observed one, those that are read too long would be left out, and the others pull the robot along.
bool is_end_clear(const SpSegment& segment, const PairCandidate& pair, const SegmentObservation& observation,
                  std::size_t side) {
  const double end_x_m = 0.5 * end_sign(side) * segment.length_m;
  return std::abs(end_x_m - pair.geometry.x_m - observation.foot_x_m) <= observation.clear_m;
}

std::vector<EndCandidate> end_candidates(const SpState& state, const PairCandidate& pair,
                                         const SegmentObservation& observation) {
  std::vector<EndCandidate> ends;
  for (std::size_t side = 0; side < 2; ++side) {
    const SpSegment& segment = state.segments[pair.segment];
    if (!observation.real[side] || !segment.real[side] || !is_end_clear(segment, pair, observation, side) ||
        !state.is_end_news(pair.segment, side, observation.beam_step_rad)) {
      continue;
    }
    RowChoice choice{.line = false, .ends = {}};
    choice.ends[side] = true;
    EndCandidate end{pair.observation, side, 0.0, rows_of_pair(state, pair, observation, choice)};
    end.d2 = group_d2(state.p, end.group);
    if (end.d2 <= state.params.association.end_gate) {
      ends.push_back(std::move(end));
    }
  }
  return ends;
}

/// Ends that agree with the lines and with one another when `first` is believed before all others; as a list.
std::vector<std::size_t> agreeing_ends(JointInnovation& joint, const std::vector<EndCandidate>& ends, std::size_t first,
                                       double gate) {
  std::vector<std::size_t> taken;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const std::size_t index = k == 0 ? first : (k <= first ? k - 1 : k);
    if (joint.push(ends[index].group) <= gate) {
      taken.push_back(index);
    } else {
      joint.pop();
    }
  }
  return taken;
}

/// Chooses the endpoint rows: given the lines each must be within its own gate. When some disagree, the largest
/// agreeing set over all first choices.
void choose_ends(const SpState& state, const std::vector<RowGroup>& line_groups, std::vector<EndCandidate> ends,
                 Association& association) {
  std::stable_sort(ends.begin(), ends.end(), [](const auto& a, const auto& b) { return a.d2 < b.d2; });
  JointInnovation joint(state.p);
  for (const RowGroup& group : line_groups) {
    joint.push(group);
  }
  std::vector<std::size_t> best;
  for (std::size_t first = 0; first < ends.size() && best.size() < ends.size() - first; ++first) {
    std::vector<std::size_t> taken = agreeing_ends(joint, ends, first, state.params.association.end_gate);
    for (std::size_t k = 0; k < taken.size(); ++k) {
      joint.pop();
    }
    if (taken.size() > best.size()) {
      best = std::move(taken);
    }
  }
  for (const std::size_t index : best) {
    joint.push(ends[index].group);
    association.matches[ends[index].observation].ends[ends[index].side] = true;
  }
  association.joint_d2 = joint.d2();
  association.dof = joint.dof();
}

void accept(const SpState& state, const PairCandidate& pair, Association& association) {
  SpMatch& match = association.matches[pair.observation];
  match.verdict = SpVerdict::kPaired;
  match.segment = state.segments[pair.segment].id;
  match.d2 = pair.d2;
}

/// The largest set of pairs, each within `gate`, that agree to within the quantile of `sigmas`.
Association associate_within(const SpState& state, const std::vector<SegmentObservation>& observations, double gate,
                             double sigmas) {
  Association association;
  association.matches.resize(observations.size());
  const Problem problem = make_problem(state, observations, gate, association);
  const JointChoice choice = search_joint(state.p, problem.items, sigmas, state.params.association.max_nodes);
  association.nodes = choice.nodes;
  association.capped = choice.capped;
  std::vector<RowGroup> line_groups;
  std::vector<EndCandidate> ends;
  for (std::size_t k = 0; k < problem.items.size(); ++k) {
    if (choice.option[k] < 0) {
      continue;
    }
    const auto option = static_cast<std::size_t>(choice.option[k]);
    const PairCandidate& pair = problem.candidates[k][option];
    accept(state, pair, association);
    line_groups.push_back(problem.items[k].options[option].group);
    for (EndCandidate& end : end_candidates(state, pair, observations[pair.observation])) {
      ends.push_back(std::move(end));
    }
  }
  choose_ends(state, line_groups, std::move(ends), association);
  return association;
}

std::ptrdiff_t count(const Association& association, SpVerdict verdict) {
  return std::count_if(association.matches.begin(), association.matches.end(),
                       [&](const SpMatch& match) { return match.verdict == verdict; });
}

/// Of the observations that are near a segment.
bool most_are_paired(const Association& association) {
  return count(association, SpVerdict::kPaired) >= count(association, SpVerdict::kRejected);
}

}  // namespace

std::vector<PairCandidate> candidates_of(const SpState& state, std::size_t index,
                                         const SegmentObservation& observation) {
  const SpAssociationParams& params = state.params.association;
  const Cull cull = cull_of(state, observation);
  const double min_cosine = std::cos(params.max_angle_rad);
  const double along_m = params.real_gap_sigmas * std::sqrt(cull.variance + 1.0);
  const double reach_m = std::max(params.virtual_gap_m, params.real_gap_m + along_m);
  std::vector<PairCandidate> found;
  for (std::size_t k = 0; k < state.segments.size(); ++k) {
    if (!may_pair(state, k, cull, observation.length_m, reach_m, min_cosine)) {
      continue;
    }
    PairCandidate pair;
    pair.observation = index;
    pair.segment = k;
    pair.geometry = pair_geometry(state.segments[k].map_T_segment, state.map_T_base, observation.base_T_segment);
    if (!lies_on(state, pair, observation)) {
      continue;
    }
    const RowGroup group = rows_of_pair(state, pair, observation, {});
    const Innovation s = innovation_covariance(state.p, group, group);
    pair.d2 = d2_of(group, s);
    pair.sigma_m = std::sqrt(std::max(0.0, s(0, 0)));
    if (pair.d2 <= params.near_gate) {
      found.push_back(pair);
    }
  }
  std::stable_sort(found.begin(), found.end(), [&](const PairCandidate& a, const PairCandidate& b) {
    return a.d2 + params.apart_penalty * a.apart < b.d2 + params.apart_penalty * b.apart;
  });
  return found;
}

RowGroup rows_of_pair(const SpState& state, const PairCandidate& pair, const SegmentObservation& observation,
                      const RowChoice& choice) {
  const PairRows rows = pair_rows(pair.geometry, state.segments[pair.segment].length_m, observation.length_m);
  return row_group(rows, state.rows_of(pair.segment), pair.observation, observed_covariance(observation, state.params),
                   choice);
}

double group_d2(const SpCovariance& p, const RowGroup& group) {
  return d2_of(group, innovation_covariance(p, group, group));
}

Association associate_jointly(const SpState& state, const std::vector<SegmentObservation>& observations) {
  const SpAssociationParams& params = state.params.association;
  Association association = associate_within(state, observations, params.gate, params.joint_sigmas);
  if (most_are_paired(association)) {
    return association;
  }
  Association wider = associate_within(state, observations, params.near_gate, params.surprise_sigmas);
  const bool several = count(wider, SpVerdict::kPaired) > 1;
  return several && most_are_paired(wider) ? wider : association;
}

Association associate_nearest(const SpState& state, const std::vector<SegmentObservation>& observations) {
  Association association;
  association.matches.resize(observations.size());
  for (std::size_t k = 0; k < observations.size(); ++k) {
    SpMatch& match = association.matches[k];
    if (!is_usable(observations[k])) {
      match.verdict = SpVerdict::kRejected;
      continue;
    }
    const std::vector<PairCandidate> candidates = candidates_of(state, k, observations[k]);
    const auto nearest = std::min_element(candidates.begin(), candidates.end(),
                                          [](const auto& a, const auto& b) { return a.d2 < b.d2; });
    if (nearest == candidates.end()) {
      continue;
    }
    match.d2 = nearest->d2;
    if (nearest->d2 > state.params.association.nearest_gate) {
      continue;  // S1.8: what has no partner is new
    }
    accept(state, *nearest, association);
    association.joint_d2 += nearest->d2;
    association.dof += 2;
    for (const EndCandidate& end : end_candidates(state, *nearest, observations[k])) {
      match.ends[end.side] = true;
      association.joint_d2 += end.d2;
      association.dof += 1;
    }
  }
  return association;
}

}  // namespace seeker::slam
