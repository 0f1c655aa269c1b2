#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/experiments/load_run.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "common/config/yaml.hpp"
#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/active_slam/explore_picture.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/resumable.hpp"
#include "server/lab/experiments/seeds.hpp"

namespace seeker::lab {
namespace {

std::string title_of(const ExploreResult& result) {
  return "Exploration of " + result.world + ", " + result.strategy + ", seed " + std::to_string(result.seed);
}

/// Files of one run: numbers last, since they say that the run is complete.
Status keep(const ExploreSpec& spec, const ExploreRecord& record, const std::filesystem::path& out) {
  std::error_code error;
  std::filesystem::create_directories(explore_file(out, spec, ".json").parent_path(), error);
  if (Status ok = files::write_file(explore_file(out, spec, ".log"), log_text(record.events)); !ok) {
    return ok;
  }
  if (Status ok = files::write_file(explore_file(out, spec, ".csv"), curves_csv(record.samples)); !ok) {
    return ok;
  }
  const Image picture = draw_exploration(record, title_of(record.result));
  if (Status ok = image::write_png(explore_file(out, spec, ".png"), picture); !ok) {
    return ok;
  }
  return save(explore_file(out, spec, ".json"), record.result);
}

Result<std::vector<ExploreSample>> load_curves(const std::filesystem::path& out, const ExploreSpec& spec) {
  const std::filesystem::path file = explore_file(out, spec, ".csv");
  const Result<std::string> text = config::read_text_file(file);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  Result<std::vector<ExploreSample>> curves = parse_curves(*text);
  if (!curves) {
    return fail_with_context(file.string(), curves.error());
  }
  return curves;
}

using Runs = std::vector<const ExploreResult*>;

std::vector<Runs> groups_of(const std::vector<ExploreResult>& results) {
  std::vector<Runs> groups;
  for (const ExploreResult& result : results) {
    const auto same = [&](const Runs& runs) {
      return runs.front()->world == result.world && runs.front()->strategy == result.strategy;
    };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) {
      group = groups.insert(group, Runs{});
    }
    group->push_back(&result);
  }
  return groups;
}

template <class Value>
std::vector<double> values_of(const Runs& runs, Value&& value) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const ExploreResult* run : runs) {
    values.push_back(static_cast<double>(value(*run)));
  }
  return values;
}

std::vector<std::string> summary_row(const Runs& runs) {
  std::vector<std::uint64_t> seeds;
  double contacts = 0.0;
  double clearance_m = runs.front()->min_clearance_m;
  int complete = 0;
  double wall_s = 0.0;
  double robot_s = 0.0;
  for (const ExploreResult* run : runs) {
    seeds.push_back(run->seed);
    contacts += run->contacts;
    clearance_m = std::min(clearance_m, run->min_clearance_m);
    complete += run->outcome == to_string(api::Outcome::kComplete) ? 1 : 0;
    wall_s += run->wall_time_s;
    robot_s += run->robot_time_s;
  }
  const auto cell = [&](auto value, int digits) {
    const MeanSpread spread = mean_spread(values_of(runs, value));
    return fixed(spread.mean, digits) + " +- " + fixed(spread.sigma, digits);
  };
  constexpr double kPercent = 100.0;
  constexpr double kMilli = 1000.0;  // traces are small: m^2 and rad^2
  return {runs.front()->world,
          runs.front()->strategy,
          print_seeds(seeds),
          std::to_string(complete) + "/" + std::to_string(runs.size()),
          cell([](const ExploreResult& r) { return kPercent * r.wall_share; }, 1),
          cell([](const ExploreResult& r) { return r.false_wall_m; }, 1),
          cell([](const ExploreResult& r) { return r.mean_error_m; }, 3),
          cell([](const ExploreResult& r) { return kMilli * r.mean_robot_trace; }, 2),
          cell([](const ExploreResult& r) { return kMilli * r.mean_feature_trace; }, 2),
          cell([](const ExploreResult& r) { return r.path_length_m; }, 1),
          cell([](const ExploreResult& r) { return r.robot_time_s; }, 0),
          cell([](const ExploreResult& r) { return r.decisions_per_s(); }, 0),
          fixed(contacts, 0),
          fixed(clearance_m, 2),
          fixed(wall_s > 0.0 ? robot_s / wall_s : 0.0, 0)};
}

}  // namespace

std::filesystem::path explore_file(const std::filesystem::path& out, const ExploreSpec& spec,
                                   const std::string& extension) {
  return out / "runs" / spec.world_file.stem() / std::string(to_string(spec.strategy)) /
         ("seed-" + std::to_string(spec.seed) + extension);
}

