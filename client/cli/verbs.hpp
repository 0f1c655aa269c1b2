/// \file
/// The verbs of `seeker` as functions over a robot. Each prints its data to Context::out and returns the exit code;
/// an error becomes a sentence on stderr and its exit code (see exit_code.hpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/cli/command_line.hpp"
#include "client/cli/connection.hpp"
#include "client/cli/context.hpp"
#include "client/cli/held_lease.hpp"
#include "client/cli/mission_run.hpp"
#include "common/api/fleet.hpp"

namespace seeker::cli {

using VerbResult = Result<ExitCode>;

/// Reads targets and areas, and checks the request as far as that needs no robot.
[[nodiscard]] Result<api::MissionRequest> make_request(const SearchVerb& verb);
[[nodiscard]] Result<api::MissionRequest> make_request(const ExploreVerb& verb);
[[nodiscard]] Result<api::MissionRequest> make_request(const GotoVerb& verb);
[[nodiscard]] Result<api::MissionRequest> make_request(const SurveyVerb& verb);
[[nodiscard]] Result<api::MissionRequest> make_request(const LocaliseVerb& verb);
[[nodiscard]] Result<api::MissionRequest> make_request(const RecogniseVerb& verb);

[[nodiscard]] VerbResult show_status(const Context& context);
/// Makes the connection to the robot.
using Dial = std::function<Result<Connection>()>;
struct Patient {
  std::string robot;        ///< the address given with --robot
  std::string own_version;  ///< of this program
};
/// Checks the link to the robot and the robot, as far as it comes. The exit code is 1 when a check has failed.
[[nodiscard]] VerbResult examine(const Context& context, const Patient& patient, const Dial& dial);
[[nodiscard]] VerbResult show_audit(const Context& context, const AuditVerb& verb);
[[nodiscard]] VerbResult show_components(const Context& context, const ComponentsVerb& verb);
[[nodiscard]] VerbResult show_detections(const Context& context);
[[nodiscard]] VerbResult show_grid(const Context& context, const GridVerb& verb);
/// Prints the lines of the newest scan, and draws them over it where the verb names a file.
[[nodiscard]] VerbResult show_lines(const Context& context, const LinesVerb& verb);
[[nodiscard]] VerbResult show_topology(const Context& context, const TopologyVerb& verb);
[[nodiscard]] VerbResult grab_image(const Context& context, const CameraGrabVerb& verb);
[[nodiscard]] VerbResult export_map(const Context& context, const MapExportVerb& verb);
[[nodiscard]] VerbResult save_map(const Context& context, const MapSaveVerb& verb);
[[nodiscard]] VerbResult load_map(const Context& context, const MapLoadVerb& verb);
[[nodiscard]] VerbResult list_maps(const Context& context);
[[nodiscard]] VerbResult inspect_map(const Context& context, const MapInspectVerb& verb);
[[nodiscard]] VerbResult delete_map(const Context& context, const MapDeleteVerb& verb);
[[nodiscard]] VerbResult download_map(const Context& context, const MapDownloadVerb& verb);
[[nodiscard]] VerbResult upload_map(const Context& context, const MapUploadVerb& verb);
/// With --wait the exit code is 0 when the robot is localised and 1 when it is lost.
[[nodiscard]] VerbResult relocalise(const Context& context, const RelocaliseVerb& verb);
[[nodiscard]] VerbResult inspect_landmarks(const Context& context, const LandmarksInspectVerb& verb);
/// Writes a CSV file, and a picture beside it.
[[nodiscard]] VerbResult export_landmarks(const Context& context, const LandmarksExportVerb& verb);
[[nodiscard]] VerbResult prune_landmarks(const Context& context, const LandmarksPruneVerb& verb);
[[nodiscard]] VerbResult revert_landmarks(const Context& context, const LandmarksRevertVerb& verb);
[[nodiscard]] VerbResult delete_landmarks(const Context& context, const LandmarksDeleteVerb& verb);
[[nodiscard]] VerbResult download_landmarks(const Context& context, const LandmarksDownloadVerb& verb);
[[nodiscard]] VerbResult upload_landmarks(const Context& context, const LandmarksUploadVerb& verb);
// The calls to a fleet; `robot` is the address given with --robot.
[[nodiscard]] Result<api::FleetStatus> fleet_status(const Context& context, const std::string& robot,
                                                    const FleetOptions& options);
[[nodiscard]] VerbResult fleet(const Context& context, const std::string& robot, const FleetStatusVerb& verb);
[[nodiscard]] VerbResult fleet(const Context& context, const std::string& robot, const FleetMergeVerb& verb);
[[nodiscard]] VerbResult fleet(const Context& context, const std::string& robot, const FleetSplitVerb& verb);
[[nodiscard]] VerbResult fleet(const Context& context, const std::string& robot, const FleetMapVerb& verb);
// Certificates; no robot is asked.
[[nodiscard]] VerbResult pki_init(const Context& context, const PkiInitVerb& verb);
[[nodiscard]] VerbResult pki_issue(const Context& context, const PkiIssueVerb& verb);
[[nodiscard]] VerbResult pki_revoke(const Context& context, const PkiRevokeVerb& verb);
[[nodiscard]] VerbResult pki_show(const Context& context, const PkiShowVerb& verb);
[[nodiscard]] VerbResult watch(const Context& context, const WatchVerb& verb);

[[nodiscard]] VerbResult stop(const Context& context);
[[nodiscard]] VerbResult estop(const Context& context, const EstopVerb& verb);
[[nodiscard]] VerbResult command_mission(const Context& context, api::MissionCommand command);
/// Shows who holds the lease, answers a request for it, or holds it until Ctrl-C.
[[nodiscard]] VerbResult lease(const Context& context, const LeaseVerb& verb);
/// Sends velocity commands that are valid for 300 ms every 100 ms, under a lease that it acquires and releases. Without
/// a velocity on the command line the keyboard gives it.
[[nodiscard]] VerbResult drive(const Context& context, const DriveVerb& verb);
/// Drives at one velocity for a time; the part of drive() that mission scripts use. Returns why the robot's safety
/// clamped or refused the last command; empty where it did not.
[[nodiscard]] Result<std::string> drive_for(const Context& context, const Twist2& velocity, Duration duration,
                                            bool take_over);
/// Drives while a key is held (drive_keyboard.cpp); needs a terminal on stdin.
[[nodiscard]] Status drive_by_keyboard(const Context& context, HeldLease& lease);

[[nodiscard]] VerbResult search(const Context& context, const api::MissionRequest& request, const SearchVerb& verb);
[[nodiscard]] VerbResult explore(const Context& context, const api::MissionRequest& request, const ExploreVerb& verb);
[[nodiscard]] VerbResult survey(const Context& context, const api::MissionRequest& request, const SurveyVerb& verb);
[[nodiscard]] VerbResult localise(const Context& context, const api::MissionRequest& request, const LocaliseVerb& verb);
[[nodiscard]] VerbResult recognise(const Context& context, const api::MissionRequest& request,
                                   const RecogniseVerb& verb);
[[nodiscard]] VerbResult go(const Context& context, const api::MissionRequest& request, const GotoVerb& verb);
/// Prints the end of a mission with its detections, coverage and gaps.
void print_report(const Context& context, const MissionReport& report, const std::vector<api::Gap>& gaps);

}  // namespace seeker::cli
