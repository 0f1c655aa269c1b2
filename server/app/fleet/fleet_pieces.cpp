#include "server/app/fleet/fleet_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/digest/sha256.hpp"
#include "server/app/fleet/picture_piece.hpp"
#include "server/fleet/merge_memory.hpp"
#include "server/store/map_file.hpp"

namespace seeker::app {
namespace {

constexpr const char* kPieceName = "piece";
constexpr double kStepsPerUnit = 1e6;  ///< of metres and radians

double rounded(double value) { return std::round(value * kStepsPerUnit) / kStepsPerUnit; }

Pose2 rounded(const Pose2& pose) { return {rounded(pose.x_m), rounded(pose.y_m), rounded(wrap_angle(pose.theta_rad))}; }

/// The local map alone, as a map of its own.
LineMap local_map(const LineMap& map, const MapNode& node) {
  LineMap local;
  local.nodes = {{node.id, Pose2{}, node.created}};
  const Pose2 node_T_map = inverse(node.map_T_node);
  for (MapSegment segment : map.segments) {
    if (segment.node == node.id) {
      segment.map_T_segment = rounded(node_T_map * segment.map_T_segment);
      local.next_id = std::max(local.next_id, segment.id + 1);
      local.segments.push_back(segment);
    }
  }
  std::copy_if(map.keyframes.begin(), map.keyframes.end(), std::back_inserter(local.keyframes),
               [&](const MapKeyframe& keyframe) { return keyframe.node == node.id; });
  return local;
}

/// Those of local maps that are not there would show nothing.
void add_pictures(const LineMap& map, const fleet::NodePictures& pictures, PackedMap& packed) {
  for (const auto& picture : pictures) {
    const bool placed =
        std::any_of(map.nodes.begin(), map.nodes.end(), [&](const MapNode& node) { return node.id == picture->node; });
    if (placed && packed.manifest.pictures.size() < api::kMaxFleetPictures) {
      std::vector<std::uint8_t> bytes = encode_picture(*picture);
      const api::PieceHash hash = digest::sha256_of(bytes);
      packed.manifest.pictures.push_back({hash, bytes.size()});
      packed.pieces[hash] = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
    }
  }
}

}  // namespace

Result<PackedMap> pack_map(const LineMap& map, const std::string& robot_id, const fleet::NodePictures& pictures) {
  if (map.nodes.size() > api::kMaxFleetNodes || map.edges.size() > api::kMaxFleetEdges) {
    return fail(Errc::kTooLarge, "the map has more local maps or relations than a fleet takes");
  }
  PackedMap packed;
  api::FleetManifest& manifest = packed.manifest;
  manifest.robot_id = robot_id;
  manifest.map_epoch = map.epoch;
  manifest.next_id = map.next_id;
  manifest.edges = map.edges;
  manifest.nodes.reserve(map.nodes.size());
  for (const MapNode& node : map.nodes) {
    store::MapFile file;
    file.origin.name = kPieceName;
    file.origin.robot_id = robot_id;
    file.map = local_map(map, node);
    Result<std::vector<std::uint8_t>> bytes = store::encode_map_file(file);
    if (!bytes) {
      return tl::unexpected<Error>(bytes.error());
    }
    if (bytes->size() > api::kMaxFleetPieceBytes) {
      return fail(Errc::kTooLarge, "a local map has more than 8 MiB");
    }
    const api::PieceHash hash = digest::sha256_of(*bytes);
    manifest.nodes.push_back({node, hash, bytes->size()});
    packed.pieces[hash] = std::make_shared<const std::vector<std::uint8_t>>(std::move(*bytes));
  }
  add_pictures(map, pictures, packed);
  return packed;
}

Result<LineMap> unpack_map(const api::FleetManifest& manifest, const Pieces& pieces) {
  LineMap map;
  map.epoch = manifest.map_epoch;
  map.next_id = manifest.next_id;
  map.edges = manifest.edges;
  map.nodes.reserve(manifest.nodes.size());
  for (const api::FleetNode& node : manifest.nodes) {
    const auto piece = pieces.find(node.hash);
    if (piece == pieces.end()) {
      return fail(Errc::kNotReady, "a piece is missing");
    }
    Result<store::MapFile> file = store::decode_map_file(*piece->second);
    if (!file) {
      return tl::unexpected<Error>(file.error());
    }
    const LineMap& local = file->map;
    if (local.nodes.size() != 1 || local.nodes.front().id != node.node.id) {
      return fail(Errc::kInvalidArgument, "a piece is not the local map that was announced");
    }
    map.nodes.push_back(node.node);
    for (MapSegment segment : local.segments) {
      segment.map_T_segment = node.node.map_T_node * segment.map_T_segment;
      map.segments.push_back(segment);
    }
    map.keyframes.insert(map.keyframes.end(), local.keyframes.begin(), local.keyframes.end());
  }
  if (const Status valid = validate(map); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  return map;
}

Result<fleet::NodePictures> unpack_pictures(const api::FleetManifest& manifest, const Pieces& pieces) {
  fleet::NodePictures pictures;
  pictures.reserve(manifest.pictures.size());
  for (const api::FleetPicture& named : manifest.pictures) {
    const auto piece = pieces.find(named.hash);
    if (piece == pieces.end()) {
      return fail(Errc::kNotReady, "a piece is missing");
    }
    Result<fleet::NodePicture> picture = decode_picture(*piece->second);
    if (!picture) {
      return tl::unexpected<Error>(picture.error());
    }
    pictures.push_back(std::make_shared<const fleet::NodePicture>(std::move(*picture)));
  }
  return pictures;
}

bool same_frame(const std::vector<api::FleetNode>& a, const std::vector<api::FleetNode>& b) {
  return std::any_of(a.begin(), a.end(), [&](const api::FleetNode& one) {
    return std::any_of(b.begin(), b.end(), [&](const api::FleetNode& other) {
      return one.node.id == other.node.id && one.hash == other.hash &&
             fleet::same_place(one.node.map_T_node, other.node.map_T_node);
    });
  });
}

}  // namespace seeker::app
