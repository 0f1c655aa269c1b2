#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

#include "client/cli/command_line.hpp"
#include "client/cli/parser_errors.hpp"
#include "client/cli/targets.hpp"
#include "client/values/names.hpp"
#include "common/api/audit.hpp"
#include "common/config/number_text.hpp"
#include "common/pki/role.hpp"

namespace seeker::cli {
namespace {

/// What the options write to while CLI11 parses, and which verb was chosen.
struct Parse {
  CLI::App app{"seeker: commands a Seeker robot from the workstation", "seeker"};
  GlobalOptions global;
  std::optional<Verb> verb;
  std::vector<std::function<void()>> choose;  ///< keep the structs of the verbs alive
};

/// Adds one verb: its options write to a struct that becomes Parse::verb when the verb is chosen.
template <class T>
std::pair<CLI::App*, std::shared_ptr<T>> add_verb(Parse& parse, CLI::App& parent, const std::string& name,
                                                  const std::string& description, const std::string& example) {
  auto options = std::make_shared<T>();
  CLI::App* sub = parent.add_subcommand(name, description);
  sub->fallthrough();
  sub->footer("Example:\n  " + example);
  sub->callback([&parse, options] { parse.verb = *options; });
  return {sub, options};
}

CLI::Option* repeatable(CLI::Option* option) { return option->allow_extra_args(false); }

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

void add_landmark_files(Parse& parse, CLI::App& landmarks) {
  auto [download, o] =
      add_verb<LandmarksDownloadVerb>(parse, landmarks, "download", "Copy a database of the robot to a file here",
                                      "seeker landmarks download lab lab.seekerlm");
  download->add_option("name", o->name, "Name of the database")->required();
  download->add_option("file", o->file, "File to write")->required();
  auto [upload, u] =
      add_verb<LandmarksUploadVerb>(parse, landmarks, "upload", "Give the robot a database from a file here",
                                    "seeker landmarks upload lab.seekerlm --name lab-copy");
  upload->add_option("file", u->file, "File of a database")->required();
  upload->add_option("--name", u->name, "Name to keep it under (default: that of the file)");
  upload->add_flag("--replace", u->replace, "Replace an existing database of that name");
}

void add_landmarks(Parse& parse) {
  CLI::App* landmarks =
      parse.app.add_subcommand("landmarks", "Databases of landmarks: look into, check, copy, export, prune");
  landmarks->require_subcommand(1);
  landmarks->fallthrough();
  landmarks->footer("Example:\n  seeker landmarks info\n  seeker landmarks export lab out/lab.csv");
  auto [info, i] = add_verb<LandmarksInspectVerb>(parse, *landmarks, "info", "What is in a database, or in all of them",
                                                  "seeker landmarks info lab");
  info->add_option("name", i->name, "Name of the database (default: list all)");
  auto [verify, v] = add_verb<LandmarksInspectVerb>(parse, *landmarks, "verify", "Read and check a whole database",
                                                    "seeker landmarks verify lab");
  v->verify = true;
  verify->add_option("name", v->name, "Name of the database")->required();
  auto [out, e] = add_verb<LandmarksExportVerb>(
      parse, *landmarks, "export", "Write the landmarks as CSV, and a picture of them from above beside it",
      "seeker landmarks export lab out/lab.csv");
  out->add_option("name", e->name, "Name of the database")->required();
  out->add_option("file", e->file, "File to write (.csv; the picture is .png)")->required();
  auto [prune, p] =
      add_verb<LandmarksPruneVerb>(parse, *landmarks, "prune", "Delete landmarks that few pictures have shown",
                                   "seeker landmarks prune lab --min-views 3");
  prune->add_option("name", p->name, "Name of the database")->required();
  prune->add_option("--min-views", p->min_views, "Keep those seen in so many pictures or more")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  auto [revert, r] = add_verb<LandmarksRevertVerb>(
      parse, *landmarks, "revert", "Take back the last update or pruning of a database", "seeker landmarks revert lab");
  revert->add_option("name", r->name, "Name of the database")->required();
  auto [remove, d] = add_verb<LandmarksDeleteVerb>(parse, *landmarks, "delete", "Delete a database of the robot",
                                                   "seeker landmarks delete lab --yes");
  remove->add_option("name", d->name, "Name of the database")->required();
  remove->add_flag("--yes", d->yes, "Really: it does not come back");
  add_landmark_files(parse, *landmarks);
}

void add_main(CLI::App& verb, FleetOptions& options) {
  verb.add_option("--main", options.main,
                  "The main robot's fleet, HOST[:PORT] (default: the host of --robot, port 7473)");
}

/// A verb of a fleet, with the option that all of them have.
template <class T>
std::pair<CLI::App*, std::shared_ptr<T>> add_fleet_verb(Parse& parse, CLI::App& fleet, const std::string& name,
                                                        const std::string& description, const std::string& example) {
  auto added = add_verb<T>(parse, fleet, name, description, example);
  add_main(*added.first, *added.second);
  return added;
}

void add_fleet(Parse& parse) {
  CLI::App* fleet =
      parse.app.add_subcommand("fleet", "Several robots, one map: who has joined, and how their maps lie");
  fleet->require_subcommand(1);
  fleet->fallthrough();
  fleet->footer("Example:\n  seeker fleet status\n  seeker fleet merge r2 --hypothesis 1");
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

/// One action on the lease; its options write to the struct of the whole verb.
CLI::App* add_lease_action(CLI::App& lease, LeaseVerb& verb, LeaseVerbAction action, const std::string& name,
                           const std::string& description) {
  CLI::App* sub = lease.add_subcommand(name, description);
  sub->fallthrough();
  sub->footer("Example:\n  seeker --as anna lease " + name);
  sub->callback([&verb, action] { verb.action = action; });
  return sub;
}

void add_lease(Parse& parse) {
  auto [lease, l] = add_verb<LeaseVerb>(parse, parse.app, "lease",
                                        "Who holds the lease, the right to drive by hand; hold it, ask for it, answer",
                                        "seeker lease\n  seeker --as anna lease acquire");
  lease->require_subcommand(0, 1);
  using Action = LeaseVerbAction;
  CLI::App* acquire = add_lease_action(*lease, *l, Action::kAcquire, "acquire",
                                       "Hold the lease until Ctrl-C, so that nobody else has the robot move");
  CLI::App* request = add_lease_action(*lease, *l, Action::kRequest, "request",
                                       "Ask the owner for the lease, and hold it until Ctrl-C when it is granted");
  CLI::App* take_over = add_lease_action(*lease, *l, Action::kTakeOver, "take-over",
                                         "Take the lease from its owner, and hold it until Ctrl-C");
  take_over->add_flag("--yes", l->yes, "Really: its owner loses it at once");
  for (CLI::App* holds : {acquire, request, take_over}) {
    holds->add_option("--for", l->for_s, "Seconds to hold it")->check(config::number_above_zero, "above 0");
  }
  add_lease_action(*lease, *l, Action::kGrant, "grant", "As its owner: give the lease to the client that asks for it");
  add_lease_action(*lease, *l, Action::kDeny, "deny", "As its owner: keep the lease");
  add_lease_action(*lease, *l, Action::kRelease, "release", "As its owner: give the lease back");
}

void add_motion(Parse& parse) {
  auto [drive, d] = add_verb<DriveVerb>(
      parse, parse.app, "drive", "Drive by hand: a velocity for some seconds, or the keyboard while a key is held",
      "seeker drive 0.2 0 --for 3\n  seeker drive          (keyboard: arrows or w a s d, space stops, q ends)");
  CLI::Option* v = drive->add_option("v", d->v_m_s, "Forward velocity, m/s")->check(config::finite_number);
  CLI::Option* omega = drive->add_option("omega", d->omega_rad_s, "Turn rate, rad/s, positive to the left")
                           ->check(config::finite_number);
  v->needs(omega);
  drive->add_option("--for", d->for_s, "Seconds to drive")
      ->check(CLI::Range(0.1, 600.0))
      ->check(config::finite_number)
      ->capture_default_str();
  drive->add_flag("--take-over", d->take_over, "Take the lease from its present owner");
  add_lease(parse);
  add_verb<StopVerb>(parse, parse.app, "stop", "End mission and motion", "seeker stop");
  auto [estop, e] = add_verb<EstopVerb>(parse, parse.app, "estop", "Emergency stop: latches until it is released",
                                        "seeker estop\n  seeker estop --release");
  estop->add_flag("--release", e->release, "Release the latch; the robot does not move by itself");
  add_verb<PauseVerb>(parse, parse.app, "pause", "Pause the mission", "seeker pause");
  add_verb<ResumeVerb>(parse, parse.app, "resume", "Go on with the paused mission", "seeker resume");
}

void add_map_files(Parse& parse, CLI::App& map) {
  auto [info, i] = add_verb<MapInspectVerb>(parse, map, "info", "What is in a map", "seeker map info office");
  info->add_option("name", i->name, "Name of the map")->required();
  auto [verify, v] = add_verb<MapInspectVerb>(parse, map, "verify", "Read and check a whole map",
                                              "seeker map verify office\n  seeker map verify ./office.seekermap");
  v->verify = true;
  verify->add_option("name", v->name, "Name of a map of the robot, or a file here (with its .seekermap)")->required();
  auto [remove, d] =
      add_verb<MapDeleteVerb>(parse, map, "delete", "Delete a map of the robot", "seeker map delete office --yes");
  remove->add_option("name", d->name, "Name of the map")->required();
  remove->add_flag("--yes", d->yes, "Really: it does not come back");
  auto [download, o] = add_verb<MapDownloadVerb>(parse, map, "download", "Copy a map of the robot to a file here",
                                                 "seeker map download office office.seekermap");
  download->add_option("name", o->name, "Name of the map")->required();
  download->add_option("file", o->file, "File to write")->required();
  auto [upload, u] = add_verb<MapUploadVerb>(parse, map, "upload", "Give the robot a map from a file here",
                                             "seeker map upload office.seekermap --name office-copy");
  upload->add_option("file", u->file, "File of a map")->required();
  upload->add_option("--name", u->name, "Name to keep it under (default: that of the file)");
  upload->add_flag("--replace", u->replace, "Replace an existing map of that name");
}

void add_maps(Parse& parse) {
  CLI::App* map = parse.app.add_subcommand("map", "Maps: keep, load, look into, copy, export");
  map->require_subcommand(1);
  map->fallthrough();
  map->footer("Example:\n  seeker map save office\n  seeker map export out/office");
  auto [map_export, m] = add_verb<MapExportVerb>(
      parse, *map, "export", "Write NAME.pgm and NAME.yaml (ROS map_server) and the picture NAME.png, or other formats",
      "seeker map export out/office\n  seeker map export out/office --format svg,geojson,tum");
  map_export->add_option("name", m->name, "Path without extension")->required();
  map_export->add_option("--format", m->formats, "Of pgm (with its yaml), png, svg, geojson, tum")
      ->delimiter(',')
      ->check(CLI::IsMember({"pgm", "png", "svg", "geojson", "tum"}));
  auto [save, s] = add_verb<MapSaveVerb>(parse, *map, "save", "Keep the present map of segments under a name",
                                         "seeker map save office");
  save->add_option("name", s->name, "[a-z0-9_-]{1,64}")->required();
  save->add_flag("--replace", s->replace, "Replace an existing map of that name");
  auto [load, l] = add_verb<MapLoadVerb>(parse, *map, "load", "Replace the present map by a kept one",
                                         "seeker map load office --localise && seeker relocalise --wait");
  load->add_option("name", l->name, "Name of the map")->required();
  load->add_flag("--localise", l->localise, "Only find the place in it: neither the map nor its file changes");
  add_verb<MapListVerb>(parse, *map, "list", "Maps that the robot keeps", "seeker map list --json");
  add_map_files(parse, *map);
  auto [relocalise, r] =
      add_verb<RelocaliseVerb>(parse, parse.app, "relocalise", "Have the robot look for its place in the map",
                               "seeker relocalise --wait\n  seeker relocalise --at 3,4.5,90 --wait\n"
                               "With --wait: 0 when it has found its place, 1 when it is lost.");
  relocalise->add_option("--at", r->at, "Look near this pose, x,y,degrees (default: everywhere)");
  relocalise->add_flag("--wait", r->wait, "Wait until the robot has found its place or given up");
}

/// One action on a component; its options write to the struct of the whole verb.
CLI::App* add_component_action(CLI::App& components, ComponentsVerb& verb, ComponentsAction action,
                               const std::string& name, const std::string& description, const std::string& example) {
  CLI::App* sub = components.add_subcommand(name, description);
  sub->fallthrough();
  sub->footer("Example:\n  seeker components " + example);
  sub->add_option("name", verb.name, "Name of the component, as 'seeker components' lists it")->required();
  sub->callback([&verb, action] { verb.action = action; });
  return sub;
}

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

void add_reports(Parse& parse) {
  add_verb<StatusVerb>(parse, parse.app, "status", "Where the robot is, what it does, what is wrong", "seeker status");
  add_verb<DoctorVerb>(parse, parse.app, "doctor",
                       "What is wrong between here and a robot that works, and what to do; 1 when a check failed",
                       "seeker doctor --robot 10.0.0.5");
  auto [audit, a] = add_verb<AuditVerb>(parse, parse.app, "audit", "Who commanded what, also what was refused",
                                        "seeker audit --last 100 --client anna");
  audit->add_option("--last", a->last, "How many of the newest records")
      ->check(CLI::Range(1U, api::kMaxAuditRecords))
      ->capture_default_str();
  audit->add_option("--client", a->client, "Of this client alone; a name stands for all of its programs, too");
  auto [watch, w] = add_verb<WatchVerb>(parse, parse.app, "watch", "Follow the robot live until Ctrl-C or --timeout",
                                        "seeker watch --topics status,event --json");
  watch->add_option("--topics", w->topics, "Of " + listed(all_topics()))
      ->delimiter(',')
      ->check(CLI::IsMember(names_of(all_topics())));
  watch->add_option("--rate", w->rate_hz, "Highest rate of each topic, Hz")
      ->check(config::number_above_zero, "above 0")
      ->capture_default_str();
  add_maps(parse);
  auto [grid, g] = add_verb<GridVerb>(parse, parse.app, "grid", "What was searched, what was not, and the gaps",
                                      "seeker grid --evidence out/evidence.png");
  grid->add_option("--evidence", g->evidence, "Write the picture of what was seen and the gaps (.png or .svg)");
  auto [topology, t] = add_verb<TopologyVerb>(
      parse, parse.app, "topology", "Nodes, edges and goals of an exploration by topology, and its space tree",
      "seeker topology --picture out/topology.png");
  topology->add_option("--picture", t->picture, "Draw them on the map (.png or .svg)");
  add_verb<DetectionsVerb>(parse, parse.app, "detections", "What was found and where", "seeker detections --json");
  auto [lines, l] = add_verb<LinesVerb>(parse, parse.app, "lines", "The straight lines in the newest laser scan",
                                        "seeker lines --json\n  seeker lines --out out/lines.svg");
  lines->add_option("--out", l->out, "Write the picture of the scan with its lines (.png or .svg)");
  CLI::App* camera = parse.app.add_subcommand("camera", "Cameras");
  camera->require_subcommand(1);
  camera->fallthrough();
  camera->footer("Example:\n  seeker camera grab --out view.png");
  auto [grab, c] = add_verb<CameraGrabVerb>(parse, *camera, "grab", "Write one picture as PNG",
                                            "seeker camera grab --camera omni --out view.png");
  grab->add_option("--camera", c->camera, "Name of the camera (default: the one that targets are looked for with)");
  grab->add_option("--out", c->out, "File to write (default CAMERA.png)");
  add_components(parse);
}

template <class Verb>
void add_site(CLI::App& sub, Verb& verb) {
  sub.add_option("--site", verb.site, "Folder of the site (default: ~/.config/seeker/site)");
}

void add_issue(Parse& parse, CLI::App& pki) {
  auto [issue, o] =
      add_verb<PkiIssueVerb>(parse, pki, "issue", "Make a folder with key and certificate for a person or a robot",
                             "seeker pki issue anna --role operator --out ~/.config/seeker/tls\n"
                             "  seeker pki issue r1 --role robot --host 10.0.0.5 --host r1.local\n"
                             "With --overwrite the same renews it; a robot notices new files by itself.");
  issue->add_option("name", o->name, "Name of the person, or the robot's id")->required();
  issue->add_option("--role", o->role, "What its owner may do; robot: for seekerd and seeker-emulator")
      ->required()
      ->check(CLI::IsMember(names_of(pki::kRoles)));
  repeatable(issue->add_option("--host", o->hosts, "Name or IP address at which a robot is reached; repeatable"));
  issue->add_option("--days", o->days, "Days until it expires")->check(CLI::Range(1, 36500))->capture_default_str();
  issue->add_option("--out", o->out, "Folder to write (default: bundles/NAME of the site)");
  issue->add_flag("--overwrite", o->overwrite, "Replace the key and certificate that are there");
  add_site(*issue, *o);
}

void add_pki(Parse& parse) {
  CLI::App* pki = parse.app.add_subcommand("pki", "Certificates of a site: who may connect to its robots, and as what");
  pki->require_subcommand(1);
  pki->fallthrough();
  pki->footer("Example:\n  seeker pki init\n  seeker pki issue anna --role operator");
  auto [init, i] = add_verb<PkiInitVerb>(parse, *pki, "init", "Make the certificate authority (CA) of a site",
                                         "seeker pki init\n  seeker pki init /media/stick/site --name \"Site north\"");
  init->add_option("folder", i->folder, "Folder of the site (default: ~/.config/seeker/site)");
  init->add_option("--name", i->name, "Name of the CA")->capture_default_str();
  init->add_option("--days", i->days, "Days until it expires")->check(CLI::Range(1, 36500))->capture_default_str();
  init->add_flag("--overwrite", i->overwrite, "Replace a CA: all its certificates become void");
  add_issue(parse, *pki);
  auto [revoke, r] =
      add_verb<PkiRevokeVerb>(parse, *pki, "revoke", "Declare certificates void before they expire",
                              "seeker pki revoke anna\n"
                              "Copy the site's crl.pem to each robot then; sessions end within a second.");
  revoke->add_option("which", r->which, "Name (all its certificates) or serial number")->required();
  add_site(*revoke, *r);
  auto [show, s] =
      add_verb<PkiShowVerb>(parse, *pki, "show", "Print certificates: name, role, validity, serial, revoked",
                            "seeker pki show\n  seeker pki show ~/.config/seeker/tls --json");
  show->add_option("what", s->what, "A certificate, a bundle or a site (default: ~/.config/seeker/site)");
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
  add_search(parse);
  add_recognise(parse);
  add_explore(parse);
  add_goto(parse);
  add_survey(parse);
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
  Parse parse;
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
  Parse parse;
  build(parse);
  return tree_of(parse.app);
}

}  // namespace seeker::cli
