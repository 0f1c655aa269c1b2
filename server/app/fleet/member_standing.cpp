#include "server/app/fleet/member_standing.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/app/fleet/fleet_slots.hpp"
#include "server/fleet/merge_memory.hpp"

namespace seeker::app {
namespace {

api::FleetState state_of(fleet::MergeVerdict verdict) {
  switch (verdict) {
    case fleet::MergeVerdict::kMerged: return api::FleetState::kMerged;
    case fleet::MergeVerdict::kAmbiguous: return api::FleetState::kAmbiguous;
    case fleet::MergeVerdict::kContradicted: return api::FleetState::kContradicted;
    case fleet::MergeVerdict::kInsufficientOverlap: return api::FleetState::kInsufficientOverlap;
  }
  return api::FleetState::kInsufficientOverlap;
}

api::FleetHypothesis as_api(const fleet::MergeHypothesis& from) {
  return {from.a_T_b.a_T_b,
          from.confidence,
          from.shared_wall_m,
          from.contradiction,
          static_cast<std::uint32_t>(from.pairs.size()),
          static_cast<std::uint32_t>(from.pictures.alike)};
}

/// What was found for two robots; null where they were not compared.
const fleet::MergeAnswer* answer_of(const std::vector<fleet::PairAnswer>& pairs, std::uint8_t one, std::uint8_t other) {
  const auto [a, b] = std::minmax(one, other);
  const auto pair = std::find_if(pairs.begin(), pairs.end(), [a = a, b = b](const fleet::PairAnswer& each) {
    return each.slot_a == a && each.slot_b == b;
  });
  return pair == pairs.end() ? nullptr : &pair->answer;
}

}  // namespace

MemberStanding::MemberStanding(bool split, const std::optional<Pose2>& accepted) : accepted_(accepted), split_(split) {
  if (split_) {
    state_ = api::FleetState::kSplit;
    reason_ = kSplitReason;
  }
}

void MemberStanding::begin_new_map() {
  unseen_map_ = true;
  trouble_.clear();
  main_T_map_.reset();  // reports in the new map must not be carried as if they were in the old one
  hypotheses_.clear();
  confidence_ = 0.0;
  merged_with_.reset();
  if (!split_) {
    state_ = api::FleetState::kWaiting;
    reason_ = "it has begun a new map, which has not been looked at yet";
  }
}

Status MemberStanding::decide(const api::FleetDecision& decision) {
  if (decision.verb == api::FleetVerb::kSplit) {
    split_ = true;
    accepted_.reset();
  } else if (split_ && decision.hypothesis == 0 && hypotheses_.empty()) {
    split_ = false;
  } else if (decision.hypothesis >= hypotheses_.size()) {
    return fail(Errc::kRefused, "there is no such way to lay its map; 'seeker fleet status' lists them");
  } else {
    split_ = false;
    // Where the merger is certain by itself, nothing rests on the operator's decision.
    const bool certain = decision.hypothesis == 0 && state_ == api::FleetState::kMerged;
    accepted_ = certain ? std::nullopt : std::optional<Pose2>(hypotheses_[decision.hypothesis].a_T_b.a_T_b);
  }
  state_ = split_ ? api::FleetState::kSplit : api::FleetState::kWaiting;
  reason_ = split_ ? kSplitReason : "its map is looked at once more";
  return {};
}

void MemberStanding::apply_acceptance(fleet::MergeAnswer& answer) {
  if (!accepted_) {
    return;
  }
  const auto same = std::find_if(answer.hypotheses.begin(), answer.hypotheses.end(),
                                 [&](const auto& one) { return fleet::same_place(one.a_T_b.a_T_b, *accepted_); });
  if (same == answer.hypotheses.end() || answer.verdict == fleet::MergeVerdict::kContradicted) {
    answer.verdict = fleet::MergeVerdict::kContradicted;
    answer.reason = "what was accepted does not fit what the robots have seen since: " + answer.reason;
    accepted_.reset();
    return;
  }
  std::rotate(answer.hypotheses.begin(), same, same + 1);
  answer.verdict = fleet::MergeVerdict::kMerged;
  answer.reason = "accepted by the operator";
}

bool MemberStanding::settle(std::uint8_t slot, const JoinOutcome& outcome,
                            const std::map<std::uint8_t, std::string>& names) {
  confidence_ = 0.0;
  merged_with_.reset();
  if (split_) {
    return set_state(api::FleetState::kSplit, kSplitReason);
  }
  hypotheses_.clear();
  const fleet::MergeAnswer* with_main = answer_of(outcome.pairs, kMainSlot, slot);
  if (!trouble_.empty() || with_main == nullptr) {
    return set_state(api::FleetState::kWaiting, trouble_.empty() ? reason_ : trouble_);
  }
  hypotheses_ = with_main->hypotheses;
  confidence_ = with_main->confidence();
  const auto link = outcome.links.find(slot);
  if (link == outcome.links.end()) {
    return set_state(state_of(with_main->verdict), with_main->reason);
  }
  if (!outcome.main_T_maps) {
    return set_state(api::FleetState::kAmbiguous, outcome.trouble);
  }
  const auto joined = outcome.main_T_maps->find(slot);
  if (joined == outcome.main_T_maps->end()) {
    return set_state(api::FleetState::kAmbiguous, "the other robots' maps outvote it");
  }
  main_T_map_ = joined->second;
  confidence_ = link->second.confidence;
  return set_merged(link->second.through, outcome.pairs, slot, names);
}

bool MemberStanding::set_merged(std::uint8_t through, const std::vector<fleet::PairAnswer>& pairs, std::uint8_t slot,
                                const std::map<std::uint8_t, std::string>& names) {
  const fleet::MergeAnswer* merge = answer_of(pairs, through, slot);
  assert(merge != nullptr && merge->merged() && "links are made of merged pairs");
  const auto alike = static_cast<std::uint32_t>(merge->hypotheses.front().pictures.alike);
  merged_with_ = {through == kMainSlot ? "" : names.at(through), alike};
  return set_state(api::FleetState::kMerged, through == kMainSlot
                                                 ? merge->reason
                                                 : "merged with the map of robot '" + merged_with_->through +
                                                       "', which leads to the main one's: " + merge->reason);
}

bool MemberStanding::set_state(api::FleetState state, std::string reason) {
  const bool changed = state_ != state;
  state_ = state;
  reason_ = std::move(reason);
  return changed;
}

std::optional<Pose2> MemberStanding::main_T_map() const {
  return state_ == api::FleetState::kMerged ? main_T_map_ : std::nullopt;
}

void MemberStanding::describe(api::FleetMember& out) const {
  out.state = state_;
  out.reason = reason_;
  out.by_operator = accepted_.has_value();
  for (const fleet::MergeHypothesis& hypothesis : hypotheses_) {
    out.hypotheses.push_back(as_api(hypothesis));
  }
  out.confidence = confidence_;
  out.merged_with = merged_with_;
  out.main_T_map = main_T_map();
}

}  // namespace seeker::app
