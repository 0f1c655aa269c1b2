#include "server/app/loop/mission_resumption.hpp"

#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "server/app/loop/mission_checkpoints.hpp"

namespace seeker::app {

bool MissionResumption::needs_map() const { return unfinished_ && MissionCheckpoints::wanted_for(unfinished_->task); }

void MissionResumption::begin_search(KeptState kept, const std::string& client, RobotTime now) {
  kept_ = std::move(kept);
  client_ = client;
  searching_ = has_own_map_ = true;
  searching_since_ = now;
  last_heading_rad_.reset();
  turned_rad_ = 0.0;
}

Twist2 MissionResumption::look_round(double heading_rad, RobotTime now) {
  if (now - searching_since_ < look_round_after_ || turned_rad_ >= kTwoPi) {
    return {};
  }
  turned_rad_ += std::abs(wrap_angle(heading_rad - last_heading_rad_.value_or(heading_rad)));
  last_heading_rad_ = heading_rad;
  return {0.0, look_round_rad_s_};
}

void MissionResumption::go_on_without_map(const MissionSoFar& so_far) {
  kept_ = {.map_T_base = std::nullopt, .memory = {}, .so_far = {std::nullopt, so_far.running}};
  has_own_map_ = false;
}

void MissionResumption::another_map_loaded() {
  has_own_map_ = false;
  kept_ = {};
}

void MissionResumption::mission_began() {
  unfinished_.reset();
  kept_ = {};
}

}  // namespace seeker::app
