#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>

#include "client/cli/parser_errors.hpp"
#include "client/cli/parser_parts.hpp"
#include "common/config/number_text.hpp"

namespace seeker::cli {
namespace {

void add_globals(Parse& parse) {
  CLI::App& app = parse.app;
  GlobalOptions& global = parse.global;
  app.add_option("--robot", global.robot, "Robot to talk to, HOST[:PORT]")
      ->envname("SEEKER_ROBOT")
      ->capture_default_str();
  app.add_option("--as", global.client_name,
                 "Name of this client for the robot, which names the owner of the lease by it (default: made up)")
      ->envname("SEEKER_CLIENT");
  app.add_option("--tls", global.tls,
                 "Speak TLS with the certificates of this folder ('seeker pki issue' makes it); none: plain TCP. "
                 "Default: ~/.config/seeker/tls where it is there, for robots on other machines")
      ->envname("SEEKER_TLS");
  app.add_flag("--json", global.json, "Print data as JSON");
  app.add_option("--timeout", global.timeout_s,
                 "Longest wall time in s: for an answer (default 5), or for the whole of a mission, watch and run")
      ->check(config::number_above_zero, "above 0");
  CLI::Option* quiet = app.add_flag("-q,--quiet", global.quiet, "No progress and no messages except errors");
  app.add_flag("-v,--verbose", global.verbose, "Every event of the robot as a message")->excludes(quiet);
  app.set_version_flag("--version", "", "As the verb version");
  app.require_subcommand(1);
  app.footer(
      "Data go to stdout, messages and progress to stderr. NO_COLOR switches colours off.\n"
      "Exit codes: 0 ok, 1 failed, 2 usage, 3 refused, 4 no link, 5 timeout, 6 target not found, 130 interrupted.\n"
      "Example:\n  seeker --robot 10.0.0.5 search --target poster-a");
}

void add_rest(Parse& parse) {
  auto [run, r] =
      add_verb<RunVerb>(parse, parse.app, "run", "Play a mission script; 0 only when every expectation holds",
                        "seeker run config/missions/demo-search.yaml\n  seeker run --check mission.yaml");
  run->add_option("file", r->file, "Mission script (YAML)")->required();
  repeatable(run->add_option("--targets", r->target_folders, "Folder of target files; repeatable"));
  run->add_flag("--check", r->check, "Read and check the script, command nothing");
  add_main(*run, *r);
  auto [completion, c] =
      add_verb<CompletionVerb>(parse, parse.app, "completion", "Print completion for a shell",
                               "seeker completion bash > ~/.local/share/bash-completion/completions/seeker");
  completion->add_option("shell", c->shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  add_verb<VersionVerb>(parse, parse.app, "version", "Version of this program and of its protocol", "seeker version");
}

void build(Parse& parse) {
  add_globals(parse);
  add_reports(parse);
  add_missions(parse);
  add_landmarks(parse);
  add_fleet(parse);
  add_motion(parse);
  add_pki(parse);
  add_rest(parse);
}

CommandTree tree_of(const CLI::App& app) {
  CommandTree tree{app.get_name(), app.get_description(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    // CLI11 has no list of a check's values, but prints it: ":{a,b,c}".
    std::vector<std::string> values;
    const std::string type = option->get_type_name();
    if (const std::size_t brace = type.find('{'); brace != std::string::npos) {
      std::stringstream list(type.substr(brace + 1, type.find('}') - brace - 1));
      for (std::string value; std::getline(list, value, ',');) {
        values.push_back(value);
      }
    }
    if (option->get_positional()) {
      tree.words = values;
      continue;
    }
    CommandTree::Option entry{{}, option->get_description(), option->get_items_expected_max() != 0, values};
    for (const std::string& name : option->get_lnames()) {
      entry.names.push_back("--" + name);
    }
    for (const std::string& name : option->get_snames()) {
      entry.names.push_back("-" + name);
    }
    tree.options.push_back(std::move(entry));
  }
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    tree.commands.push_back(tree_of(*sub));
  }
  return tree;
}

}  // namespace

ParsedCommandLine parse_command_line(const std::vector<std::string>& arguments) {
  CLI::App app{"seeker: commands a Seeker robot from the workstation", "seeker"};
  Parse parse{app};
  build(parse);
  ParsedCommandLine result;
  // Looked for by hand: what is wrong may stand before it.
  result.json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  if (const auto verb = unknown_verb(parse.app, arguments)) {
    result.exit_code = ExitCode::kUsage;
    result.err = "there is no verb '" + *verb + "'; seeker --help lists them";
    return result;
  }
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    parse.app.parse(reversed);
  } catch (const CLI::CallForVersion&) {
    parse.global.json = result.json;
    parse.verb = VersionVerb{};
  } catch (const CLI::ParseError& error) {
    // CLI11's own codes (104..109 and more) would say nothing to a script.
    result.exit_code = error.get_exit_code() == 0 ? ExitCode::kOk : ExitCode::kUsage;
    if (result.exit_code == ExitCode::kOk) {
      std::ostringstream out;
      parse.app.exit(error, out, out);
      result.out = out.str();
    } else {
      result.err = sentence_of(parse.app, error);
    }
    return result;
  }
  if (parse.verb) {
    result.command = CommandLine{parse.global, *parse.verb};
  }
  return result;
}

CommandTree command_tree() {
  CLI::App app{"seeker: commands a Seeker robot from the workstation", "seeker"};
  Parse parse{app};
  build(parse);
  return tree_of(parse.app);
}

}  // namespace seeker::cli
