/// \file
/// Whether answers about the robot's place, one after the other, are enough to believe it.
#pragma once

#include <optional>

#include "server/slam/local_cloud.hpp"
#include "server/slam/place_recogniser.hpp"

namespace seeker::slam {

struct ClaimParams {
  int witnesses = 3;     ///< answers in a row that must name the same place
  double agree_m = 0.3;  ///< to within this
  double agree_rad = 0.1;
};

/// One answer may be a chance; those in a row must name the same place. A robot that stands gives the same answer each
/// time: it has no other, and must drive by hand where the place is ambiguous.
class PlaceClaim {
 public:
  explicit PlaceClaim(const ClaimParams& params = {}) : params_(params) {}

  /// Takes an answer about the robot at node_T_base. True when its place is to be believed.
  [[nodiscard]] bool take(const PlaceAnswer& answer, const Pose2& node_T_base);
  /// The node is another one from now on.
  void change_node(const Pose2& old_T_new);
  void clear();

 private:
  ClaimParams params_;
  std::optional<Pose2> map_T_node_;  ///< by the last unique answer
  int witnesses_ = 0;                ///< answers in a row that have said so
};

}  // namespace seeker::slam
