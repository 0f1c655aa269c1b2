#include "client/cli/program.hpp"

#include <nlohmann/json.hpp>

#include "client/cli/run_script.hpp"
#include "client/cli/targets.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values_json.hpp"

#ifndef SEEKER_VERSION
#define SEEKER_VERSION "0.1.0"
#endif

namespace seeker::cli {
namespace {

/// What a verb needs of the link.
struct LinkWish {
  bool reconnect = false;
  bool stops = false;
};
constexpr LinkWish kShort{};
constexpr LinkWish kLong{.reconnect = true};
constexpr LinkWish kCommanding{.reconnect = true, .stops = true};

/// Carries one command out: what needs no robot first, then the connection, then the verb.
class Dispatch {
 public:
  Dispatch(const Process& process, const Connector& connect, const GlobalOptions& global) : connect_(connect) {
    context_.out = process.out;
    context_.err = process.err;
    context_.json = global.json;
    context_.tls = global.tls;
    context_.quiet = global.quiet;
    context_.verbose = global.verbose;
    context_.out_is_tty = process.out_is_tty;
    context_.err_is_tty = process.err_is_tty;
    context_.colour = process.out_is_tty && !process.no_colour;
    context_.interrupted = process.interrupted;
    if (global.timeout_s) {
      context_.timeout = seconds(*global.timeout_s);
    }
    robot_ = global.robot;
    client_name_ = global.client_name;
  }

  [[nodiscard]] const Context& context() const { return context_; }

  VerbResult operator()(const StatusVerb&) {
    return with_robot([&] { return show_status(context_); });
  }
  VerbResult operator()(const DoctorVerb&) const {
    return examine(context_, {robot_, SEEKER_VERSION}, [&] {
      return connect_({robot_, context_.tls, context_.timeout, false, false, client_name_});
    });
  }
  VerbResult operator()(const AuditVerb& verb) {
    return with_robot([&] { return show_audit(context_, verb); });
  }
  VerbResult operator()(const WatchVerb& verb) {
    return with_robot([&] { return watch(context_, verb); }, kLong);
  }
  VerbResult operator()(const SearchVerb& verb) { return with_mission(verb, search); }
  VerbResult operator()(const ExploreVerb& verb) { return with_mission(verb, explore); }
  VerbResult operator()(const GotoVerb& verb) { return with_mission(verb, go); }
  VerbResult operator()(const SurveyVerb& verb) { return with_mission(verb, survey); }
  VerbResult operator()(const LocaliseVerb& verb) { return with_mission(verb, localise); }
  VerbResult operator()(const RecogniseVerb& verb) { return with_mission(verb, recognise); }
  VerbResult operator()(const DriveVerb& verb) {
    return with_robot([&] { return drive(context_, verb); });
  }
  VerbResult operator()(const LeaseVerb& verb) {
    return with_robot([&] { return lease(context_, verb); }, kLong);
  }
  VerbResult operator()(const StopVerb&) {
    return with_robot([&] { return stop(context_); });
  }
  VerbResult operator()(const EstopVerb& verb) {
    return with_robot([&] { return estop(context_, verb); });
  }
  VerbResult operator()(const PauseVerb&) {
    return with_robot([&] { return command_mission(context_, api::MissionCommand::kPause); });
  }
  VerbResult operator()(const ResumeVerb&) {
    return with_robot([&] { return command_mission(context_, api::MissionCommand::kResume); });
  }
  VerbResult operator()(const MapExportVerb& verb) {
    return with_robot([&] { return export_map(context_, verb); });
  }
  VerbResult operator()(const MapSaveVerb& verb) {
    return with_robot([&] { return save_map(context_, verb); });
  }
  VerbResult operator()(const MapLoadVerb& verb) {
    return with_robot([&] { return load_map(context_, verb); });
  }
  VerbResult operator()(const MapListVerb&) {
    return with_robot([&] { return list_maps(context_); });
  }
  VerbResult operator()(const MapInspectVerb& verb) {
    return with_robot([&] { return inspect_map(context_, verb); }, verb.verify ? kLong : kShort);
  }
  VerbResult operator()(const MapDeleteVerb& verb) {
    return with_robot([&] { return delete_map(context_, verb); });
  }
  VerbResult operator()(const MapDownloadVerb& verb) {
    return with_robot([&] { return download_map(context_, verb); }, kLong);
  }
  VerbResult operator()(const MapUploadVerb& verb) {
    return with_robot([&] { return upload_map(context_, verb); }, kLong);
  }
  VerbResult operator()(const RelocaliseVerb& verb) {
    return with_robot([&] { return relocalise(context_, verb); }, verb.wait ? kLong : kShort);
  }
  VerbResult operator()(const LandmarksInspectVerb& verb) {
    return with_robot([&] { return inspect_landmarks(context_, verb); });
  }
  VerbResult operator()(const LandmarksExportVerb& verb) {
    return with_robot([&] { return export_landmarks(context_, verb); });
  }
  VerbResult operator()(const LandmarksPruneVerb& verb) {
    return with_robot([&] { return prune_landmarks(context_, verb); });
  }
  VerbResult operator()(const LandmarksRevertVerb& verb) {
    return with_robot([&] { return revert_landmarks(context_, verb); });
  }
  VerbResult operator()(const LandmarksDeleteVerb& verb) {
    return with_robot([&] { return delete_landmarks(context_, verb); });
  }
  VerbResult operator()(const LandmarksDownloadVerb& verb) {
    return with_robot([&] { return download_landmarks(context_, verb); }, kLong);
  }
  VerbResult operator()(const LandmarksUploadVerb& verb) {
    return with_robot([&] { return upload_landmarks(context_, verb); }, kLong);
  }
  VerbResult operator()(const FleetStatusVerb& verb) const { return fleet(context_, robot_, verb); }
  VerbResult operator()(const FleetMergeVerb& verb) const { return fleet(context_, robot_, verb); }
  VerbResult operator()(const FleetSplitVerb& verb) const { return fleet(context_, robot_, verb); }
  VerbResult operator()(const FleetMapVerb& verb) const { return fleet(context_, robot_, verb); }
  VerbResult operator()(const GridVerb& verb) {
    return with_robot([&] { return show_grid(context_, verb); });
  }
  VerbResult operator()(const TopologyVerb& verb) {
    return with_robot([&] { return show_topology(context_, verb); });
  }
  VerbResult operator()(const DetectionsVerb&) {
    return with_robot([&] { return show_detections(context_); });
  }
  VerbResult operator()(const LinesVerb& verb) {
    return with_robot([&] { return show_lines(context_, verb); });
  }
  VerbResult operator()(const CameraGrabVerb& verb) {
    return with_robot([&] { return grab_image(context_, verb); });
  }
  VerbResult operator()(const ComponentsVerb& verb) {
    return with_robot([&] { return show_components(context_, verb); });
  }
  VerbResult operator()(const PkiInitVerb& verb) const { return pki_init(context_, verb); }
  VerbResult operator()(const PkiIssueVerb& verb) const { return pki_issue(context_, verb); }
  VerbResult operator()(const PkiRevokeVerb& verb) const { return pki_revoke(context_, verb); }
  VerbResult operator()(const PkiShowVerb& verb) const { return pki_show(context_, verb); }
  VerbResult operator()(const RunVerb& verb) {
    const std::filesystem::path file(verb.file);
    const std::vector<std::filesystem::path> folders = target_folders(verb.target_folders);
    const Result<Script> script = load_script(file);
    if (!script) {
      return fail_as_usage(script.error());
    }
    if (const Status ok = check_missions(*script, file.parent_path(), folders); !ok) {
      return fail_as_usage({ok.error().code, verb.file + ": " + ok.error().message});
    }
    if (verb.check) {
      print_check(context_, verb.file, *script);
      return ExitCode::kOk;
    }
    const FleetCall fleet = [&] { return fleet_status(context_, robot_, verb); };
    return with_robot([&] { return run_script(context_, *script, file.parent_path(), folders, fleet); }, kCommanding);
  }
  VerbResult operator()(const CompletionVerb& verb) const {
    const Result<std::string> script = completion_script(verb.shell);
    if (!script) {
      return tl::unexpected<Error>(script.error());
    }
    *context_.out << *script;
    return ExitCode::kOk;
  }
  VerbResult operator()(const VersionVerb&) const {
    const std::string protocol = std::to_string(api::kProtocolMajor) + "." + std::to_string(api::kProtocolMinor);
    if (context_.json) {
      *context_.out << json_line({{"version", SEEKER_VERSION}, {"protocol", protocol}}) << '\n';
    } else {
      *context_.out << "seeker " SEEKER_VERSION ", protocol " << protocol << '\n';
    }
    return ExitCode::kOk;
  }

