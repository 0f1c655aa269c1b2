/// \file
/// Decides whether consecutive answers about the robot's place are sufficient to accept it.
#pragma once

#include <optional>

#include "server/slam/local_cloud.hpp"
#include "server/slam/place_recogniser.hpp"

namespace seeker::slam {

struct ClaimParams {
  double witnesses = 3.0;  ///< total weight of the answers in a row that must name the same place
  double agree_m = 0.3;    ///< largest difference in position between agreeing answers
  double agree_rad = 0.1;  ///< largest difference in heading between agreeing answers
  double moved_m = 0.25;   ///< displacement since the last counted answer from which on an ambiguous answer counts
  double moved_rad = 0.4;  ///< rotation from which on an ambiguous answer counts
};

/// One answer may be a coincidence; consecutive answers must name the same place, and more of them where each holds
/// little information (PlaceAnswer::weight). A robot that stands still repeats its answer: this suffices where the
/// place is unique, and the robot must be driven on by hand where it is not.
class PlaceClaim {
 public:
  explicit PlaceClaim(const ClaimParams& params = {}) : params_(params) {}

  /// Takes an answer about the robot at node_T_base. True when its place is accepted.
  [[nodiscard]] bool take(const PlaceAnswer& answer, const Pose2& node_T_base);
  /// Expresses the claim in the frame of another node from now on.
  void change_node(const Pose2& old_T_new);
  void clear() { claim_.reset(); }

 private:
  struct Claim {
    Pose2 map_T_node;     ///< according to the last answer that counted
    Pose2 node_T_view;    ///< pose of the robot at that answer
    double weight = 0.0;  ///< sum of the weights of the agreeing answers in a row
  };

  ClaimParams params_;
  std::optional<Claim> claim_;
};

}  // namespace seeker::slam
