#include "common/wire/convert_fleet.hpp"

#include <algorithm>

#include "common/wire/convert.hpp"
#include "common/wire/fleet_fields.hpp"
#include "common/wire/hash_field.hpp"

namespace seeker::wire {
namespace {

constexpr int kCovarianceRows = 3;

void read_node(const pb::FleetNode& from, api::FleetNode& to, Check& check) {
  to.node.id = from.id();
  read_required(from.has_map_t_node(), from.map_t_node(), to.node.map_T_node, "map_t_node", check);
  to.node.created = RobotTime(Duration(from.created_ns()));
  read_hash("sha256", from.sha256(), to.hash, check);
  to.piece_bytes = from.piece_bytes();
  if (to.piece_bytes == 0 || to.piece_bytes > api::kMaxFleetPieceBytes) {
    check.refuse("piece_bytes", Errc::kTooLarge, "must be from 1 to 8 MiB");
  }
}

void read_picture(const pb::FleetPicture& from, api::FleetPicture& to, Check& check) {
  read_hash("sha256", from.sha256(), to.hash, check);
  to.piece_bytes = from.piece_bytes();
  if (to.piece_bytes == 0 || to.piece_bytes > api::kMaxFleetPictureBytes) {
    check.refuse("piece_bytes", Errc::kTooLarge, "must be from 1 to 256 KiB");
  }
}

void write_edge(const MapEdge& from, pb::FleetEdge* to) {
  to->set_from(from.from);
  to->set_to(from.to);
  write(from.from_T_to, to->mutable_from_t_to());
  write_covariance(from.covariance, to->mutable_covariance());
  to->set_loop(from.loop);
  to->set_enabled(from.enabled);
}

void read_edge(const pb::FleetEdge& from, MapEdge& to, Check& check) {
  to.from = from.from();
  to.to = from.to();
  read_required(from.has_from_t_to(), from.from_t_to(), to.from_T_to, "from_t_to", check);
  read_covariance(from.covariance(), to.covariance, check);
  to.loop = from.loop();
  to.enabled = from.enabled();
}

void write_hypothesis(const api::FleetHypothesis& from, pb::FleetHypothesis* to) {
  write(from.main_T_map, to->mutable_main_t_map());
  to->set_confidence(from.confidence);
  to->set_shared_wall_m(from.shared_wall_m);
  to->set_contradiction(from.contradiction);
  to->set_pairs(from.pairs);
  to->set_pictures(from.pictures);
}

void read_hypothesis(const pb::FleetHypothesis& from, api::FleetHypothesis& to, Check& check) {
  read_required(from.has_main_t_map(), from.main_t_map(), to.main_T_map, "main_t_map", check);
  to.confidence = check.finite("confidence", from.confidence());
  to.shared_wall_m = check.finite("shared_wall_m", from.shared_wall_m());
  to.contradiction = check.finite("contradiction", from.contradiction());
  to.pairs = from.pairs();
  to.pictures = from.pictures();
}

void write_pose(const std::optional<Pose2>& from, pb::Pose2* (*field)(pb::FleetMember&), pb::FleetMember& to) {
  if (from) {
    write(*from, field(to));
  }
}

void read_pose(bool present, const pb::Pose2& from, std::optional<Pose2>& to, Check& check) {
  if (present) {
    to.emplace();
    read(from, *to, check);
  }
}

void write_merge(const api::FleetMergedWith& from, pb::FleetMergedWith* to) {
  to->set_through(from.through);
  to->set_pictures(from.pictures);
}

void read_merge(const pb::FleetMergedWith& from, api::FleetMergedWith& to, Check& check) {
  to.through = from.through().empty() ? std::string() : read_robot_id(from.through(), check);
  to.pictures = from.pictures();
}

void write_member(const api::FleetMember& from, pb::FleetMember* to) {
  to->set_robot_id(from.robot_id);
  to->set_state(static_cast<pb::FleetState>(wire_enum(from.state)));
  to->set_reason(clean_text(from.reason));
  to->set_confidence(from.confidence);
  to->set_by_operator(from.by_operator);
  to->set_linked(from.linked);
  to->set_nodes(from.nodes);
  to->set_pieces_missing(from.pieces_missing);
  to->set_pictures(from.pictures);
  for (const api::FleetHypothesis& hypothesis : from.hypotheses) {
    write_hypothesis(hypothesis, to->add_hypotheses());
  }
  if (from.merged_with) {
    write_merge(*from.merged_with, to->mutable_merged_with());
  }
  write_pose(
      from.main_T_map, [](pb::FleetMember& m) { return m.mutable_main_t_map(); }, *to);
  write_pose(
      from.main_T_base, [](pb::FleetMember& m) { return m.mutable_main_t_base(); }, *to);
  for (const Point2& place : from.places) {
    write(place, to->add_places());
  }
  write_detections(from.detections, to->mutable_detections());
}

void read_member(const pb::FleetMember& from, api::FleetMember& to, Check& check) {
  if (!check.count("hypotheses", static_cast<std::size_t>(from.hypotheses_size()), api::kMaxFleetHypotheses) ||
      !check.count("places", static_cast<std::size_t>(from.places_size()), api::kMaxFleetNodes)) {
    return;
  }
  to.robot_id = read_robot_id(from.robot_id(), check);
  check.enumerator("state", from.state(), api::FleetState::kSplit, to.state);
  to.reason = check.text("reason", from.reason());
  to.confidence = check.finite("confidence", from.confidence());
  to.by_operator = from.by_operator();
  to.linked = from.linked();
  to.nodes = from.nodes();
  to.pieces_missing = from.pieces_missing();
  to.pictures = from.pictures();
  for (const pb::FleetHypothesis& one : from.hypotheses()) {
    read_hypothesis(one, to.hypotheses.emplace_back(), check);
  }
  if (from.has_merged_with()) {
    read_merge(from.merged_with(), to.merged_with.emplace(), check);
  }
  read_pose(from.has_main_t_map(), from.main_t_map(), to.main_T_map, check);
  read_pose(from.has_main_t_base(), from.main_t_base(), to.main_T_base, check);
  for (const pb::Point2& place : from.places()) {
    Point2 p = Point2::Zero();
    read(place, p, check);
    to.places.push_back(p);
  }
  read_detections(from.detections(), to.detections, check);
}

}  // namespace

void write_covariance(const Matrix3& from, CovarianceField* to) {
  for (int row = 0; row < kCovarianceRows; ++row) {
    for (int column = 0; column < kCovarianceRows; ++column) {
      to->Add(from(row, column));
    }
  }
}

void read_covariance(const CovarianceField& from, Matrix3& to, Check& check) {
  if (from.size() != kCovarianceRows * kCovarianceRows) {
    check.refuse("covariance", Errc::kInvalidArgument, "does not have 9 numbers");
    return;
  }
  for (int k = 0; k < from.size(); ++k) {
    to(k / kCovarianceRows, k % kCovarianceRows) = check.finite("covariance", from[k]);
  }
}

void check_reach(const api::Detection& detection, Check& check) {
  if (check.ok() && !api::in_reach(detection)) {
    check.refuse("position", Errc::kInvalidArgument, "is out of reach, or its covariance is above 1e6 m^2");
  }
}

void write_detections(const std::vector<api::Detection>& from, DetectionField* to) {
  for (const api::Detection& detection : from) {
    write(detection, to->Add());
  }
}

void read_detections(const DetectionField& from, std::vector<api::Detection>& to, Check& check) {
  if (!check.count("detections", static_cast<std::size_t>(from.size()), api::kMaxFleetDetections)) {
    return;
  }
  for (int k = 0; k < from.size(); ++k) {
    const auto scope = check.in("detections", static_cast<std::size_t>(k));
    read(from[k], to.emplace_back(), check);
    check_reach(to.back(), check);
  }
}

std::string read_robot_id(const std::string& id, Check& check) {
  if (const Status valid = api::validate_robot_id(id); !valid) {
    check.refuse("robot_id", valid.error().code, valid.error().message);
    return {};
  }
  return id;
}

void write(const api::FleetManifest& from, pb::FleetManifest* to) {
  to->set_robot_id(from.robot_id);
  to->set_instance(from.instance);
  to->set_map_epoch(from.map_epoch);
  to->set_next_id(from.next_id);
  for (const api::FleetNode& node : from.nodes) {
    pb::FleetNode* one = to->add_nodes();
    one->set_id(node.node.id);
    write(node.node.map_T_node, one->mutable_map_t_node());
    one->set_created_ns(node.node.created.time_since_epoch().count());
    one->set_sha256(bytes_of(node.hash));
    one->set_piece_bytes(node.piece_bytes);
  }
  for (const MapEdge& edge : from.edges) {
    write_edge(edge, to->add_edges());
  }
  if (from.map_T_base) {
    write(*from.map_T_base, to->mutable_map_t_base());
  }
  for (const api::FleetPicture& picture : from.pictures) {
    pb::FleetPicture* one = to->add_pictures();
    one->set_sha256(bytes_of(picture.hash));
    one->set_piece_bytes(picture.piece_bytes);
  }
}

void read(const pb::FleetManifest& from, api::FleetManifest& to, Check& check) {
  if (!check.count("nodes", static_cast<std::size_t>(from.nodes_size()), api::kMaxFleetNodes) ||
      !check.count("edges", static_cast<std::size_t>(from.edges_size()), api::kMaxFleetEdges) ||
      !check.count("pictures", static_cast<std::size_t>(from.pictures_size()), api::kMaxFleetPictures)) {
    return;
  }
  to.robot_id = read_robot_id(from.robot_id(), check);
  to.instance = from.instance();
  to.map_epoch = from.map_epoch();
  to.next_id = from.next_id();
  for (int k = 0; k < from.nodes_size(); ++k) {
    const auto scope = check.in("nodes", static_cast<std::size_t>(k));
    read_node(from.nodes(k), to.nodes.emplace_back(), check);
  }
  for (int k = 0; k < from.edges_size(); ++k) {
    const auto scope = check.in("edges", static_cast<std::size_t>(k));
    read_edge(from.edges(k), to.edges.emplace_back(), check);
  }
  for (int k = 0; k < from.pictures_size(); ++k) {
    const auto scope = check.in("pictures", static_cast<std::size_t>(k));
    read_picture(from.pictures(k), to.pictures.emplace_back(), check);
  }
  read_pose(from.has_map_t_base(), from.map_t_base(), to.map_T_base, check);
}

void write(const api::FleetMissing& from, pb::FleetMissing* to) {
  to->set_sha256(bytes_of(from.hash));
  to->set_offset(from.offset);
}

void read(const pb::FleetMissing& from, api::FleetMissing& to, Check& check) {
  read_hash("sha256", from.sha256(), to.hash, check);
  to.offset = from.offset();
}

void write(const api::FleetChunk& from, pb::FleetChunk* to) {
  to->set_robot_id(from.robot_id);
  to->set_sha256(bytes_of(from.hash));
  to->set_offset(from.offset);
  to->set_data(from.data.data(), from.data.size());
}

void read(const pb::FleetChunk& from, api::FleetChunk& to, Check& check) {
  if (!check.count("data", from.data().size(), api::kMaxFleetChunkBytes)) {
    return;
  }
  to.robot_id = read_robot_id(from.robot_id(), check);
  read_hash("sha256", from.sha256(), to.hash, check);
  to.offset = from.offset();
  to.data.assign(from.data().begin(), from.data().end());
}

void write(const api::FleetStatus& from, pb::FleetStatus* to) {
  for (const api::FleetMember& member : from.members) {
    write_member(member, to->add_members());
  }
  to->set_revision(from.revision);
}

void read(const pb::FleetStatus& from, api::FleetStatus& to, Check& check) {
  if (!check.count("members", static_cast<std::size_t>(from.members_size()), api::kMaxFleetRobots)) {
    return;
  }
  for (int k = 0; k < from.members_size(); ++k) {
    const auto scope = check.in("members", static_cast<std::size_t>(k));
    read_member(from.members(k), to.members.emplace_back(), check);
  }
  to.revision = from.revision();
}

void write(const api::FleetDecision& from, pb::FleetDecision* to) {
  to->set_robot_id(from.robot_id);
  to->set_verb(static_cast<pb::FleetVerb>(wire_enum(from.verb)));
  to->set_hypothesis(from.hypothesis);
}

void read(const pb::FleetDecision& from, api::FleetDecision& to, Check& check) {
  to.robot_id = read_robot_id(from.robot_id(), check);
  check.enumerator("verb", from.verb(), api::FleetVerb::kSplit, to.verb);
  to.hypothesis = from.hypothesis();
}

}  // namespace seeker::wire
