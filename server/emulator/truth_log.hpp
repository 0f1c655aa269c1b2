/// \file
/// The true poses of the robots, for scoring: one line per robot and step.
#pragma once

#include <filesystem>
#include <fstream>

#include "common/core/result.hpp"
#include "server/sim/shared_world.hpp"

namespace seeker::emulator {

/// CSV: time_s, robot, x_m, y_m, theta_rad (frame `world`), contacts. Robots never read it.
class TruthLog {
 public:
  [[nodiscard]] Status open(const std::filesystem::path& file);
  void add(const sim::SharedWorld& world);

 private:
  std::ofstream out_;
};

}  // namespace seeker::emulator
