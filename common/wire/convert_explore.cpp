#include <algorithm>

#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

void write_candidate(const DecisionCandidate& from, pb::DecisionCandidate* to) {
  write(from.map_T_base, to->mutable_map_t_base());
  write(from.control, to->mutable_control());
  to->set_lg_j1(from.lg_j1);
  to->set_lg_j21(from.lg_j21);
  to->set_lg_j22(from.lg_j22);
  to->set_path_m(from.path_m);
  to->set_score(from.score);
  to->set_refused(clean_text(from.refused));
}

void read_candidate(const pb::DecisionCandidate& from, DecisionCandidate& to, Check& check) {
  read_required(from.has_map_t_base(), from.map_t_base(), to.map_T_base, "map_t_base", check);
  read_required(from.has_control(), from.control(), to.control, "control", check);
  to.lg_j1 = check.finite("lg_j1", from.lg_j1());
  to.lg_j21 = check.finite("lg_j21", from.lg_j21());
  to.lg_j22 = check.finite("lg_j22", from.lg_j22());
  to.path_m = check.finite("path_m", from.path_m());
  to.score = check.finite("score", from.score());
  to.refused = check.text("refused", from.refused());
}

}  // namespace

void write(const ExploreDecision& from, pb::ExploreDecision* to) {
  to->set_number(from.number);
  to->set_stamp_ns(from.stamp.time_since_epoch().count());
  to->set_rule(clean_text(from.rule, kMaxNameBytes));
  const std::size_t count = std::min(from.candidates.size(), kMaxDecisionCandidates);
  for (std::size_t k = 0; k < count; ++k) {
    write_candidate(from.candidates[k], to->add_candidates());
  }
  if (from.chosen && *from.chosen < count) {
    to->set_chosen(*from.chosen);
  }
  to->set_why(clean_text(from.why));
}

void read(const pb::ExploreDecision& from, ExploreDecision& to, Check& check) {
  to.number = from.number();
  to.stamp = RobotTime(Duration(from.stamp_ns()));
  to.rule = check.text("rule", from.rule(), kMaxNameBytes);
  if (!check.count("candidates", static_cast<std::size_t>(from.candidates_size()), kMaxDecisionCandidates)) {
    return;
  }
  to.candidates.resize(static_cast<std::size_t>(from.candidates_size()));
  for (std::size_t k = 0; k < to.candidates.size(); ++k) {
    const auto scope = check.in("candidates", k);
    read_candidate(from.candidates(static_cast<int>(k)), to.candidates[k], check);
  }
  if (from.has_chosen()) {
    if (from.chosen() >= to.candidates.size()) {
      check.refuse("chosen", Errc::kInvalidArgument, "is no index into the candidates");
      return;
    }
    to.chosen = from.chosen();
  }
  to.why = check.text("why", from.why());
}

}  // namespace seeker::wire
