#include "client/cli/script.hpp"

#include "client/cli/targets.hpp"
#include "client/values/names.hpp"
#include "common/config/yaml.hpp"
#include "common/core/angle.hpp"

namespace seeker::cli {
namespace {

const config::Choices<api::SearchMode> kModes{{"paper", api::SearchMode::kPaper}, {"plan", api::SearchMode::kPlan}};
const config::Choices<api::OnFound> kOnFound{
    {"stop", api::OnFound::kStop}, {"approach", api::OnFound::kApproach}, {"continue", api::OnFound::kContinue}};
const config::Choices<api::ExploreStrategy> kStrategies = config::choices_of(api::kExploreStrategies);

/// Outcomes and error codes as they may stand in an expectation.
const std::vector<std::string>& outcome_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names{""};
    for (int n = 0; n <= static_cast<int>(api::Outcome::kFault); ++n) {
      names.emplace_back(to_string(static_cast<api::Outcome>(n)));
    }
    return names;
  }();
  return kNames;
}

const std::vector<std::string>& error_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names{""};
    for (int n = 0; n <= static_cast<int>(Errc::kInternal); ++n) {
      names.emplace_back(to_string(static_cast<Errc>(n)));
    }
    return names;
  }();
  return kNames;
}

void name_of(config::Fields& f, std::string_view key, std::string& value, const std::vector<std::string>& names) {
  config::Choices<std::string> choices;
  for (const std::string& name : names) {
    choices.emplace_back(name, name);
  }
  f.choice(key, value, choices);
}

/// "300s" and the like.
void duration(config::Fields& f, std::string_view key, std::optional<Duration>& value) {
  std::string text;
  f.field(key, text);
  if (!f.has(key)) {
    return;
  }
  const Result<Duration> parsed = parse_duration(text);
  f.check(key, parsed.has_value(), parsed ? "" : parsed.error().message);
  if (parsed) {
    value = *parsed;
  }
}

void polygon(config::Fields& f, std::string_view key, Polygon& value) {
  f.field(key, value);
  if (f.has(key)) {
    const Status ok = validate_polygon(value);
    f.check(key, ok.has_value(), ok ? "" : ok.error().message);
  }
}

void bound(config::Fields& f, std::optional<Polygon>& value) {
  if (f.has("bound")) {
    value.emplace();
  }
  Polygon none;
  polygon(f, "bound", value ? *value : none);
}

/// An item of keep_out.
struct Area {
  Polygon corners;
};
void describe(config::Fields& f, Area& area) {
  f.require("corners");
  polygon(f, "corners", area.corners);
}

void areas(config::Fields& f, std::vector<Polygon>& keep_out) {
  std::vector<Area> list;
  f.list("keep_out", list);
  for (Area& area : list) {
    keep_out.push_back(std::move(area.corners));
  }
}

/// "return", or "2:event,5:pause,30:return".
void link_policy(config::Fields& f, Step& step) {
  constexpr std::string_view kKey = "link_policy";
  std::string text;
  f.field(kKey, text);
  if (!f.has(kKey)) {
    return;
  }
  const Result<LinkChoice> parsed = parse_link_policy(text);
  f.check(kKey, parsed.has_value(), parsed ? "" : parsed.error().message);
  if (parsed) {
    step.link_policy = parsed->policy;
    step.link_steps = parsed->steps;
  }
}

/// What all missions of a script share.
void describe_mission(config::Fields& f, Step& step) {
  f.field("background", step.background);
  link_policy(f, step);
  duration(f, "time_limit", step.time_limit);
}

/// What is looked for: SearchStep or RecogniseStep.
template <class What>
void describe_targets(config::Fields& f, What& step) {
  f.field("targets", step.targets);
  f.field("solids", step.solids);
  const std::size_t count = step.targets.size() + step.solids.size();
  f.check("targets", count > 0 && count <= api::kMaxTargets, "name 1 to 16 targets, solids among them");
  for (const std::string& solid : step.solids) {
    f.check("solids", solid_named(solid).has_value(), "'" + solid + "' is none of " + listed(kSolidKinds));
  }
  name_of(f, "recogniser", step.recogniser, {"", "template", "features"});
}

struct SearchSection {
  SearchStep search;
  Step step;
};
void describe(config::Fields& f, SearchSection& s) {
  describe_targets(f, s.search);
  f.choice("mode", s.search.mode, kModes);
  f.choice("on_found", s.search.on_found, kOnFound);
  bound(f, s.search.bound);
  areas(f, s.search.keep_out);
  f.field("gaps_only", s.search.gaps_only);
  f.field("explore", s.search.explore);
  describe_mission(f, s.step);
}

