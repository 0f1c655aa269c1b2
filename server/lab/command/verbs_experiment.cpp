#include <algorithm>
#include <array>
#include <iostream>
#include <set>

#include <CLI/CLI.hpp>

#include "common/config/number_text.hpp"
#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/active_slam/reproduce_active_slam.hpp"
#include "server/lab/command/verbs.hpp"
#include "server/lab/consistency/reproduce_consistency.hpp"
#include "server/lab/efficiency/reproduce_efficiency.hpp"
#include "server/lab/efficiency/reproduce_sharing.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/line_detection/reproduce_line_detection.hpp"
#include "server/lab/map_merging/reproduce_map_merging.hpp"
#include "server/lab/search/reproduce_search.hpp"
#include "server/lab/search/search_experiment.hpp"
#include "server/lab/search/summary.hpp"
#include "server/lab/solids/solids_study.hpp"
#include "server/lab/stereo_database/reproduce_stereo_database.hpp"

namespace seeker::lab {
namespace {

const std::map<std::string, search::Strategy> kStrategies = {{"paper", search::Strategy::kPaper},
                                                             {"plan", search::Strategy::kPlan},
                                                             {"spiral", search::Strategy::kSpiral},
                                                             {"frontier", search::Strategy::kFrontier}};
const std::map<std::string, api::OnFound> kOnFound = {
    {"stop", api::OnFound::kStop}, {"approach", api::OnFound::kApproach}, {"continue", api::OnFound::kContinue}};

/// What `reproduce` regenerates, by name.
struct Reproduction {
  Status (*run)(const ReproduceParams&, Report&);
  const char* seeds;              ///< where the command line names none
  const char* smallest_seeds;     ///< the same with --smallest
  std::set<std::string> takes{};  ///< of kSpecialOptions
};
/// What only some reproductions heed. One that is asked for anything else would show figures of other settings.
constexpr std::array kSpecialOptions{"--set", "--robot", "--world", "--strategy", "--programs", "--no-sockets"};
const std::map<std::string, Reproduction> kReproductions = {
    {"active-slam", {&reproduce_active_slam, "1-20", "1", {"--set", "--world", "--strategy"}}},
    {"consistency", {&reproduce_consistency, "1-50", "1-3"}},
    {"efficiency", {&reproduce_efficiency, "1-20", "1", {"--set", "--world", "--strategy"}}},
    {"efficiency-fleet", {&reproduce_sharing, "1-20", "1", {"--set", "--world"}}},
    {"line-detection", {&reproduce_line_detection, "1-100", "1-3"}},
    {"map-merging", {&reproduce_map_merging, "1-4", "1", {"--set", "--world"}}},
    {"search", {&reproduce_search, "1-20", "1", {"--set", "--programs", "--no-sockets"}}},
    {"solids", {&reproduce_solids, "1-5", "3"}},
    {"stereo-database", {&reproduce_stereo_database, "1-10", "1", {"--set"}}}};
/// The section of the specification that a reproduction comes from, as another name of it.
const std::map<std::string, std::string> kAliases = {
    {"r2", "consistency"}, {"s1", "active-slam"},    {"s2", "stereo-database"}, {"s3", "search"},
    {"s4", "map-merging"}, {"s5", "line-detection"}, {"s6", "solids"}};

std::vector<std::string> reproduction_names() {
  std::vector<std::string> names;
  names.reserve(kReproductions.size() + kAliases.size());
  for (const auto& [name, reproduction] : kReproductions) {
    names.push_back(name);
  }
  for (const auto& [alias, name] : kAliases) {
    names.push_back(alias);
  }
  return names;
}

/// With commas between.
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

/// The worlds that a part of a reproduction may be restricted to, by the reproduction's name.
std::vector<std::string> worlds_of(const std::string& name) {
  if (name == "map-merging") {
    return map_merging_worlds();
  }
  std::vector<std::string> names;
  if (name == "efficiency") {
    for (const EfficiencyWorld& world : efficiency_worlds()) {
      names.push_back(world.name);
    }
    return names;
  }
  if (name == "efficiency-fleet") {
    for (const SharingWorld& world : sharing_worlds()) {
      names.push_back(world.name);
    }
    return names;
  }
  for (const ExploreWorld& world : explore_worlds()) {
    names.push_back(world.name);
  }
  return names;
}

/// Options of `search` and `compare`.
struct SearchOptions {
  CommonOptions common;
  std::vector<std::string> worlds;
  std::vector<std::string> strategies;
  std::string on_found = "approach";
  double time_limit_s = 3600.0;
  bool random_target = false;
  bool no_target = false;
  bool explore = false;
  bool pictures = false;
};

void add_search_options(CLI::App& verb, SearchOptions& o) {
  add_common(verb, o.common);
  verb.add_option("--world", o.worlds, "World file, or the name of one in worlds/ (repeatable)");
  verb.add_option("--strategy", o.strategies, "How the robot searches (repeatable)")
      ->check(CLI::IsMember({"paper", "plan", "spiral", "frontier"}));
  verb.add_option("--on-found", o.on_found, "What the robot does with a target")
      ->check(CLI::IsMember({"stop", "approach", "continue"}))
      ->capture_default_str();
  verb.add_option("--time-limit", o.time_limit_s, "Longest robot time of a run, s")
      ->check(config::number_above_zero, "above 0")
      ->capture_default_str();
  verb.add_flag("--pictures", o.pictures, "A picture of the map beside every new run");
  verb.add_flag("--explore", o.explore, "Map the building too; targets are scored after laying the map on its walls");
  CLI::Option* random =
      verb.add_flag("--random-target", o.random_target, "The target stands at a place drawn from the seed");
  verb.add_flag("--no-target", o.no_target, "The same world without anything to be found")->excludes(random);
}

Result<std::vector<RunSpec>> specs_of(const SearchOptions& o) {
  const Result<std::vector<std::uint64_t>> seeds = parse_seeds(o.common.seeds);
  if (!seeds) {
    return tl::unexpected<Error>(seeds.error());
  }
  std::vector<RunSpec> specs;
  for (const std::string& world : o.worlds) {
    RunSpec spec;
    spec.robot_file = robot_file(o.common);
    spec.world_file = world_file(o.common, world);
    spec.target_folder = std::filesystem::absolute(spec.world_file).parent_path().parent_path() / "targets";
    if (o.no_target) {
      const Result<std::filesystem::path> empty = without_targets(spec.world_file, o.common.out / "worlds");
      if (!empty) {
        return tl::unexpected<Error>(empty.error());
      }
      spec.world_file = *empty;
    }
    spec.random_target = o.random_target;
    spec.on_found = kOnFound.at(o.on_found);
    spec.explore = o.explore;
    spec.time_limit_s = o.time_limit_s;
    spec.overrides = o.common.overrides;
    for (const std::string& strategy : o.strategies) {
      spec.strategy = kStrategies.at(strategy);
      const std::vector<RunSpec> runs = with_seeds(spec, *seeds);
      specs.insert(specs.end(), runs.begin(), runs.end());
    }
  }
  return specs;
}

/// Runs what is missing and writes the tables; the groups.
Result<std::vector<GroupSummary>> run_and_tabulate(const SearchOptions& o) {
  const Result<std::vector<RunSpec>> specs = specs_of(o);
  if (!specs) {
    return tl::unexpected<Error>(specs.error());
  }
  std::error_code error;
  std::filesystem::create_directories(o.common.out, error);
  const Result<std::vector<RunResult>> results = run_missing(
      *specs, {.out = o.common.out, .jobs = o.common.jobs, .pictures = o.pictures, .show_progress = show_progress()});
  if (!results) {
    return tl::unexpected<Error>(results.error());
  }
  const std::vector<GroupSummary> groups = summarise(*results);
  if (const Status ok = files::write_file(o.common.out / "runs.csv", runs_csv(*results)); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (const Status ok = files::write_file(o.common.out / "summary.csv", summary_csv(groups)); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  std::cout << (o.common.json ? summary_json(groups) : summary_text(groups)) << std::flush;
  return groups;
}

int run_search_verb(const SearchOptions& o) {
  const Result<std::vector<GroupSummary>> groups = run_and_tabulate(o);
  return groups ? kExitDone : report_error(groups.error().message);
}

int run_compare(const SearchOptions& o) {
  const Result<std::vector<GroupSummary>> groups = run_and_tabulate(o);
  if (!groups) {
    return report_error(groups.error().message);
  }
  if (const Status ok = image::write_png(o.common.out / "comparison.png", comparison_chart(*groups)); !ok) {
    return report_error(ok.error().message);
  }
  return kExitDone;
}

/// Options of `reproduce`.
struct ReproduceOptions {
  CommonOptions common;
  std::string name = "search";  ///< or an alias
  std::string programs;
  std::vector<std::string> worlds;
  std::vector<std::string> strategies;
  bool smallest = false;
  bool no_sockets = false;
};

/// The first option given that the reproduction `name` would not heed; empty: none.
std::string unheeded_option(const CLI::App& verb, const std::string& name) {
  const auto* const option = std::ranges::find_if(kSpecialOptions, [&](const char* special) {
    return verb.count(special) > 0 && !kReproductions.at(name).takes.contains(special);
  });
  return option == kSpecialOptions.end() ? "" : *option;
}

int run_reproduce(const CLI::App& verb, const ReproduceOptions& options) {
  const CommonOptions& o = options.common;
  const auto alias = kAliases.find(options.name);
  const std::string& name = alias == kAliases.end() ? options.name : alias->second;
  if (const std::string option = unheeded_option(verb, name); !option.empty()) {
    return report_error("reproduce " + options.name + " takes no " + option +
                        ": its condition fixes what that would change; leave it out");
  }
  const std::vector<std::string> worlds = worlds_of(name);
  for (const std::string& world : options.worlds) {
    if (std::ranges::find(worlds, world) == worlds.end()) {
      return report_error("--world: '" + world + "' is not of " + name + "; its worlds are " + joined(worlds));
    }
  }
  const Reproduction& reproduction = kReproductions.at(name);
  const char* usual_seeds = options.smallest ? reproduction.smallest_seeds : reproduction.seeds;
  const Result<std::vector<std::uint64_t>> seeds = parse_seeds(o.seeds.empty() ? usual_seeds : o.seeds);
  if (!seeds) {
    return report_error(seeds.error().message);
  }
  ReproduceParams params;
  params.out = o.out;
  params.config = config_folder(o);
  params.programs = options.programs;
  params.seeds = *seeds;
  params.overrides = o.overrides;
  params.jobs = o.jobs;
  params.show_progress = show_progress();
  params.sockets = !options.no_sockets;
  params.smallest = options.smallest;
  params.worlds = options.worlds;
  params.strategies = options.strategies;
  Report report(o.json ? nullptr : &std::cout);
  const Status done = reproduction.run(params, report);
  if (o.json) {
    std::cout << report.json() << std::flush;
  }
  if (!done) {
    return report_error(done.error().message);
  }
  return report.passed() ? kExitDone : kExitFailed;
}

}  // namespace

Verb add_search(CLI::App& app) {
  auto o = std::make_shared<SearchOptions>();
  CLI::App* verb = app.add_subcommand("search", "Searches over seeds; a file per run, a table at the end");
  o->worlds = {"demo"};
  o->strategies = {"plan"};
  add_search_options(*verb, *o);
  return [o] { return run_search_verb(*o); };
}

Verb add_compare(CLI::App& app) {
  auto o = std::make_shared<SearchOptions>();
  CLI::App* verb = app.add_subcommand("compare", "All strategies over worlds and seeds: table and chart");
  o->worlds = {"paper-a", "paper-b", "demo", "office"};
  o->strategies = {"paper", "plan", "spiral", "frontier"};
  add_search_options(*verb, *o);
  return [o] { return run_compare(*o); };
}

Verb add_reproduce(CLI::App& app) {
  auto o = std::make_shared<ReproduceOptions>();
  CLI::App* verb =
      app.add_subcommand("reproduce", "Figures, tables and pass conditions of a paper; PASS, FAIL and FINDING lines");
  verb->add_option(
          "paper", o->name,
          "search: autonomous search (s3); active-slam: active exploration (s1); stereo-database: localisation "
          "from stereo landmarks (s2); map-merging: one map of several robots (s4); line-detection: lines with "
          "automatic thresholds (s5); solids: recognition of solids under water (s6); consistency: the errors "
          "of the line filter against what it states (r2); efficiency: explorations against what somebody would "
          "drive who knows the building; efficiency-fleet: several robots that share an exploration against one")
      ->check(CLI::IsMember(reproduction_names()))
      ->capture_default_str();
  o->common.seeds.clear();
  add_common(*verb, o->common);
  verb->get_option("--seeds")->default_str("those of the paper's conditions");
  verb->add_option("--world", o->worlds,
                   "Only this world (repeatable). active-slam: " + joined(worlds_of("active-slam")) +
                       "; efficiency: " + joined(worlds_of("efficiency")) + "; efficiency-fleet: " +
                       joined(worlds_of("efficiency-fleet")) + "; map-merging: " + joined(worlds_of("map-merging")));
  verb->add_option("--strategy", o->strategies, "active-slam, efficiency: only this strategy (repeatable)")
      ->check(CLI::IsMember(explore_strategies()));
  verb->add_option("--programs", o->programs, "Folder of seekerd and seeker (default: beside this program)");
  verb->add_flag("--smallest", o->smallest,
                 "The smallest form: one seed or a few, the smallest world, fewer pictures; shows that all of it runs");
  verb->add_flag("--no-sockets", o->no_sockets, "Leave out R12, which starts server and client as processes");
  return [o, verb] { return run_reproduce(*verb, *o); };
}

}  // namespace seeker::lab
