#include "server/drivers/p2os/sonar_ring.hpp"

#include <utility>

namespace seeker::drivers {

void SonarRing::connect(const p2os::PioneerModel& model) {
  model_ = &model;
  echoes_.fill(std::nullopt);
  fresh_ = false;
}

void SonarRing::add(const p2os::Sip& sip, RobotTime stamp) {
  for (const p2os::SipSonar& sonar : sip.sonars) {
    // Bases with more transducers than their model has poses exist.
    if (sonar.number < echoes_.size() && sonar.number < model_->base_T_sonar.size()) {
      const double range_m = sonar.range * model_->range_unit_m;
      echoes_[sonar.number] =
          Echo{range_m < params_.sonar_range_max_m ? static_cast<float>(range_m) : kNoReturn, stamp};
      newest_ = stamp;
      fresh_ = true;
    }
  }
}

std::optional<SonarScan> SonarRing::take() {
  if (!std::exchange(fresh_, false)) {
    return std::nullopt;
  }
  SonarScan scan;
  scan.stamp = newest_;
  scan.range_max_m = params_.sonar_range_max_m;
  scan.cone_half_angle_rad = params_.sonar_cone_half_angle_rad;
  scan.readings.reserve(echoes_.size());
  for (std::size_t number = 0; number < echoes_.size(); ++number) {
    if (echoes_[number] && newest_ - echoes_[number]->stamp <= params_.sonar_max_age) {
      scan.readings.push_back({model_->base_T_sonar[number], echoes_[number]->range_m});
    }
  }
  return scan;
}

}  // namespace seeker::drivers