struct ExploreSection {
  ExploreStep explore;
  Step step;
};
void describe(config::Fields& f, ExploreSection& s) {
  f.choice("strategy", s.explore.strategy, kStrategies);
  bound(f, s.explore.bound);
  areas(f, s.explore.keep_out);
  f.field("return_to_start", s.explore.return_to_start);
  describe_mission(f, s.step);
}

struct GotoSection {
  GotoStep go;
  Step step;
};
void describe(config::Fields& f, GotoSection& s) {
  f.require("waypoints");
  f.field("waypoints", s.go.waypoints);
  f.check("waypoints", !s.go.waypoints.empty(), "give at least one point [x, y]");
  double heading_rad = 0.0;
  f.angle_deg("heading_deg", heading_rad);
  if (f.has("heading_deg")) {
    s.go.heading_rad = wrap_angle(heading_rad);
  }
  areas(f, s.go.keep_out);
  describe_mission(f, s.step);
}

struct SurveySection {
  SurveyStep survey;
  Step step;
};
void describe(config::Fields& f, SurveySection& s) {
  f.require("landmarks");
  f.field("landmarks", s.survey.landmarks);
  f.field("places", s.survey.places);
  f.field("headings", s.survey.headings);
  f.field("replace", s.survey.replace);
  areas(f, s.survey.keep_out);
  describe_mission(f, s.step);
}

struct LocaliseSection {
  LocaliseStep localise;
  Step step;
};
void describe(config::Fields& f, LocaliseSection& s) {
  f.require("landmarks");
  f.field("landmarks", s.localise.landmarks);
  f.field("headings", s.localise.headings);
  describe_mission(f, s.step);
}

struct RecogniseSection {
  RecogniseStep recognise;
  Step step;
};
void describe(config::Fields& f, RecogniseSection& s) {
  describe_targets(f, s.recognise);
  f.field("headings", s.recognise.headings);
  describe_mission(f, s.step);
}

struct ReturnSection {
  Step step;
};
void describe(config::Fields& f, ReturnSection& s) { describe_mission(f, s.step); }

struct DriveSection {
  DriveStep drive;
};
void describe(config::Fields& f, DriveSection& s) {
  f.field("v_m_s", s.drive.velocity.v_m_s);
  f.angle_deg("omega_deg_s", s.drive.velocity.omega_rad_s);
  std::optional<Duration> time;
  duration(f, "for", time);
  constexpr double kLongest_s = 600.0;
  f.check("for", !time || to_seconds(*time) <= kLongest_s, "at most 600s");
  s.drive.duration = time.value_or(s.drive.duration);
}

struct EstopSection {
  EstopStep estop;
};
void describe(config::Fields& f, EstopSection& s) { f.field("release", s.estop.release); }

struct FleetSection {
  FleetStep fleet;
};
void describe(config::Fields& f, FleetSection& s) {
  f.field("merged", s.fleet.merged);
  f.check("merged", s.fleet.merged >= 1 && s.fleet.merged <= kMaxRobots, "must be from 1 to 16 robots");
  std::optional<Duration> limit;
  duration(f, "limit", limit);
  s.fleet.limit = limit.value_or(s.fleet.limit);
}

struct EmptySection {};
void describe(config::Fields& /*f*/, EmptySection& /*section*/) {}

struct ExpectSection {
  Expectation expect;
};
void describe(config::Fields& f, ExpectSection& s) {
  name_of(f, "outcome", s.expect.outcome, outcome_names());
  duration(f, "within", s.expect.within);
  name_of(f, "error", s.expect.error, error_names());
  f.field("found", s.expect.found);
  f.optional_field("covered", s.expect.covered);
  f.check("covered", !s.expect.covered || (*s.expect.covered >= 0.0 && *s.expect.covered <= 1.0),
          "must be a share from 0 to 1");
}

/// A step while it is read.
struct StepItem {
  Step step;
};

/// Reads the section `key` when it is there and counts it.
template <class Section, class Take>
void action(config::Fields& f, std::string_view key, Step& step, int& count, Take take) {
  std::optional<Section> section;
  f.optional_section(key, section);
  if (section) {
    ++count;
    step.kind = key;
    take(*section);
  }
}

