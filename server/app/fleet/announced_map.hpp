/// \file
/// The map that one robot has announced to the main robot, and as much of it as has arrived.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/fleet/fleet_pieces.hpp"

namespace seeker::app {

inline constexpr const char* kNotAnnounced = "nobody has announced this piece; announce the map again";

/// The manifest and the pieces that it names. It has no lock: MemberBook guards it with its mutex.
class AnnouncedMap {
 public:
  /// What a chunk has done.
  struct Receipt {
    std::uint64_t bytes = 0;  ///< of the piece that are there afterwards
    PieceBytes completed;     ///< the whole piece where this chunk has completed it, else null
  };

  AnnouncedMap() = default;
  /// As it was read from the disk.
  AnnouncedMap(api::FleetManifest manifest, Pieces pieces);

  /// Replaces the manifest and drops the pieces that it does not name any more.
  void announce(const api::FleetManifest& manifest);
  /// Sets the pose that the robot has reported since it announced its map.
  void set_pose(const std::optional<Pose2>& map_T_base) { manifest_.map_T_base = map_T_base; }
  /// kNotFound: the manifest does not name the piece; kTooLarge: the piece is longer than announced, or the chunk is
  /// empty; kCorrupt: its hash differs. The piece is dropped in the last two cases.
  [[nodiscard]] Result<Receipt> receive(const api::FleetChunk& chunk);

  /// Pieces that are not complete yet, in the order of the manifest: local maps, then pictures.
  [[nodiscard]] std::vector<api::FleetMissing> missing() const;
  [[nodiscard]] const api::FleetManifest& manifest() const { return manifest_; }
  /// The complete ones.
  [[nodiscard]] const Pieces& pieces() const { return pieces_; }

 private:
  api::FleetManifest manifest_;
  Pieces pieces_;
  std::map<api::PieceHash, std::vector<std::uint8_t>> partial_;
};

}  // namespace seeker::app