 private:
  /// Reads the mission first, so that its errors are reported without a robot.
  template <class MissionVerb>
  VerbResult with_mission(const MissionVerb& verb,
                          VerbResult (*run)(const Context&, const api::MissionRequest&, const MissionVerb&)) {
    const Result<api::MissionRequest> request = make_request(verb);
    return request ? with_robot([&] { return run(context_, *request, verb); }, kCommanding)
                   : VerbResult(tl::unexpected<Error>(request.error()));
  }
  template <class Run>
  VerbResult with_robot(Run run, const LinkWish& wish = kShort) {
    // A long verb's --timeout is for its whole; connecting has the usual time then.
    Result<Connection> connection =
        connect_({robot_, context_.tls, wish.reconnect ? std::optional<Duration>() : context_.timeout, wish.reconnect,
                  wish.stops, client_name_});
    if (!connection) {
      return tl::unexpected<Error>(connection.error());
    }
    context_.robot = connection->robot;
    context_.client_name = connection->client_name;
    context_.link_error = connection->link_error;
    return run();
  }

  const Connector& connect_;
  Context context_;
  std::string robot_;
  std::string client_name_;
};

ExitCode report(const Context& context, const Error& error) {
  if (context.err_is_tty) {
    *context.err << "\r\x1b[K";
  }
  *context.err << "seeker: " << error.message << '\n' << std::flush;
  if (context.json) {
    const Json told = {{"code", to_string(error.code)},
                       {"message", error.message},
                       {"exit_code", static_cast<int>(exit_code(error.code))}};
    *context.out << json_line({{"error", told}}) << '\n' << std::flush;
  }
  return exit_code(error.code);
}

}  // namespace

ExitCode run_program(const std::vector<std::string>& arguments, const Process& process, const Connector& connect) {
  const ParsedCommandLine parsed = parse_command_line(arguments);
  if (!parsed.err.empty()) {
    Context context;
    context.out = process.out;
    context.err = process.err;
    context.json = parsed.json;
    return report(context, Error{Errc::kInvalidArgument, parsed.err});
  }
  *process.out << parsed.out << std::flush;
  if (!parsed.command) {
    return parsed.exit_code;
  }
  Dispatch dispatch(process, connect, parsed.command->global);
  const VerbResult result = std::visit(dispatch, parsed.command->verb);
  if (!result) {
    return report(dispatch.context(), result.error());
  }
  process.out->flush();
  if (!process.out->good() && !process.out_ended()) {
    *process.err << "seeker: stdout cannot be written\n";
    return ExitCode::kFailed;
  }
  return *result;
}

}  // namespace seeker::cli
