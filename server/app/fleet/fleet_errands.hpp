/// \file
/// What the book of members asks others to do.
#pragma once

#include <functional>
#include <string>

#include "common/api/fleet.hpp"
#include "common/api/robot_api.hpp"
#include "server/app/fleet/fleet_pieces.hpp"

namespace seeker::app {

/// None is empty. MemberBook calls them with its mutex locked: they return at once and do not call the book.
struct FleetErrands {
  /// Asks the worker to keep a complete piece on the disk. One that is not kept is sent again after a restart.
  std::function<void(const std::string& robot_id, const api::PieceHash& hash, const PieceBytes& bytes)> keep_piece;
  /// Asks the worker to write the record of a robot. False: too much waits.
  std::function<bool(const std::string& robot_id)> keep_record;
  /// Asks the worker to judge the map of a robot. False: too much waits.
  std::function<bool(const std::string& robot_id)> judge;
  /// An event of the main robot.
  std::function<void(const std::string& kind, const std::string& text, api::Severity)> notify_operator;
};

}  // namespace seeker::app
