/// \file
/// A robot's map and pictures cut into pieces that travel, and put together again.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/api/fleet.hpp"
#include "common/core/line_map.hpp"
#include "server/fleet/node_picture.hpp"

namespace seeker::app {

using PieceBytes = std::shared_ptr<const std::vector<std::uint8_t>>;
using Pieces = std::map<api::PieceHash, PieceBytes>;

/// What a robot announces, and what it sends of it when asked.
struct PackedMap {
  api::FleetManifest manifest;
  Pieces pieces;
};

/// One piece per local map, in its own frame, rounded to a micrometre: a piece changes when its local map does, not
/// when the map around it moves. One more per picture of a local map that is there. Errors of store::encode_map_file();
/// kTooLarge for more than the wire carries.
[[nodiscard]] Result<PackedMap> pack_map(const LineMap& map, const std::string& robot_id,
                                         const fleet::NodePictures& pictures = {});

/// The map of a manifest whose pieces are all there. kCorrupt or kParse: a piece is none; kInvalidArgument: together
/// they are no map.
[[nodiscard]] Result<LineMap> unpack_map(const api::FleetManifest& manifest, const Pieces& pieces);

/// The pictures of a manifest whose pieces are all there. kParse, kInvalidArgument, kTooLarge: a piece is no picture;
/// kNotReady: one is missing.
[[nodiscard]] Result<fleet::NodePictures> unpack_pictures(const api::FleetManifest& manifest, const Pieces& pieces);

/// Whether two manifests of a robot have a local map in common, at the same place: else it has begun a new map.
[[nodiscard]] bool same_frame(const std::vector<api::FleetNode>& a, const std::vector<api::FleetNode>& b);

}  // namespace seeker::app
