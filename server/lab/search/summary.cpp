#include "server/lab/search/summary.hpp"
#include "server/lab/experiments/seeds.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "common/image/plot.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/plots/image_tools.hpp"
#include "server/lab/search/search_experiment.hpp"

namespace seeker::lab {
namespace {

using Runs = std::vector<const RunResult*>;

GroupSummary summarise_group(const Runs& runs) {
  GroupSummary group;
  group.world = runs.front()->world;
  group.strategy = runs.front()->strategy;
  group.runs = static_cast<int>(runs.size());
  group.covered_share_min = group.min_clearance_m = 1e9;
  std::vector<std::uint64_t> seeds;
  double wall_s = 0.0;
  const double n = static_cast<double>(runs.size());
  for (const RunResult* run : runs) {
    seeds.push_back(run->seed);
    group.found += run->found ? 1 : 0;
    group.false_finds += run->false_finds;
    group.path_length_m += run->path_length_m / n;
    group.target_path_m += run->found ? run->target_path_m : 0.0;
    group.robot_time_s += run->robot_time_s / n;
    group.cells_visited += run->cells_visited / n;
    group.cells_repeated += run->cells_repeated / n;
    group.cells_searched += run->cells_searched / n;
    group.covered_share += run->covered_share / n;
    group.covered_share_min = std::min(group.covered_share_min, run->covered_share);
    group.covered_true_share += run->covered_true_share / n;
    group.mean_probability += run->mean_probability / n;
    group.contacts += run->contacts;
    group.min_clearance_m = std::min(group.min_clearance_m, run->min_clearance_m);
    if (run->first_find) {
      group.bearing_error_deg = std::max(group.bearing_error_deg, run->first_find->bearing_error_deg);
    }
    if (run->last_find) {
      group.position_error_m = std::max(group.position_error_m, run->last_find->position_error_m.value_or(0.0));
      group.aligned_error_m = std::max(group.aligned_error_m, run->last_find->aligned_error_m.value_or(0.0));
    }
    group.localisation_error_m = std::max(group.localisation_error_m, run->max_localisation_error_m);
    wall_s += run->wall_time_s;
  }
  group.target_path_m /= std::max(1, group.found);
  group.speed = wall_s > 0.0 ? group.robot_time_s * n / wall_s : 0.0;
  group.seeds = print_seeds(seeds);
  return group;
}

std::vector<std::string> find_cells(const std::optional<FindScore>& find) {
  if (!find) {
    return {"", "", "", "", ""};
  }
  return {fixed(find->bearing_error_deg, 2), find->position_error_m ? fixed(*find->position_error_m, 3) : "",
          find->range_source, fixed(find->range_m, 2), std::to_string(find->cells_searched)};
}

struct Column {
  const char* name;
  std::string (*value)(const GroupSummary&);
};

/// The columns of the summary, for CSV, text and JSON alike.
const std::vector<Column>& columns() {
  static const std::vector<Column> all = {
      {"world", [](const GroupSummary& g) { return g.world; }},
      {"strategy", [](const GroupSummary& g) { return g.strategy; }},
      {"seeds", [](const GroupSummary& g) { return g.seeds; }},
      {"runs", [](const GroupSummary& g) { return std::to_string(g.runs); }},
      {"found", [](const GroupSummary& g) { return std::to_string(g.found); }},
      {"false", [](const GroupSummary& g) { return std::to_string(g.false_finds); }},
      {"path_m", [](const GroupSummary& g) { return fixed(g.path_length_m, 1); }},
      {"path_to_target_m", [](const GroupSummary& g) { return g.found > 0 ? fixed(g.target_path_m, 1) : ""; }},
      {"time_s", [](const GroupSummary& g) { return fixed(g.robot_time_s, 0); }},
      {"cells", [](const GroupSummary& g) { return fixed(g.cells_visited, 1); }},
      {"repeated", [](const GroupSummary& g) { return fixed(g.cells_repeated, 1); }},
      {"covered", [](const GroupSummary& g) { return fixed(g.covered_share, 3); }},
      {"covered_min", [](const GroupSummary& g) { return fixed(g.covered_share_min, 3); }},
      {"of_true_floor", [](const GroupSummary& g) { return fixed(g.covered_true_share, 3); }},
      {"mean_p", [](const GroupSummary& g) { return fixed(g.mean_probability, 3); }},
      {"contacts", [](const GroupSummary& g) { return std::to_string(g.contacts); }},
      {"clearance_m", [](const GroupSummary& g) { return fixed(g.min_clearance_m, 2); }},
      {"bearing_max_deg", [](const GroupSummary& g) { return fixed(g.bearing_error_deg, 1); }},
      {"position_max_m", [](const GroupSummary& g) { return fixed(g.position_error_m, 2); }},
      {"aligned_max_m", [](const GroupSummary& g) { return fixed(g.aligned_error_m, 2); }},
      {"pose_max_m", [](const GroupSummary& g) { return fixed(g.localisation_error_m, 2); }},
      {"x_real_time", [](const GroupSummary& g) { return fixed(g.speed, 0); }},
  };
  return all;
}

Table summary_table(const std::vector<GroupSummary>& groups) {
  std::vector<std::string> header;
  for (const Column& column : columns()) {
    header.emplace_back(column.name);
  }
  Table table(header);
  for (const GroupSummary& group : groups) {
    std::vector<std::string> row;
    for (const Column& column : columns()) {
      row.push_back(column.value(group));
    }
    table.add(std::move(row));
  }
  return table;
}

/// One chart: a group of bars for every world, one bar for every strategy.
Image bars(const std::vector<GroupSummary>& groups, const std::string& title, const std::string& unit,
           double (*value)(const GroupSummary&)) {
  image::Chart chart;
  chart.title = title;
  chart.y_label = unit;
  for (const GroupSummary& group : groups) {
    const auto world = std::find(chart.x_names.begin(), chart.x_names.end(), group.world);
    const auto x = static_cast<double>(world - chart.x_names.begin());
    if (world == chart.x_names.end()) {
      chart.x_names.push_back(group.world);
    }
    auto series = std::find_if(chart.series.begin(), chart.series.end(),
                               [&](const image::Series& s) { return s.name == group.strategy; });
    if (series == chart.series.end()) {
      series =
          chart.series.insert(series, {.name = group.strategy, .x = {}, .y = {}, .style = image::SeriesStyle::kBars});
    }
    series->x.push_back(x);
    series->y.push_back(value(group));
  }
  double highest = 0.0;
  for (const GroupSummary& group : groups) {
    highest = std::max(highest, value(group));
  }
  constexpr double kRoomForLegend = 1.45;
  chart.y_range = {0.0, highest > 0.0 ? kRoomForLegend * highest : 1.0};
  constexpr int kWidth_px = 720;
  constexpr int kHeight_px = 420;
  return image::draw_chart(chart, kWidth_px, kHeight_px);
}

}  // namespace

std::vector<GroupSummary> summarise(const std::vector<RunResult>& results) {
  std::vector<Runs> groups;
  for (const RunResult& result : results) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Runs& runs) {
      return runs.front()->world == result.world && runs.front()->strategy == result.strategy;
    });
    if (group == groups.end()) {
      group = groups.insert(group, Runs{});
    }
    group->push_back(&result);
  }
  std::vector<GroupSummary> summaries;
  summaries.reserve(groups.size());
  for (const Runs& runs : groups) {
    summaries.push_back(summarise_group(runs));
  }
  return summaries;
}

