/// \file
/// Whether answers about the robot's place, one after the other, are enough to believe it.
#pragma once

#include <optional>

#include "server/slam/local_cloud.hpp"
#include "server/slam/place_recogniser.hpp"

namespace seeker::slam {

struct ClaimParams {
  double witnesses = 3.0;  ///< weight of the answers in a row that must name the same place
  double agree_m = 0.3;    ///< to within this
  double agree_rad = 0.1;
  double moved_m = 0.25;  ///< an answer that is not clear counts when the robot has moved by this since the last one
  double moved_rad = 0.4;
};

/// One answer may be a chance; those in a row must name the same place, and more of them where each says little
/// (PlaceAnswer::weight). A robot that stands gives the same answer each time: it has no other where the place is
/// clear, and must be driven on by hand where it is not.
class PlaceClaim {
 public:
  explicit PlaceClaim(const ClaimParams& params = {}) : params_(params) {}

  /// Takes an answer about the robot at node_T_base. True when its place is to be believed.
  [[nodiscard]] bool take(const PlaceAnswer& answer, const Pose2& node_T_base);
  /// The node is another one from now on.
  void change_node(const Pose2& old_T_new);
  void clear() { claim_.reset(); }

 private:
  struct Claim {
    Pose2 map_T_node;     ///< by the last answer that counted
    Pose2 node_T_view;    ///< where the robot was then
    double weight = 0.0;  ///< of the answers in a row that have said so
  };

  ClaimParams params_;
  std::optional<Claim> claim_;
};

}  // namespace seeker::slam
