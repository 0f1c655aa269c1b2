/// \file
/// Parts of the parser of the command line: each adds the verbs of one topic with their options.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "client/cli/command_line.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the name that CLI11 has
class App;
class Option;
}  // namespace CLI

namespace seeker::cli {

/// What the options write to while CLI11 parses, and which verb was chosen.
struct Parse {
  CLI::App& app;
  GlobalOptions global = {};
  std::optional<Verb> verb = {};
};

/// Adds one verb to `parent`; `chosen` is called when it is the one of the command line.
CLI::App* add_subcommand(CLI::App& parent, const std::string& name, const std::string& description,
                         const std::string& example, std::function<void()> chosen);

/// Adds a verb that says nothing without one of its own verbs, as `map` does.
CLI::App* add_group(CLI::App& parent, const std::string& name, const std::string& description,
                    const std::string& example);

/// Adds one verb: its options write to a struct that becomes Parse::verb when the verb is chosen.
template <class T>
std::pair<CLI::App*, std::shared_ptr<T>> add_verb(Parse& parse, CLI::App& parent, const std::string& name,
                                                  const std::string& description, const std::string& example) {
  auto options = std::make_shared<T>();
  return {add_subcommand(parent, name, description, example, [&parse, options] { parse.verb = *options; }), options};
}

/// The option is given once for each value.
CLI::Option* repeatable(CLI::Option* option);

/// Where the fleet is that a verb speaks of.
void add_main(CLI::App& verb, FleetOptions& options);

/// status, doctor, audit, watch, grid, topology, detections, lines, camera; maps and components among them.
void add_reports(Parse& parse);
void add_maps(Parse& parse);        ///< map, relocalise
void add_components(Parse& parse);  ///< components
void add_missions(Parse& parse);    ///< search, recognise, explore, goto, survey, localise
void add_landmarks(Parse& parse);   ///< landmarks
void add_fleet(Parse& parse);       ///< fleet
void add_motion(Parse& parse);      ///< drive, lease, stop, estop, pause, resume
void add_pki(Parse& parse);         ///< pki

}  // namespace seeker::cli