namespace {

std::vector<std::string> run_columns() {
  return {"world",
          "strategy",
          "seed",
          "outcome",
          "found",
          "false_finds",
          "first_bearing_deg",
          "first_position_m",
          "first_source",
          "first_range_m",
          "first_cells",
          "last_bearing_deg",
          "last_position_m",
          "last_source",
          "last_range_m",
          "last_cells",
          "path_m",
          "path_to_target_m",
          "robot_time_s",
          "wall_time_s",
          "x_real_time",
          "cells_searched",
          "cells_visited",
          "cells_repeated",
          "covered_share",
          "covered_true_share",
          "mean_probability",
          "gaps",
          "contacts",
          "min_clearance_m",
          "pose_error_m",
          "pose_error_deg",
          "pose_error_max_m",
          "events",
          "event_hash"};
}

std::vector<std::string> run_row(const RunResult& r) {
  std::vector<std::string> row = {r.world,   r.strategy,          std::to_string(r.seed),
                                  r.outcome, r.found ? "1" : "0", std::to_string(r.false_finds)};
  for (const auto* find : {&r.first_find, &r.last_find}) {
    const std::vector<std::string> cells = find_cells(*find);
    row.insert(row.end(), cells.begin(), cells.end());
  }
  const std::vector<std::string> rest = {fixed(r.path_length_m, 2),
                                         fixed(r.target_path_m, 2),
                                         fixed(r.robot_time_s, 1),
                                         fixed(r.wall_time_s, 2),
                                         fixed(r.speed(), 1),
                                         std::to_string(r.cells_searched),
                                         std::to_string(r.cells_visited),
                                         std::to_string(r.cells_repeated),
                                         fixed(r.covered_share, 4),
                                         fixed(r.covered_true_share, 4),
                                         fixed(r.mean_probability, 4),
                                         std::to_string(r.gaps),
                                         std::to_string(r.contacts),
                                         fixed(r.min_clearance_m, 3),
                                         fixed(r.localisation_error_m, 3),
                                         fixed(r.localisation_error_deg, 2),
                                         fixed(r.max_localisation_error_m, 3),
                                         std::to_string(r.events),
                                         r.event_hash};
  row.insert(row.end(), rest.begin(), rest.end());
  return row;
}

}  // namespace

std::string runs_csv(const std::vector<RunResult>& results) {
  Table table(run_columns());
  for (const RunResult& result : results) {
    table.add(run_row(result));
  }
  return table.csv();
}

std::string summary_csv(const std::vector<GroupSummary>& groups) { return summary_table(groups).csv(); }
std::string summary_text(const std::vector<GroupSummary>& groups) { return summary_table(groups).text(); }

std::string summary_json(const std::vector<GroupSummary>& groups) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const GroupSummary& group : groups) {
    constexpr std::size_t kTextColumns = 3;
    Json& row = list.emplace_back();
    for (std::size_t i = 0; i < columns().size(); ++i) {
      const std::string value = columns()[i].value(group);
      row[columns()[i].name] = i < kTextColumns ? Json(value) : (value.empty() ? Json() : Json::parse(value));
    }
  }
  return json_lines(list);
}

Image comparison_chart(const std::vector<GroupSummary>& groups) {
  const std::vector<CaptionedImage> charts = {
      {"", bars(groups, "runs that find the target", "share",
                [](const GroupSummary& g) { return static_cast<double>(g.found) / std::max(1, g.runs); })},
      {"", bars(groups, "path driven", "m, mean", [](const GroupSummary& g) { return g.path_length_m; })},
      {"", bars(groups, "floor covered (evidence of 0.5 or more)", "share of the true reachable floor",
                [](const GroupSummary& g) { return g.covered_true_share; })},
      {"", bars(groups, "repeated cells", "entries, mean", [](const GroupSummary& g) { return g.cells_repeated; })}};
  return contact_sheet(charts, 2);
}

}  // namespace seeker::lab
