#include <iomanip>

#include <nlohmann/json.hpp>

#include "client/cli/export_check.hpp"
#include "client/cli/scene.hpp"
#include "client/cli/targets.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"
#include "common/core/angle.hpp"

namespace seeker::cli {
namespace {

Result<std::vector<Polygon>> parse_areas(const std::vector<std::string>& texts) {
  std::vector<Polygon> areas;
  for (const std::string& text : texts) {
    Result<Polygon> area = parse_polygon(text);
    if (!area) {
      return tl::unexpected<Error>(area.error());
    }
    areas.push_back(std::move(*area));
  }
  return areas;
}

/// --bound and --keep-out of a verb.
template <class Verb, class Mission>
Status take_areas(const Verb& verb, Mission& mission) {
  if (!verb.bound.empty()) {
    Result<Polygon> bound = parse_polygon(verb.bound);
    if (!bound) {
      return fail_with_context("--bound", bound.error());
    }
    mission.bound = std::move(*bound);
  }
  Result<std::vector<Polygon>> keep_out = parse_areas(verb.keep_out);
  if (!keep_out) {
    return fail_with_context("--keep-out", keep_out.error());
  }
  mission.keep_out = std::move(*keep_out);
  return {};
}

Result<api::MissionRequest> checked(api::MissionRequest request) {
  if (const Status ok = api::validate(request); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return request;
}

std::vector<api::Gap> fetch_gaps(const Context& context) {
  const Result<api::GridReport> grid = ask<api::GridReport>(context, &api::RobotApi::get_grid);
  return grid ? grid->evidence.gaps : std::vector<api::Gap>();
}

void print_json(const Context& context, const MissionReport& report, const std::vector<api::Gap>& gaps) {
  const api::MissionStatus& m = report.status;
  const Json json = {{"mission", m.id},
                     {"kind", m.kind},
                     {"outcome", to_string(m.end->outcome)},
                     {"cause", m.end->cause},
                     {"remedy", m.end->remedy},
                     {"exit_code", static_cast<int>(exit_code(m))},
                     {"detections", report.detections},
                     {"coverage", or_null(m.coverage)},
                     {"gaps", gaps},
                     {"unreachable", positions_of(m.end->unreachable)},
                     {"unreachable_places", m.end->unreachable},
                     {"cells_searched", m.cells_searched},
                     {"cells_unsearched", m.cells_unsearched},
                     {"path_length_m", m.path_length_m},
                     {"robot_time_s", to_seconds(m.updated - m.started)},
                     {"wall_time_s", to_seconds(report.wall)}};
  *context.out << json_line(json) << '\n';
}

VerbResult run_mission(const Context& context, const api::MissionRequest& request, bool detach,
                       const std::string& save) {
  if (const Status ok = save.empty() ? Status() : check_map_export(save); !ok) {
    return fail_with_context("--save", ok.error());
  }
  Result<MissionRun> run = MissionRun::start(context, request);
  if (!run) {
    return tl::unexpected<Error>(run.error());
  }
  if (detach) {
    *context.out << (context.json ? json_line(Json{{"mission", request.id}, {"link_steps", run->link_steps()}})
                                  : request.id)
                 << '\n';
    return ExitCode::kOk;
  }
  say(context, "mission " + request.id + " started; if this client is lost the robot does: " +
                   text_of(run->link_steps(), request.link_policy));
  FollowOptions options;
  options.wall = context.timeout;
  options.decisions = true;
  Result<MissionReport> report = run->follow(context, options);
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  print_report(
      context, *report,
      std::holds_alternative<api::SearchMission>(request.task) ? fetch_gaps(context) : std::vector<api::Gap>());
  if (!save.empty()) {
    const auto files = export_map(context, save);
    if (!files) {
      return tl::unexpected<Error>(files.error());
    }
    for (const std::filesystem::path& file : *files) {
      say(context, "wrote " + file.string());
    }
  }
  return exit_code(report->status);
}

/// A request with everything but its task.
api::MissionRequest begin_request(const MissionOptions& options, const std::string& kind) {
  api::MissionRequest request;
  request.id = options.id.empty() ? make_mission_id(kind) : options.id;
  // The parser has refused what is none.
  const LinkChoice link = parse_link_policy(options.link_policy).value_or(LinkChoice{});
  request.link_policy = link.policy;
  request.link_steps = link.steps;
  if (options.time_limit_s) {
    request.time_limit = seconds(*options.time_limit_s);
  }
  return request;
}

Result<std::vector<api::TargetSpec>> targets_of(const TargetOptions& o) {
  Result<std::vector<api::TargetSpec>> targets = load_targets(
      o.targets, o.solids, {o.recogniser, o.width_m, o.height_m, o.depth_m}, target_folders(o.target_folders));
  return targets ? std::move(targets) : fail_as_usage(targets.error());
}

/// Each "X,Y" in metres.
Result<std::vector<Point2>> parse_points(const std::vector<std::string>& texts) {
  std::vector<Point2> points;
  for (const std::string& text : texts) {
    const Result<Point2> point = parse_point(text);
    if (!point) {
      return tl::unexpected<Error>(point.error());
    }
    points.push_back(*point);
  }
  return points;
}

}  // namespace

Result<api::MissionRequest> make_request(const SearchVerb& verb) {
  api::SearchMission search;
  Result<std::vector<api::TargetSpec>> targets = targets_of(verb);
  if (!targets) {
    return tl::unexpected<Error>(targets.error());
  }
  search.targets = std::move(*targets);
  if (const Status ok = take_areas(verb, search); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  search.mode = parse_search_mode(verb.mode);
  search.on_found = parse_on_found(verb.on_found);
  search.gaps_only = verb.gaps_only;
  search.explore = verb.explore;
  api::MissionRequest request = begin_request(verb, "search");
  request.task = std::move(search);
  return checked(std::move(request));
}

Result<api::MissionRequest> make_request(const ExploreVerb& verb) {
  api::ExploreMission explore;
  if (const Status ok = take_areas(verb, explore); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  explore.strategy = parse_explore_strategy(verb.strategy);
  explore.return_to_start = verb.return_to_start;
  api::MissionRequest request = begin_request(verb, "explore");
  request.task = std::move(explore);
  return checked(std::move(request));
}

Result<api::MissionRequest> make_request(const GotoVerb& verb) {
  api::MissionRequest request = begin_request(verb, verb.home ? "return" : "goto");
  Result<std::vector<Polygon>> keep_out = parse_areas(verb.keep_out);
  if (!keep_out) {
    return fail_with_context("--keep-out", keep_out.error());
  }
  if (verb.home) {
    request.task = api::ReturnMission{std::nullopt, std::move(*keep_out)};
    return checked(std::move(request));
  }
  if (verb.points.empty()) {
    return fail(Errc::kInvalidArgument, "goto needs points X,Y in metres, as in seeker goto 3,4.5, or --home");
  }
  api::GotoMission go;
  Result<std::vector<Point2>> points = parse_points(verb.points);
  if (!points) {
    return tl::unexpected<Error>(points.error());
  }
  go.waypoints = std::move(*points);
  if (verb.heading_deg) {
    go.final_heading_rad = wrap_angle(deg_to_rad(*verb.heading_deg));
  }
  go.keep_out = std::move(*keep_out);
  request.task = std::move(go);
  return checked(std::move(request));
}

Result<api::MissionRequest> make_request(const SurveyVerb& verb) {
  Result<std::vector<Point2>> places = parse_points(verb.places);
  if (!places) {
    return fail_with_context("--at", places.error());
  }
  Result<std::vector<Polygon>> keep_out = parse_areas(verb.keep_out);
  if (!keep_out) {
    return fail_with_context("--keep-out", keep_out.error());
  }
  api::MissionRequest request = begin_request(verb, "survey");
  request.task = api::SurveyMission{verb.name, std::move(*places), verb.headings, verb.replace, std::move(*keep_out)};
  return checked(std::move(request));
}

Result<api::MissionRequest> make_request(const LocaliseVerb& verb) {
  api::MissionRequest request = begin_request(verb, "localise");
  request.task = api::LocaliseMission{verb.name, verb.headings};
  return checked(std::move(request));
}

Result<api::MissionRequest> make_request(const RecogniseVerb& verb) {
  Result<std::vector<api::TargetSpec>> targets = targets_of(verb);
  if (!targets) {
    return tl::unexpected<Error>(targets.error());
  }
  api::MissionRequest request = begin_request(verb, "recognise");
  request.task = api::RecogniseMission{std::move(*targets), verb.headings};
  return checked(std::move(request));
}

void print_report(const Context& context, const MissionReport& report, const std::vector<api::Gap>& gaps) {
  if (context.json) {
    print_json(context, report, gaps);
    return;
  }
  const api::MissionStatus& m = report.status;
  const auto row = [&](const char* name, const std::string& value) {
    constexpr int kColumn = 12;
    *context.out << std::left << std::setw(kColumn) << name << value << '\n';
  };
  row("outcome", std::string(to_string(m.end->outcome)));
  row("cause", m.end->cause);
  if (!m.end->remedy.empty()) {
    row("remedy", m.end->remedy);
  }
  for (const api::Detection& detection : report.detections) {
    row("found", text_of(detection));
  }
  for (const UnreachablePlace& place : m.end->unreachable) {
    row("unreachable", describe(place));
  }
  if (m.coverage) {
    row("covered", text_of(*m.coverage));
    row("cells", std::to_string(m.cells_searched) + " searched, " + std::to_string(m.cells_unsearched) + " left");
    row("gaps", std::to_string(lines_of(gaps).size()));
  }
  for (const std::string& gap : lines_of(gaps)) {
    row("", gap);
  }
  row("path", fixed("%.1f m", m.path_length_m));
  row("time",
      fixed("%.1f s robot, ", to_seconds(m.updated - m.started)) + fixed("%.1f s wall", to_seconds(report.wall)));
}

VerbResult search(const Context& context, const api::MissionRequest& request, const SearchVerb& verb) {
  return run_mission(context, request, verb.detach, verb.save);
}

VerbResult explore(const Context& context, const api::MissionRequest& request, const ExploreVerb& verb) {
  return run_mission(context, request, verb.detach, verb.save);
}

VerbResult survey(const Context& context, const api::MissionRequest& request, const SurveyVerb& verb) {
  return run_mission(context, request, verb.detach, "");
}

VerbResult localise(const Context& context, const api::MissionRequest& request, const LocaliseVerb& verb) {
  return run_mission(context, request, verb.detach, "");
}

VerbResult recognise(const Context& context, const api::MissionRequest& request, const RecogniseVerb& verb) {
  return run_mission(context, request, verb.detach, "");
}

VerbResult go(const Context& context, const api::MissionRequest& request, const GotoVerb& verb) {
  return run_mission(context, request, verb.detach, "");
}

}  // namespace seeker::cli