/// Copies what a mission's section read into the step.
void keep_mission(Step& step, const Step& read) {
  step.background = read.background;
  step.link_policy = read.link_policy;
  step.link_steps = read.link_steps;
  step.time_limit = read.time_limit;
}

void describe_missions(config::Fields& f, Step& step, int& count) {
  action<SearchSection>(f, "search", step, count, [&](SearchSection& s) {
    step.action = s.search;
    keep_mission(step, s.step);
  });
  action<ExploreSection>(f, "explore", step, count, [&](ExploreSection& s) {
    step.action = s.explore;
    keep_mission(step, s.step);
  });
  action<GotoSection>(f, "goto", step, count, [&](GotoSection& s) {
    step.action = s.go;
    keep_mission(step, s.step);
  });
  action<SurveySection>(f, "survey", step, count, [&](SurveySection& s) {
    step.action = s.survey;
    keep_mission(step, s.step);
  });
  action<LocaliseSection>(f, "localise", step, count, [&](LocaliseSection& s) {
    step.action = s.localise;
    keep_mission(step, s.step);
  });
  action<RecogniseSection>(f, "recognise", step, count, [&](RecogniseSection& s) {
    step.action = s.recognise;
    keep_mission(step, s.step);
  });
  action<ReturnSection>(f, "return", step, count, [&](ReturnSection& s) {
    step.action = ReturnStep{};
    keep_mission(step, s.step);
  });
  action<EmptySection>(f, "await", step, count, [&](EmptySection&) { step.action = AwaitStep{}; });
}

void describe(config::Fields& f, StepItem& item) {
  Step& step = item.step;
  int count = 0;
  describe_missions(f, step, count);
  action<DriveSection>(f, "drive", step, count, [&](DriveSection& s) { step.action = s.drive; });
  action<EmptySection>(f, "pause", step, count,
                       [&](EmptySection&) { step.action = CommandStep{api::MissionCommand::kPause}; });
  action<EmptySection>(f, "resume", step, count,
                       [&](EmptySection&) { step.action = CommandStep{api::MissionCommand::kResume}; });
  action<EmptySection>(f, "stop", step, count,
                       [&](EmptySection&) { step.action = CommandStep{api::MissionCommand::kStop}; });
  action<EstopSection>(f, "estop", step, count, [&](EstopSection& s) { step.action = s.estop; });
  action<FleetSection>(f, "fleet", step, count, [&](FleetSection& s) { step.action = s.fleet; });
  std::optional<Duration> wait;
  duration(f, "wait", wait);
  std::string export_name;
  f.field("map_export", export_name);
  if (f.has("wait")) {
    ++count;
    step.kind = "wait";
    step.action = WaitStep{wait.value_or(Duration::zero())};
  }
  if (f.has("map_export")) {
    ++count;
    step.kind = "map_export";
    step.action = ExportStep{export_name};
    f.check("map_export", !export_name.empty(), "name the files without extension");
  }
  ExpectSection expect;
  f.section("expect", expect);
  step.expect = expect.expect;
  f.check("expect", count == 1,
          "a step does exactly one of search, recognise, explore, goto, survey, localise, return, await, wait, drive, "
          "pause, resume, stop, estop, fleet, map_export");
}

struct ScriptFile {
  std::string name;
  std::string robot;
  std::string world;
  int robots = 1;
  std::vector<StepItem> steps;
};
void describe(config::Fields& f, ScriptFile& script) {
  f.field("name", script.name);
  f.field("robot", script.robot);
  f.field("world", script.world);
  f.field("robots", script.robots);
  f.check("robots", script.robots >= 1 && script.robots <= kMaxRobots, "must be from 1 to 16");
  f.require("steps");
  f.list("steps", script.steps);
  f.check("steps", !script.steps.empty() && script.steps.size() <= kMaxSteps, "must have 1 to 1000 steps");
}

}  // namespace

Result<Script> parse_script(std::string_view text, const std::string& name) {
  const Result<config::Document> document = config::Document::parse(text, name);
  if (!document) {
    return tl::unexpected<Error>(document.error());
  }
  ScriptFile file;
  if (const Status ok = document->read(file); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  Script script;
  script.name = file.name.empty() ? std::filesystem::path(name).stem().string() : file.name;
  script.robot = file.robot;
  script.world = file.world;
  script.robots = file.robots;
  for (StepItem& item : file.steps) {
    script.steps.push_back(std::move(item.step));
  }
  return script;
}

}  // namespace seeker::cli
