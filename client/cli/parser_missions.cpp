// Missions: what every one has, and what each is told.

#include <CLI/CLI.hpp>

#include "client/cli/parser_parts.hpp"
#include "client/cli/targets.hpp"
#include "client/values/names.hpp"
#include "common/config/number_text.hpp"

namespace seeker::cli {
namespace {

/// The short form, which completion offers, or a list.
CLI::Validator is_link_policy() {
  return {[](const std::string& text) {
            const Result<LinkChoice> choice = parse_link_policy(text);
            return choice ? std::string() : choice.error().message;
          },
          "{stop,finish-step,continue,return}"};
}

/// What every mission has; the option --detach.
template <class Verb>
CLI::Option* add_mission_options(CLI::App& sub, Verb& verb) {
  sub.add_option("--time-limit", verb.time_limit_s, "Longest robot time, s")
      ->check(config::number_above_zero, "above 0");
  sub.add_option("--link-policy", verb.link_policy,
                 "What the robot does when this client is gone, or a list by seconds of silence, as in "
                 "2:event,5:pause,30:return")
      ->check(is_link_policy())
      ->capture_default_str();
  sub.add_option("--id", verb.id, "Id of the mission, [a-z0-9-]; else one is made up");
  return sub.add_flag("--detach", verb.detach, "Print the mission's id and return; the mission goes on");
}

/// What is looked for. `o` must live as long as the parser.
void add_target_options(CLI::App& sub, TargetOptions& o) {
  repeatable(sub.add_option("-t,--target", o.targets,
                            "NAME (looked up in the target folders), FILE.yaml or FILE.png; repeatable"));
  repeatable(sub.add_option("--solid", o.solids, "A solid by its shape, for a robot with a model of them; repeatable"))
      ->check(CLI::IsMember(names_of(kSolidKinds)));
  repeatable(sub.add_option("--targets", o.target_folders, "Folder of target files; repeatable"));
  sub.add_option("--recogniser", o.recogniser, "How targets with a picture are recognised; else as their files say")
      ->check(CLI::IsMember({"template", "features"}));
  sub.add_option("--width", o.width_m, "Width of targets given as pictures, m (default 0.4), or of the solids (0.2)")
      ->check(config::number_above_zero, "above 0");
  sub.add_option("--height", o.height_m, "Height of targets given as pictures, m (default 0.4), or of the solids (0.2)")
      ->check(config::number_above_zero, "above 0");
  sub.add_option("--depth", o.depth_m,
                 "Depth of targets given as pictures, m (default 0: flat), or of the solids (0.2)")
      ->check(config::number_from_zero, "0 or above");
  sub.parse_complete_callback([&o] {
    if (o.targets.empty() && o.solids.empty()) {
      throw CLI::RequiredError("--target or --solid");
    }
  });
}

void add_search(Parse& parse) {
  auto [sub, o] =
      add_verb<SearchVerb>(parse, parse.app, "search", "Search the building for targets and say where they are",
                           "seeker search --target poster-a --bound \"0,0 12,0 12,8 0,8\" --save out/floor1\n"
                           "Ctrl-C asks the robot to stop the mission before the program ends.");
  add_target_options(*sub, *o);
  sub->add_option("--mode", o->mode, "plan: drive along planned paths; paper: the published algorithm")
      ->check(CLI::IsMember({"paper", "plan"}))
      ->capture_default_str();
  sub->add_option("--on-found", o->on_found, "What to do when a target is found")
      ->check(CLI::IsMember({"stop", "approach", "continue"}))
      ->capture_default_str();
  sub->add_option("--bound", o->bound, "Search inside only: corners \"x,y x,y ...\" in m, or @FILE with a YAML list");
  repeatable(sub->add_option("--keep-out", o->keep_out, "Never enter: corners as in --bound; repeatable"));
  sub->add_flag("--gaps-only", o->gaps_only, "Cover what the last search left out");
  sub->add_flag("--explore", o->explore, "Map the building too: search until no wall is left open");
  CLI::Option* detach = add_mission_options(*sub, *o);
  sub->add_option("--save", o->save, "At the end write PREFIX.png, .pgm and .yaml of the map")->excludes(detach);
}

void add_recognise(Parse& parse) {
  auto [sub, o] = add_verb<RecogniseVerb>(
      parse, parse.app, "recognise", "Say which targets are in front of the camera, without leaving the place",
      "seeker recognise --solid sphere --solid ellipsoid\n  seeker recognise --target poster-a --headings 12");
  add_target_options(*sub, *o);
  sub->add_option("--headings", o->headings, "Directions to look into, evenly around (default 1: as it stands)")
      ->check(CLI::Range(1, api::kMaxHeadings))
      ->capture_default_str();
  add_mission_options(*sub, *o);
}

void add_explore(Parse& parse) {
  auto [sub, o] = add_verb<ExploreVerb>(
      parse, parse.app, "explore",
      "Map the building: the robot chooses its goals by itself until nothing is left to map",
      "seeker explore --bound \"0,0 12,0 12,8 0,8\" --return --save out/floor1\n"
      "With --json each decision is a line with its candidates and their terms; the last line is the report.\n"
      "Ctrl-C asks the robot to stop the mission before the program ends.");
  sub->add_option(
         "--strategy", o->strategy,
         "tour: a tour over all that it still has to see, room by room: the shortest path and the least time; "
         "horizon: plans several drives ahead and keeps the pose more certain: twice as long; "
         "active: the published rule, a step at a time: ten times as long, the smallest errors of the pose; "
         "frontier: drives to the nearest unknown floor, walls that were seen too poorly left out; gain: most unknown "
         "floor for the distance, walls left out as by frontier; topological: by the goals of a map of places, which "
         "robots of a fleet share; roam: straight on until something is near: only to compare with, it never ends by "
         "itself")
      ->check(CLI::IsMember(names_of(api::kExploreStrategies)))
      ->capture_default_str();
  sub->add_option("--bound", o->bound, "Explore inside only: corners \"x,y x,y ...\" in m, or @FILE with a YAML list");
  repeatable(sub->add_option("--keep-out", o->keep_out, "Never enter: corners as in --bound; repeatable"));
  sub->add_flag("--return", o->return_to_start, "Drive back to the start at the end");
  CLI::Option* detach = add_mission_options(*sub, *o);
  sub->add_option("--save", o->save, "At the end write PREFIX.png, .pgm and .yaml of the map")->excludes(detach);
}

void add_goto(Parse& parse) {
  auto [sub, o] = add_verb<GotoVerb>(parse, parse.app, "goto", "Drive to points in the frame of the map, in order",
                                     "seeker goto 3,4.5 6,2 --heading 90\n  seeker goto --home\n"
                                     "Ctrl-C asks the robot to stop the mission before the program ends.");
  CLI::Option* points = sub->add_option("points", o->points, "Points X,Y in m");
  sub->add_option("--heading", o->heading_deg, "Heading at the last point, degrees")
      ->check(config::finite_number)
      ->needs(points);
  repeatable(sub->add_option("--keep-out", o->keep_out, "Never enter: corners \"x,y x,y ...\" or @FILE; repeatable"));
  sub->add_flag("--home", o->home, "Return to where the robot was started")->excludes(points);
  add_mission_options(*sub, *o);
}

void add_survey(Parse& parse) {
  auto [survey, s] =
      add_verb<SurveyVerb>(parse, parse.app, "survey",
                           "Build a database of landmarks: stereo pictures in several directions at several places",
                           "seeker survey lab\n  seeker survey lab --at 1,0 --at 4,2 --headings 12 --replace");
  survey->add_option("name", s->name, "Name of the database, [a-z0-9_-]{1,64}")->required();
  repeatable(survey->add_option("--at", s->places,
                                "Place X,Y in m; repeatable (default: where the robot stands, and four around it)"));
  survey->add_option("--headings", s->headings, "Pictures at each place, evenly around")
      ->check(CLI::Range(1, api::kMaxHeadings))
      ->capture_default_str();
  survey->add_flag("--replace", s->replace, "Replace an existing database of that name");
  repeatable(
      survey->add_option("--keep-out", s->keep_out, "Never enter: corners \"x,y x,y ...\" or @FILE; repeatable"));
  add_mission_options(*survey, *s);
  auto [localise, l] = add_verb<LocaliseVerb>(parse, parse.app, "localise",
                                              "Find the robot's place by the landmarks of a database, wherever it is",
                                              "seeker localise lab\nThe robot turns on the spot until it has found its "
                                              "place, or has looked everywhere (exit code 1).");
  localise->add_option("name", l->name, "Name of the database")->required();
  localise->add_option("--headings", l->headings, "Directions to look into before it gives up")
      ->check(CLI::Range(1, api::kMaxHeadings))
      ->capture_default_str();
  add_mission_options(*localise, *l);
}

}  // namespace

void add_missions(Parse& parse) {
  add_search(parse);
  add_recognise(parse);
  add_explore(parse);
  add_goto(parse);
  add_survey(parse);
}

}  // namespace seeker::cli
