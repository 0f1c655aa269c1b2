/// \file
/// Parameters of every reproduction of a paper.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
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
  std::vector<std::string> worlds;      ///< for active-slam, efficiency and map-merging: the worlds to run; empty: all
  std::vector<std::string> strategies;  ///< for active-slam and efficiency: the strategies to run; empty: all
  /// For tests: regenerates the smallest form of everything, with the smallest world and the fewest pictures.
  bool smallest = false;
  bool sockets = true;  ///< false: leave out R12, the only part with processes and a network

  /// Whether `worlds`, or `strategies`, lets this one be run.
  [[nodiscard]] bool takes_world(std::string_view name) const { return takes(worlds, name); }
  [[nodiscard]] bool takes_strategy(std::string_view name) const { return takes(strategies, name); }

 private:
  static bool takes(const std::vector<std::string>& names, std::string_view name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  }
};

}  // namespace seeker::lab
