/// \file
/// Pieces of maps on the disk of the main robot.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "server/app/fleet/fleet_pieces.hpp"

namespace seeker::app {

/// One file per piece, named by its hash, in a folder per robot. It has no state but the folder, so that any thread may
/// call all of it; a piece that is kept while drop_all_but() runs for its robot must be among those that are needed.
class PieceFiles {
 public:
  explicit PieceFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The pieces of the manifest that are there and have the hash of their name.
  [[nodiscard]] Pieces load(const api::FleetManifest& manifest) const;
  /// A failure is logged: the piece is sent again after a restart.
  void keep(const std::string& robot_id, const api::PieceHash& hash, const PieceBytes& bytes) const;
  /// Removes the pieces of a robot that are not among those that are needed.
  void drop_all_but(const std::string& robot_id, const Pieces& needed) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace seeker::app
