/// \file
/// What deciding costs and what is decided, gathered around the behaviours that a loop makes.
#pragma once

#include <memory>
#include <string>

#include "server/app/missions/mission_executor.hpp"

namespace seeker::lab {

struct DecisionLog {
  int decisions = 0;         ///< of explorations
  double processor_s = 0.0;  ///< of the thread, in all steps of behaviours
  std::string phase;         ///< of the newest step
};

/// A factory of the same behaviours that write into `log`.
[[nodiscard]] app::BehaviourFactory watched(app::BehaviourFactory factory, std::shared_ptr<DecisionLog> log);

}  // namespace seeker::lab
