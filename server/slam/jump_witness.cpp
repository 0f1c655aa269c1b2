#include "server/slam/jump_witness.hpp"

#include "server/slam/local_cloud.hpp"

namespace seeker::slam {

bool JumpWitness::confirms(const Pose2& found, const Pose2& predicted) {
  const bool same = scans_ > 0 && !moved(found_T_predicted_ * predicted, found, params_.agree_m, params_.agree_rad);
  found_T_predicted_ = found * inverse(predicted);
  scans_ = same ? scans_ + 1 : 1;
  return scans_ >= params_.scans;
}

}  // namespace seeker::slam
