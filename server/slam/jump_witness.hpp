/// \file
/// A match far from where the odometry has the robot: believed when the scans after it say the same.
#pragma once

#include "common/core/pose2.hpp"

namespace seeker::slam {

struct JumpParams {
  int scans = 3;         ///< in a row that must agree
  double agree_m = 0.3;  ///< to within this
  double agree_rad = 0.1;
};

class JumpWitness {
 public:
  explicit JumpWitness(const JumpParams& params = {}) : params_(params) {}

  /// One scan was matched at `found` where `predicted` was expected, both in one frame, while the robot goes on by its
  /// odometry. True when enough scans in a row have found it as far off.
  [[nodiscard]] bool confirms(const Pose2& found, const Pose2& predicted);
  /// A scan that said nothing of a jump, or that another frame begins.
  void clear() { scans_ = 0; }

 private:
  JumpParams params_;
  Pose2 found_T_predicted_;  ///< found * inverse(predicted): the same as long as the jump is
  int scans_ = 0;
};

}  // namespace seeker::slam
