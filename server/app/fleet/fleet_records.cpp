#include "server/app/fleet/fleet_records.hpp"

#include "common/wire/convert.hpp"
#include "common/wire/fleet_fields.hpp"

namespace seeker::app {
namespace {

/// More than any parameters of a merger give.
constexpr std::size_t kMaxHypotheses = 64;
constexpr std::size_t kMaxRelations = 1024;
constexpr int kVerdicts = static_cast<int>(fleet::MergeVerdict::kMerged) + 1;

void write_pose(const UncertainPose& from, v1::KeptPose* to) {
  wire::write(from.a_T_b, to->mutable_a_t_b());
  wire::write_covariance(from.covariance, to->mutable_covariance());
}

void read_pose(const v1::KeptPose& from, UncertainPose& to, wire::Check& check) {
  wire::read(from.a_t_b(), to.a_T_b, check);
  wire::read_covariance(from.covariance(), to.covariance, check);
}

void write_relation(const fleet::NodeRelation& from, v1::KeptRelation* to) {
  to->set_node_a(from.node_a);
  to->set_node_b(from.node_b);
  write_pose(from.a_T_b, to->mutable_pose());
  to->set_overlap(from.overlap);
  to->set_consistency(from.consistency);
  to->set_similarity(from.similarity);
  to->set_residual_m(from.residual_m);
}

void read_relation(const v1::KeptRelation& from, fleet::NodeRelation& to, wire::Check& check) {
  to.node_a = from.node_a();
  to.node_b = from.node_b();
  read_pose(from.pose(), to.a_T_b, check);
  to.overlap = check.finite("overlap", from.overlap());
  to.consistency = check.finite("consistency", from.consistency());
  to.similarity = check.finite("similarity", from.similarity());
  to.residual_m = check.finite("residual_m", from.residual_m());
}

void write_hypothesis(const fleet::MergeHypothesis& from, v1::KeptHypothesis* to) {
  write_pose(from.a_T_b, to->mutable_pose());
  wire::write(from.shared_middle_b, to->mutable_shared_middle_b());
  for (const fleet::NodeRelation& pair : from.pairs) {
    write_relation(pair, to->add_relations());
  }
  to->set_shared_wall_m(from.shared_wall_m);
  to->set_weak_wall_m(from.weak_wall_m);
  to->set_contradiction(from.contradiction);
  to->set_residual_m(from.residual_m);
  to->set_confidence(from.confidence);
  to->set_denied_piece_m(from.denied_piece_m);
  to->set_places_alike(static_cast<std::uint32_t>(from.pictures.alike));
  to->set_places_unlike(static_cast<std::uint32_t>(from.pictures.unlike));
}

void read_hypothesis(const v1::KeptHypothesis& from, fleet::MergeHypothesis& to, wire::Check& check) {
  if (!check.count("relations", static_cast<std::size_t>(from.relations_size()), kMaxRelations)) {
    return;
  }
  read_pose(from.pose(), to.a_T_b, check);
  wire::read(from.shared_middle_b(), to.shared_middle_b, check);
  for (int k = 0; k < from.relations_size(); ++k) {
    const auto scope = check.in("relations", static_cast<std::size_t>(k));
    read_relation(from.relations(k), to.pairs.emplace_back(), check);
  }
  to.shared_wall_m = check.finite("shared_wall_m", from.shared_wall_m());
  to.weak_wall_m = check.finite("weak_wall_m", from.weak_wall_m());
  to.contradiction = check.finite("contradiction", from.contradiction());
  to.residual_m = check.finite("residual_m", from.residual_m());
  to.confidence = check.finite("confidence", from.confidence());
  to.denied_piece_m = check.finite("denied_piece_m", from.denied_piece_m());
  to.pictures = {from.places_alike(), from.places_unlike()};
}

}  // namespace

void write(const fleet::MergeAnswer& from, v1::KeptPair* to) {
  to->set_verdict(static_cast<std::uint32_t>(wire::wire_enum(from.verdict)));
  to->set_reason(wire::clean_text(from.reason));
  for (const fleet::MergeHypothesis& hypothesis : from.hypotheses) {
    write_hypothesis(hypothesis, to->add_hypotheses());
  }
}

Result<fleet::MergeAnswer> read_answer(const v1::KeptPair& from) {
  wire::Check check;
  fleet::MergeAnswer answer;
  if (from.verdict() < 1 || from.verdict() > kVerdicts) {
    return fail(Errc::kInvalidArgument, "a verdict is none of ours");
  }
  answer.verdict = static_cast<fleet::MergeVerdict>(from.verdict() - 1);
  answer.reason = check.text("reason", from.reason());
  if (check.count("hypotheses", static_cast<std::size_t>(from.hypotheses_size()), kMaxHypotheses)) {
    for (int k = 0; k < from.hypotheses_size(); ++k) {
      const auto scope = check.in("hypotheses", static_cast<std::size_t>(k));
      read_hypothesis(from.hypotheses(k), answer.hypotheses.emplace_back(), check);
    }
  }
  if (answer.merged() && answer.hypotheses.empty()) {
    check.refuse("hypotheses", Errc::kInvalidArgument, "says nothing of how the maps are merged");
  }
  return check.ok() ? Result<fleet::MergeAnswer>(std::move(answer))
                    : Result<fleet::MergeAnswer>(tl::unexpected<Error>(check.status().error()));
}

std::vector<api::Detection> read_found(const DetectionField& kept, const std::string& robot_id,
                                       const ReportDamage& report_damage) {
  std::vector<api::Detection> found;
  wire::Check check;
  wire::read_detections(kept, found, check);
  if (!check.ok()) {
    report_damage("what robot '" + robot_id + "' had found cannot be read again: " + check.status().error().message);
    return {};
  }
  return found;
}

}  // namespace seeker::app
