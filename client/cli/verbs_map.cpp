// The map as an asset: files of the robot, its transfer, and finding the place in it.

#include <filesystem>
#include <iomanip>

#include <nlohmann/json.hpp>

#include "client/cli/export_files.hpp"
#include "client/cli/show_done.hpp"
#include "client/cli/targets.hpp"
#include "client/cli/transfer.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"
#include "common/core/angle.hpp"
#include "common/files/files.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

/// One line: the map in figures.
std::string line_of(const api::MapSummary& map) {
  if (!map.problem.empty()) {
    return map.name + "  UNUSABLE: " + map.problem;
  }
  return map.name + "  " + count_of(map.segments, "segment") + ", " + count_of(map.keyframes, "scan") + ", " +
         count_of(map.loops, "loop") + ", " + size_of(map.file_bytes) + ", saved " + date_of(map.saved_unix_s) +
         " by " + (map.robot_id.empty() ? "an unnamed robot" : map.robot_id);
}

VerbResult show(const Context& context, const Result<api::MapSummary>& map, const std::string& done) {
  if (!map) {
    return tl::unexpected<Error>(map.error());
  }
  if (context.json) {
    *context.out << json_line(Json(*map)) << '\n';
  } else {
    *context.out << line_of(*map) << '\n';
  }
  if (!done.empty()) {
    say(context, done);
  }
  return ExitCode::kOk;
}

/// By robots of older software, in one message.
Result<api::MapSummary> upload_at_once(const Context& context, const std::string& file, const std::string& name,
                                       bool replace, bool check_only) {
  Result<std::vector<std::uint8_t>> bytes = files::read_file(file, api::kMaxMapTransferBytes);
  if (!bytes) {
    return fail_as_usage(bytes.error());
  }
  const api::MapUpload upload{name, std::move(*bytes), replace, check_only};
  Result<api::MapSummary> map = ask<api::MapSummary>(
      context, [&](api::Reply<api::MapSummary> reply) { context.robot->upload_map(upload, std::move(reply)); });
  return map || map.error().code != Errc::kCorrupt ? std::move(map) : fail_as_usage(map.error());
}

Result<api::MapSummary> upload(const Context& context, const std::string& file, const std::string& name, bool replace,
                               bool check_only) {
  bool too_old = false;
  const Result<api::UploadedFile> taken =
      send_file(context, file, {api::FileKind::kMap, {}, name, replace, check_only}, too_old);
  if (too_old) {
    return upload_at_once(context, file, name, replace, check_only);
  }
  if (!taken) {
    return tl::unexpected<Error>(taken.error());
  }
  return taken->map ? Result<api::MapSummary>(*taken->map)
                    : fail(Errc::kInternal, "the robot's answer has no summary of the map");
}

/// "x,y,theta" in metres and degrees.
Result<Pose2> parse_pose(const std::string& text) {
  const std::size_t cut = text.rfind(',');
  const Result<Point2> point = parse_point(cut == std::string::npos ? "" : text.substr(0, cut));
  const Result<Point2> angle = parse_point(cut == std::string::npos ? "" : "0" + text.substr(cut));
  if (!point || !angle) {
    return fail(Errc::kInvalidArgument, "'" + text + "' is no pose; write x,y,degrees, as in 3,4.5,90");
  }
  return Pose2{point->x(), point->y(), wrap_angle(deg_to_rad(angle->y()))};
}

/// `given` is where somebody said that the robot is: a map that looks otherwise there overrules them.
void print_place(const Context& context, const api::RobotStatus& status, const std::optional<Pose2>& given,
                 Duration waited) {
  const PoseEstimate& pose = status.pose;
  const bool placed = is_placed(pose.quality);
  const auto from_given_m = placed && given ? std::optional(distance_m(pose.map_T_base, *given)) : std::nullopt;
  if (!context.json) {
    *context.out << to_string(pose.quality) << (placed ? " at " + text_of(pose.map_T_base) : "")
                 << (from_given_m ? fixed(", %.2f m from the place given", *from_given_m) : "")
                 << (pose.cause.empty() ? "" : ": " + pose.cause) << '\n';
    return;
  }
  const Json json = {{"quality", to_string(pose.quality)},
                     {"cause", pose.cause},
                     {"pose", placed ? Json(pose.map_T_base) : Json()},
                     {"sigma_m", placed ? Json(sigma_m(pose.covariance.topLeftCorner<2, 2>())) : Json()},
                     {"from_given_m", or_null(from_given_m)},
                     {"waited_s", to_seconds(waited)}};
  *context.out << json_line(json) << '\n';
}

/// Until the robot has found its place or given up.
VerbResult wait_for_place(const Context& context, const std::optional<Pose2>& given) {
  constexpr Duration kPoll = std::chrono::milliseconds(200);
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const Result<api::RobotStatus> status = ask<api::RobotStatus>(context, &api::RobotApi::get_status);
    if (!status) {
      return tl::unexpected<Error>(status.error());
    }
    const Duration waited = std::chrono::steady_clock::now() - start;
    const LocalisationQuality quality = status->pose.quality;
    if (!status->line_map || !status->line_map->relocalising) {
      print_place(context, *status, given, waited);
      const bool found = quality == LocalisationQuality::kLocalised || quality == LocalisationQuality::kDegraded;
      if (!found) {
        *context.err << "seeker: the robot did not find its place in the map; say where it is with --at X,Y,DEG, or "
                        "drive it to where more walls are seen\n";
      }
      return found ? ExitCode::kOk : ExitCode::kFailed;
    }
    if (context.timeout && waited >= *context.timeout) {
      return fail(Errc::kTimeout, "the robot still looks for its place; allow more with --timeout");
    }
    if (!sleep_for(context, kPoll)) {
      return fail(Errc::kCancelled, "interrupted; the robot goes on looking for its place");
    }
  }
}

}  // namespace

