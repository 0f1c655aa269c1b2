/// \file
/// R12 of spec S7: the shipped mission scripts over real TCP, with server and client as two processes.
#pragma once

#include <chrono>
#include <filesystem>

#include "common/core/result.hpp"
#include "server/lab/experiments/check.hpp"

namespace seeker::lab {

struct ScriptParams {
  std::filesystem::path programs;           ///< folder of seekerd and seeker
  std::filesystem::path config = "config";  ///< folder with robots/, worlds/, missions/
  std::filesystem::path out;                ///< logs go to out/r12
  std::chrono::seconds start_limit{60};     ///< wall time limit until the server can be reached
  std::chrono::seconds script_limit{1800};  ///< wall time limit of one script
  bool smallest = false;                    ///< only the scripts that take seconds
};

/// One check for each script in config/missions: for each robot of the script a separate server is started, `seeker
/// run` plays the script to it and must exit with 0, and the servers must end with 0 on request. Several robots share
/// the world of a seeker-emulator, and the first of them leads the fleet. A last check says whether every kind of
/// mission was played, and a fleet (left out with `smallest`). Errors: no programs or no scripts.
[[nodiscard]] Status check_mission_scripts(const ScriptParams& params, Report& report);

}  // namespace seeker::lab
