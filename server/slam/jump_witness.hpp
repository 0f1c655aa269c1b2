/// \file
/// Confirmation of matches far from the odometry: such a match is accepted when the following scans agree with it.
#pragma once

#include "common/core/pose2.hpp"

namespace seeker::slam {

struct JumpParams {
  int scans = 3;           ///< number of scans in a row that must agree
  double agree_m = 0.3;    ///< largest difference in position between agreeing scans
  double agree_rad = 0.1;  ///< largest difference in heading between agreeing scans
};

class JumpWitness {
 public:
  explicit JumpWitness(const JumpParams& params = {}) : params_(params) {}

  /// Records that one scan was matched at `found` where `predicted` was expected, both in one frame, while the robot
  /// continues by its odometry. True when enough scans in a row have found the same offset.
  [[nodiscard]] bool confirms(const Pose2& found, const Pose2& predicted);
  /// Forgets the jump, after a scan without a jump or a change of frame.
  void clear() { scans_ = 0; }

 private:
  JumpParams params_;
  Pose2 found_T_predicted_;  ///< found * inverse(predicted): constant as long as the jump persists
  int scans_ = 0;
};

}  // namespace seeker::slam
