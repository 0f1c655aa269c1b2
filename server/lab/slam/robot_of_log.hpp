/// \file
/// Which robot a recorded log is taken for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/app/composition/robot_options.hpp"

namespace seeker::lab {

struct RobotOfLog {
  std::filesystem::path file;
  app::RobotOptions options;
};

/// The robot file that `robot` names, or the one in `config`/robots that the log requires, with overrides. Errors of
/// the log and of the file.
[[nodiscard]] Result<RobotOfLog> robot_of_log(const std::filesystem::path& robot, const std::filesystem::path& config,
                                              const std::filesystem::path& log,
                                              const std::vector<std::string>& overrides);

}  // namespace seeker::lab
