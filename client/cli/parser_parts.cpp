#include "client/cli/parser_parts.hpp"

#include <CLI/CLI.hpp>

namespace seeker::cli {

CLI::App* add_subcommand(CLI::App& parent, const std::string& name, const std::string& description,
                         const std::string& example, std::function<void()> chosen) {
  CLI::App* sub = parent.add_subcommand(name, description);
  sub->fallthrough();
  sub->footer("Example:\n  " + example);
  sub->callback(std::move(chosen));
  return sub;
}

CLI::App* add_group(CLI::App& parent, const std::string& name, const std::string& description,
                    const std::string& example) {
  CLI::App* group = add_subcommand(parent, name, description, example, nullptr);
  group->require_subcommand(1);
  return group;
}

CLI::Option* repeatable(CLI::Option* option) { return option->allow_extra_args(false); }

void add_main(CLI::App& verb, FleetOptions& options) {
  verb.add_option("--main", options.main,
                  "The main robot's fleet, HOST[:PORT] (default: the host of --robot, port 7473)");
}

}  // namespace seeker::cli
