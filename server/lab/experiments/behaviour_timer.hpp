/// \file
/// Cost and number of decisions, recorded around the behaviours that a loop makes.
#pragma once

#include <memory>
#include <string>

#include "server/app/missions/mission_executor.hpp"

namespace seeker::lab {

struct DecisionLog {
  int decisions = 0;         ///< number of decisions of explorations
  double processor_s = 0.0;  ///< processor time of the thread in all steps of behaviours
  std::string phase;         ///< phase of the newest step
};

/// A factory of the same behaviours that also write into `log`.
[[nodiscard]] app::BehaviourFactory watched(app::BehaviourFactory factory, std::shared_ptr<DecisionLog> log);

}  // namespace seeker::lab