Result<std::vector<ExploreResult>> explore_missing(const std::vector<ExploreSpec>& specs,
                                                   const std::filesystem::path& out, int jobs, bool show_progress) {
  RunKind<ExploreSpec, ExploreResult> kind;
  kind.file = [&](const ExploreSpec& spec) { return explore_file(out, spec, ".json"); };
  kind.settings = [](const ExploreSpec& spec) { return settings_of(spec); };
  kind.load = load_run<ExploreResult>;
  kind.make = [&](const ExploreSpec& spec, const std::string& settings) -> Result<ExploreResult> {
    Result<ExploreRecord> record = run_explore(spec);
    if (!record) {
      return tl::unexpected<Error>(record.error());
    }
    record->result.settings = settings;
    if (const Status kept = keep(spec, *record, out); !kept) {
      return tl::unexpected<Error>(kept.error());
    }
    return record->result;
  };
  kind.progress_line = [](const ExploreResult& result) {
    return result.world + " " + result.strategy + " seed " + std::to_string(result.seed) + ": " + result.outcome +
           ", " + fixed(result.wall_share, 3) + " of the walls after " + fixed(result.robot_time_s, 0) + " s (" +
           fixed(result.speed(), 0) + "x)";
  };
  return resume_runs(specs, kind, jobs, show_progress);
}

Result<std::vector<NamedCurve>> curves_of_seed(const std::vector<ExploreSpec>& specs, std::uint64_t seed,
                                               const std::filesystem::path& out) {
  std::vector<NamedCurve> curves;
  for (const ExploreSpec& spec : specs) {
    if (spec.seed != seed) {
      continue;
    }
    Result<std::vector<ExploreSample>> samples = load_curves(out, spec);
    if (!samples) {
      return tl::unexpected<Error>(samples.error());
    }
    curves.push_back({std::string(to_string(spec.strategy)), std::move(*samples)});
  }
  return curves;
}

MeanSpread mean_spread(const std::vector<double>& values) {
  if (values.empty()) {
    return {};
  }
  const auto count = static_cast<double>(values.size());
  MeanSpread spread;
  for (const double value : values) {
    spread.mean += value / count;
  }
  double sum2 = 0.0;
  for (const double value : values) {
    sum2 += (value - spread.mean) * (value - spread.mean);
  }
  spread.sigma = values.size() > 1 ? std::sqrt(sum2 / (count - 1.0)) : 0.0;
  return spread;
}

Table explore_runs_table(const std::vector<ExploreResult>& results) {
  Table table({"world",
               "strategy",
               "seed",
               "outcome",
               "wall_share",
               "reachable_wall_m",
               "false_wall_m",
               "mean_error_m",
               "max_error_m",
               "final_error_m",
               "mean_robot_trace",
               "final_robot_trace",
               "mean_feature_trace",
               "final_full_trace",
               "path_m",
               "robot_time_s",
               "wall_time_s",
               "x_real_time",
               "decisions",
               "decisions_per_s",
               "contacts",
               "min_clearance_m",
               "unreachable",
               "segments",
               "map_epoch",
               "event_hash"});
  for (const ExploreResult& r : results) {
    table.add({r.world,
               r.strategy,
               std::to_string(r.seed),
               r.outcome,
               fixed(r.wall_share, 4),
               fixed(r.reachable_wall_m, 2),
               fixed(r.false_wall_m, 2),
               fixed(r.mean_error_m, 4),
               fixed(r.max_error_m, 4),
               fixed(r.final_error_m, 4),
               fixed(r.mean_robot_trace, 7),
               fixed(r.final_robot_trace, 7),
               fixed(r.mean_feature_trace, 7),
               fixed(r.final_full_trace, 6),
               fixed(r.path_length_m, 2),
               fixed(r.robot_time_s, 1),
               fixed(r.wall_time_s, 2),
               fixed(r.speed(), 1),
               std::to_string(r.decisions),
               fixed(r.decisions_per_s(), 1),
               std::to_string(r.contacts),
               fixed(r.min_clearance_m, 3),
               std::to_string(r.unreachable),
               std::to_string(r.segments),
               std::to_string(r.map_epoch),
               r.event_hash});
  }
  return table;
}

std::string explore_json(const std::vector<ExploreResult>& results) {
  auto list = nlohmann::ordered_json::array();
  for (ExploreResult result : results) {
    list.push_back(described([&](config::Fields& fields) { describe(fields, result); }));
  }
  return json_lines(list);
}

Table explore_summary_table(const std::vector<ExploreResult>& results) {
  Table table({"world", "strategy", "seeds", "complete", "walls, %", "false, m", "error, m", "robot trace, 1e-3",
               "segment trace, 1e-3", "path, m", "time, s", "decisions/s", "contacts", "least clearance, m",
               "x real time"});
  for (const Runs& runs : groups_of(results)) {
    table.add(summary_row(runs));
  }
  return table;
}

Status write_table(const std::filesystem::path& out, const Table& table) {
  if (Status ok = files::write_file(out / "table.csv", table.csv()); !ok) {
    return ok;
  }
  return files::write_file(out / "table.md", table.markdown());
}

Status write_explore_tables(const std::filesystem::path& out, const Table& summary,
                            const std::vector<ExploreResult>& results) {
  if (Status ok = write_table(out, summary); !ok) {
    return ok;
  }
  return files::write_file(out / "runs.csv", explore_runs_table(results).csv());
}

}  // namespace seeker::lab
