#include "server/fleet/fleet_merge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/core/angle.hpp"

namespace seeker::fleet {
namespace {

/// Pose of robot `to` in the frame of robot `from`, where a merged pair says so.
std::optional<Pose2> motion_of(const PairAnswer& pair, std::uint8_t from, std::uint8_t to) {
  const Pose2& a_T_b = pair.answer.hypotheses.front().a_T_b.a_T_b;
  if (pair.slot_a == from && pair.slot_b == to) {
    return a_T_b;
  }
  if (pair.slot_a == to && pair.slot_b == from) {
    return inverse(a_T_b);
  }
  return std::nullopt;
}

/// The other robot of both pairs, where they have one in common.
std::optional<std::uint8_t> third_of(const PairAnswer& first, const PairAnswer& second) {
  for (const std::uint8_t own : {first.slot_a, first.slot_b}) {
    if (own == second.slot_a || own == second.slot_b) {
      return own;
    }
  }
  return std::nullopt;
}

std::uint8_t other_of(const PairAnswer& pair, std::uint8_t slot) {
  return pair.slot_a == slot ? pair.slot_b : pair.slot_a;
}

/// Do the three close? Pairs that are no triangle do.
bool closes(const std::array<const PairAnswer*, 3>& pairs, const CycleParams& params) {
  const auto common = third_of(*pairs[0], *pairs[1]);
  if (!common) {
    return true;
  }
  const std::uint8_t a = other_of(*pairs[0], *common);
  const std::uint8_t c = other_of(*pairs[1], *common);
  const std::optional<Pose2> straight = motion_of(*pairs[2], a, c);
  if (a == c || !straight) {
    return true;
  }
  const Pose2 around = *motion_of(*pairs[0], a, *common) * *motion_of(*pairs[1], *common, c);
  // Far from where the maps overlap a small rotation is a large displacement: the gap is measured at that place.
  const MergeHypothesis& there = pairs[2]->answer.hypotheses.front();
  const Point2 p_b = there.shared_middle_b;
  const Point2 p_c = pairs[2]->slot_b == c ? p_b : there.a_T_b.a_T_b * p_b;
  return (around * p_c - *straight * p_c).norm() <= params.max_gap_m &&
         std::abs(wrap_angle(around.theta_rad - straight->theta_rad)) <= params.max_gap_rad;
}

/// The least confident pair of the first three that do not close.
PairAnswer* weakest_of_open(std::vector<PairAnswer>& pairs, const CycleParams& params) {
  std::vector<PairAnswer*> merged;
  merged.reserve(pairs.size());
  for (PairAnswer& pair : pairs) {
    if (pair.answer.merged()) {
      merged.push_back(&pair);
    }
  }
  for (std::size_t i = 0; i < merged.size(); ++i) {
    for (std::size_t j = i + 1; j < merged.size(); ++j) {
      for (std::size_t k = j + 1; k < merged.size(); ++k) {
        if (!closes({merged[i], merged[j], merged[k]}, params)) {
          return *std::min_element(merged.begin(), merged.end(), [&](const PairAnswer* p, const PairAnswer* q) {
            const auto in = [&](const PairAnswer* pair) {
              return pair == merged[i] || pair == merged[j] || pair == merged[k];
            };
            return in(p) != in(q) ? in(p) : p->answer.confidence() < q->answer.confidence();
          });
        }
      }
    }
  }
  return nullptr;
}

}  // namespace

void demote_open_cycles(std::vector<PairAnswer>& pairs, const CycleParams& params) {
  while (PairAnswer* weakest = weakest_of_open(pairs, params)) {
    weakest->answer.verdict = MergeVerdict::kContradicted;
    weakest->answer.reason = "the cycle over a third robot does not close, and this pair is its least certain one";
  }
}

std::vector<MapRelation> relations_of(const std::vector<PairAnswer>& pairs) {
  std::vector<MapRelation> relations;
  for (const PairAnswer& pair : pairs) {
    if (pair.answer.merged()) {
      relations.push_back({pair.slot_a, pair.slot_b, pair.answer.hypotheses.front().pairs});
    }
  }
  return relations;
}

}  // namespace seeker::fleet