VerbResult save_map(const Context& context, const MapSaveVerb& verb) {
  return show(context,
              ask<api::MapSummary>(context,
                                   [&](api::Reply<api::MapSummary> reply) {
                                     context.robot->save_map(verb.name, verb.replace, std::move(reply));
                                   }),
              "");
}

VerbResult load_map(const Context& context, const MapLoadVerb& verb) {
  const api::MapUse use = verb.localise ? api::MapUse::kLocalise : api::MapUse::kContinue;
  return show(context,
              ask<api::MapSummary>(context,
                                   [&](api::Reply<api::MapSummary> reply) {
                                     context.robot->load_map(verb.name, use, std::move(reply));
                                   }),
              "the robot looks for its place in the map; 'seeker relocalise --wait' waits for it");
}

VerbResult list_maps(const Context& context) {
  const auto maps = ask<std::vector<api::MapSummary>>(context, &api::RobotApi::list_maps);
  if (!maps) {
    return tl::unexpected<Error>(maps.error());
  }
  if (context.json) {
    *context.out << json_line(Json{{"maps", *maps}}) << '\n';
    return ExitCode::kOk;
  }
  for (const api::MapSummary& map : *maps) {
    *context.out << line_of(map) << '\n';
  }
  if (maps->empty()) {
    say(context, "no map has been saved yet; 'seeker map save NAME' keeps the present one");
  }
  return ExitCode::kOk;
}

VerbResult inspect_map(const Context& context, const MapInspectVerb& verb) {
  // A name has neither dots nor slashes; a file of a map always has a dot.
  const bool is_file = verb.verify && !validate_map_name(verb.name);
  if (is_file) {
    return show(context, upload(context, verb.name, "check", false, true), verb.name + " is sound");
  }
  const Result<api::MapSummary> map = ask<api::MapSummary>(context, [&](api::Reply<api::MapSummary> reply) {
    context.robot->inspect_map(verb.name, verb.verify, std::move(reply));
  });
  if (map && !verb.verify && !context.json) {
    *context.out << line_of(*map) << "\n  sensors " << map->sensors << "\n  created " << date_of(map->created_unix_s)
                 << ", software " << map->software_version << "\n  " << count_of(map->nodes, "local map") << ", "
                 << count_of(map->edges, "relation") << ", epoch " << map->epoch << '\n';
    return ExitCode::kOk;
  }
  return show(context, map, verb.verify ? verb.name + " is sound" : "");
}

VerbResult delete_map(const Context& context, const MapDeleteVerb& verb) {
  if (!verb.yes) {
    return fail(Errc::kInvalidArgument, "a deleted map does not come back; say --yes to delete '" + verb.name + "'");
  }
  return show_done(
      context,
      ask<void>(context, [&](api::Reply<void> reply) { context.robot->delete_map(verb.name, std::move(reply)); }),
      "map '" + verb.name + "' is deleted");
}

VerbResult download_map(const Context& context, const MapDownloadVerb& verb) {
  Status done = fetch_file(context, api::FileKind::kMap, verb.name, verb.file);
  if (!done && done.error().code == Errc::kUnsupportedVersion) {  // older software: in one message
    const auto bytes = ask<std::vector<std::uint8_t>>(context, [&](api::Reply<std::vector<std::uint8_t>> reply) {
      context.robot->download_map(verb.name, std::move(reply));
    });
    done = bytes ? files::write_file(verb.file, *bytes) : Status(tl::unexpected<Error>(bytes.error()));
  }
  return show_done(context, done, "wrote " + verb.file);
}

VerbResult upload_map(const Context& context, const MapUploadVerb& verb) {
  const std::string name = verb.name.empty() ? fs::path(verb.file).stem().string() : verb.name;
  if (const Status ok = validate_map_name(name); !ok) {
    return fail(Errc::kInvalidArgument,
                "'" + name + "' cannot name a map (" + ok.error().message + "); give another one with --name");
  }
  return show(context, upload(context, verb.file, name, verb.replace, false), "");
}

VerbResult relocalise(const Context& context, const RelocaliseVerb& verb) {
  std::optional<Pose2> at;
  if (!verb.at.empty()) {
    const Result<Pose2> pose = parse_pose(verb.at);
    if (!pose) {
      return tl::unexpected<Error>(pose.error());
    }
    at = *pose;
  }
  const Status ok =
      ask<void>(context, [&](api::Reply<void> reply) { context.robot->relocalise(at, std::move(reply)); });
  if (ok && verb.wait) {
    return wait_for_place(context, at);
  }
  return show_done(context, ok, "the robot looks for its place; 'seeker status' shows how it goes");
}

}  // namespace seeker::cli
