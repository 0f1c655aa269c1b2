// Several robots.

#include <CLI/CLI.hpp>

#include "client/cli/parser_parts.hpp"

namespace seeker::cli {
namespace {

/// A verb of a fleet, with the option that all of them have.
template <class T>
std::pair<CLI::App*, std::shared_ptr<T>> add_fleet_verb(Parse& parse, CLI::App& fleet, const std::string& name,
                                                        const std::string& description, const std::string& example) {
  auto added = add_verb<T>(parse, fleet, name, description, example);
  add_main(*added.first, *added.second);
  return added;
}

}  // namespace

void add_fleet(Parse& parse) {
  CLI::App* fleet = add_group(parse.app, "fleet", "Several robots, one map: who has joined, and how their maps lie",
                              "seeker fleet status\n  seeker fleet merge r2 --hypothesis 1");
  add_fleet_verb<FleetStatusVerb>(parse, *fleet, "status", "Every robot in the frame of the main one",
                                  "seeker fleet status");
  auto [merge, m] = add_fleet_verb<FleetMergeVerb>(parse, *fleet, "merge",
                                                   "Accept a hypothesis of where a robot's map lies, or merge it again",
                                                   "seeker fleet merge r2 --hypothesis 1");
  merge->add_option("robot_id", m->robot, "The robot's id")->required();
  merge->add_option("--hypothesis", m->hypothesis, "Which of those that 'fleet status' lists, from 0")
      ->capture_default_str();
  auto [split, s] = add_fleet_verb<FleetSplitVerb>(parse, *fleet, "split", "Take a robot's map out of the joint one",
                                                   "seeker fleet split r2");
  split->add_option("robot_id", s->robot, "The robot's id")->required();
  auto [map, f] = add_fleet_verb<FleetMapVerb>(
      parse, *fleet, "map", "Download the joint map, or draw it with the robots, their topologies and detections",
      "seeker fleet map out/all.seekermap\n  seeker fleet map out/all --format png,svg");
  map->add_option("file", f->file, "File to write; with --format the path without extension")->required();
  map->add_option("--format", f->formats, "Pictures instead of the map file: of png, svg, pgm (with its yaml)")
      ->delimiter(',')
      ->check(CLI::IsMember({"png", "svg", "pgm"}));
}

}  // namespace seeker::cli
