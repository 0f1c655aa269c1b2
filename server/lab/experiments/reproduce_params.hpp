/// \file
/// What every reproduction of a paper is given.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace seeker::lab {

struct ReproduceParams {
  std::filesystem::path out;
  std::filesystem::path config = "config";
  std::filesystem::path programs;  ///< folder of seekerd and seeker; empty: beside this program
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> overrides;
  int jobs = 1;
  bool show_progress = false;
  std::vector<std::string> worlds;      ///< of active-slam: only these; empty: all
  std::vector<std::string> strategies;  ///< of active-slam: only these; empty: all
  /// The smallest form of everything that is regenerated: the smallest world, the fewest pictures. For tests.
  bool smallest = false;
  bool sockets = true;  ///< false: leave out R12, the only part with processes and network
};

}  // namespace seeker::lab
