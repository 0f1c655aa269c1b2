// The parts of the robot.

#include <CLI/CLI.hpp>

#include "client/cli/parser_parts.hpp"

namespace seeker::cli {
namespace {

/// One action on a component; its options write to the struct of the whole verb.
CLI::App* add_component_action(CLI::App& components, ComponentsVerb& verb, ComponentsAction action,
                               const std::string& name, const std::string& description, const std::string& example) {
  CLI::App* sub = add_subcommand(components, name, description, "seeker components " + example,
                                 [&verb, action] { verb.action = action; });
  sub->add_option("name", verb.name, "Name of the component, as 'seeker components' lists it")->required();
  return sub;
}

}  // namespace

void add_components(Parse& parse) {
  auto [components, r] =
      add_verb<ComponentsVerb>(parse, parse.app, "components", "The robot's parts, their ports and who feeds whom",
                               "seeker components --restart camera");
  components->add_option("--restart", r->restart, "Restart this component; a running mission is paused");
  components->require_subcommand(0, 1);
  using Action = ComponentsAction;
  add_component_action(*components, *r, Action::kGet, "get", "Settings of a component and when a change takes effect",
                       "get recogniser");
  add_component_action(*components, *r, Action::kSet, "set", "Change settings while the robot runs, all or none",
                       "set lidar period_s=0.2")
      ->add_option("settings", r->assignments, "KEY=VALUE, as 'seeker components get NAME' lists them")
      ->required();
  add_component_action(*components, *r, Action::kExchange, "exchange",
                       "Exchange estimator, recogniser or planner while no mission runs; with a new estimator a "
                       "new map begins",
                       "exchange pose scan_match")
      ->add_option("type", r->type, "What to exchange it for, as in a robot file")
      ->required();
  add_component_action(*components, *r, Action::kActivate, "activate", "Activate a component", "activate sonar");
  add_component_action(*components, *r, Action::kDeactivate, "deactivate",
                       "Deactivate a component; the robot stands still until it is active again", "deactivate sonar");
}

}  // namespace seeker::cli
