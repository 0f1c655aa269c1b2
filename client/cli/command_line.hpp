/// \file
/// The parsed command line as values. The parser library (CLI11) is used in the files parser*.cpp only.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "client/cli/exit_code.hpp"
#include "common/api/mission.hpp"

namespace seeker::cli {

struct GlobalOptions {
  std::string robot = "127.0.0.1:7471";
  std::string client_name;  ///< given to the robot; empty: of program, host and process
  std::string tls;          ///< folder of a bundle of certificates, "none" for plain TCP; empty: see bundle_for()
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  std::optional<double> timeout_s;  ///< wall time; see docs/client.md for what it limits
};

struct StatusVerb {};
struct DoctorVerb {};
struct AuditVerb {
  std::uint32_t last = 20;  ///< newest records
  std::string client;       ///< of this client alone; empty: of all
};
struct WatchVerb {
  std::vector<std::string> topics;
  double rate_hz = 2.0;
};
/// Options that all missions have.
struct MissionOptions {
  std::optional<double> time_limit_s;
  std::string link_policy = "stop";
  bool detach = false;
  std::string id;
};
/// Options that name the targets of a search.
struct TargetOptions {
  std::vector<std::string> targets;
  std::vector<std::string> solids;
  std::vector<std::string> target_folders;
  std::string recogniser;
  std::optional<double> width_m;
  std::optional<double> height_m;
  std::optional<double> depth_m;
};
struct SearchVerb : MissionOptions, TargetOptions {
  std::string mode = "plan";
  std::string on_found = "approach";
  std::string bound;
  std::vector<std::string> keep_out;
  bool gaps_only = false;
  bool explore = false;
  std::string save;
};
struct ExploreVerb : MissionOptions {
  std::string strategy{to_string(api::kDefaultExploreStrategy)};
  std::string bound;
  std::vector<std::string> keep_out;
  bool return_to_start = false;
  std::string save;
};
struct GotoVerb : MissionOptions {
  std::vector<std::string> points;
  std::optional<double> heading_deg;
  std::vector<std::string> keep_out;
  bool home = false;
};
struct SurveyVerb : MissionOptions {
  std::string name;
  std::vector<std::string> places;
  int headings = 12;
  bool replace = false;
  std::vector<std::string> keep_out;
};
struct LocaliseVerb : MissionOptions {
  std::string name;
  int headings = 12;
};
struct RecogniseVerb : MissionOptions, TargetOptions {
  int headings = 1;
};
struct DriveVerb {
  std::optional<double> v_m_s;
  std::optional<double> omega_rad_s;
  double for_s = 1.0;
  bool take_over = false;
};
enum class LeaseVerbAction : std::uint8_t { kShow, kAcquire, kRequest, kTakeOver, kGrant, kDeny, kRelease };
struct LeaseVerb {
  LeaseVerbAction action = LeaseVerbAction::kShow;
  bool yes = false;             ///< a person wants to take it over
  std::optional<double> for_s;  ///< time to hold it; absent: until Ctrl-C
};
struct StopVerb {};
struct EstopVerb {
  bool release = false;
};
struct PauseVerb {};
struct ResumeVerb {};
struct MapExportVerb {
  std::string name;
  std::vector<std::string> formats{"pgm", "png"};
};
struct MapSaveVerb {
  std::string name;
  bool replace = false;
};
struct MapLoadVerb {
  std::string name;
  bool localise = false;
};
struct MapListVerb {};
/// `map info` and `map verify`.
struct MapInspectVerb {
  std::string name;
  bool verify = false;
};
struct MapDeleteVerb {
  std::string name;
  bool yes = false;
};
struct MapDownloadVerb {
  std::string name;
  std::string file;
};
struct MapUploadVerb {
  std::string file;
  std::string name;
  bool replace = false;
};
struct RelocaliseVerb {
  std::string at;
  bool wait = false;
};
/// `landmarks info` and `landmarks verify`; info without a name lists all.
struct LandmarksInspectVerb {
  std::string name;
  bool verify = false;
};
struct LandmarksExportVerb {
  std::string name;
  std::string file;
};
struct LandmarksPruneVerb {
  std::string name;
  int min_views = 3;
};
struct LandmarksRevertVerb {
  std::string name;
};
struct LandmarksDeleteVerb {
  std::string name;
  bool yes = false;
};
struct LandmarksDownloadVerb {
  std::string name;
  std::string file;
};
struct LandmarksUploadVerb {
  std::string file;
  std::string name;
  bool replace = false;
};
struct FleetOptions {
  std::string main;  ///< HOST[:PORT] of the fleet; empty: the robot's host and the usual port
};
struct FleetStatusVerb : FleetOptions {};
struct FleetMergeVerb : FleetOptions {
  std::string robot;
  std::uint32_t hypothesis = 0;
};
struct FleetSplitVerb : FleetOptions {
  std::string robot;
};
struct FleetMapVerb : FleetOptions {
  std::string file;
  std::vector<std::string> formats;  ///< of pictures; empty: the map file
};
struct TopologyVerb {
  std::string picture;  ///< file; empty: none
};
struct GridVerb {
  std::string evidence;
};
struct DetectionsVerb {};
struct LinesVerb {
  std::string out;  ///< picture to write; empty: none
};
struct CameraGrabVerb {
  std::string camera;  ///< name; empty: the camera by which the robot searches for targets
  std::string out;
};
enum class ComponentsAction : std::uint8_t { kList, kGet, kSet, kExchange, kActivate, kDeactivate };
struct ComponentsVerb {
  std::string restart;
  ComponentsAction action = ComponentsAction::kList;
  std::string name;                      ///< of the component that the action is for
  std::string type;                      ///< to exchange it for
  std::vector<std::string> assignments;  ///< "key=value"
};
struct PkiInitVerb {
  std::string folder;  ///< of the site; empty: the usual one
  std::string name = "Seeker site";
  int days = 3650;
  bool overwrite = false;
};
struct PkiIssueVerb {
  std::string site;  ///< folder; empty: the usual one
  std::string name;
  std::string role;
  std::vector<std::string> hosts;
  int days = 365;
  std::string out;  ///< folder of the bundle; empty: in the site
  bool overwrite = false;
};
struct PkiRevokeVerb {
  std::string site;   ///< folder; empty: the usual one
  std::string which;  ///< name or serial
};
struct PkiShowVerb {
  std::string what;  ///< file or folder; empty: the usual site
};
struct RunVerb : FleetOptions {
  std::string file;
  std::vector<std::string> target_folders;
  bool check = false;
};
struct CompletionVerb {
  std::string shell;
};
struct VersionVerb {};

using Verb = std::variant<StatusVerb, DoctorVerb, AuditVerb, WatchVerb, SearchVerb, ExploreVerb, GotoVerb, SurveyVerb,
                          LocaliseVerb, RecogniseVerb, DriveVerb, LeaseVerb, StopVerb, EstopVerb, PauseVerb, ResumeVerb,
                          MapExportVerb, MapSaveVerb, MapLoadVerb, MapListVerb, MapInspectVerb, MapDeleteVerb,
                          MapDownloadVerb, MapUploadVerb, RelocaliseVerb, LandmarksInspectVerb, LandmarksExportVerb,
                          LandmarksPruneVerb, LandmarksRevertVerb, LandmarksDeleteVerb, LandmarksDownloadVerb,
                          LandmarksUploadVerb, FleetStatusVerb, FleetMergeVerb, FleetSplitVerb, FleetMapVerb, GridVerb,
                          TopologyVerb, DetectionsVerb, LinesVerb, CameraGrabVerb, ComponentsVerb, PkiInitVerb,
                          PkiIssueVerb, PkiRevokeVerb, PkiShowVerb, RunVerb, CompletionVerb, VersionVerb>;

struct CommandLine {
  GlobalOptions global;
  Verb verb;
};

/// The parsed command line, or the text to print and the exit code (help, version, a usage error).
struct ParsedCommandLine {
  std::optional<CommandLine> command;
  ExitCode exit_code = ExitCode::kOk;
  std::string out;
  std::string err;    ///< the error as one sentence, without prefix and end of line
  bool json = false;  ///< true: --json was given, even if the rest is wrong
};

/// Parses the arguments after the program's name; SEEKER_ROBOT gives the default of --robot, SEEKER_TLS that of
/// --tls.
[[nodiscard]] ParsedCommandLine parse_command_line(const std::vector<std::string>& arguments);

/// One command with its options and subcommands, as the parser knows them.
struct CommandTree {
  std::string name;
  std::string description;
  struct Option {
    std::vector<std::string> names;  ///< names of the option, with their dashes
    std::string description;
    bool takes_value = false;
    std::vector<std::string> values;  ///< allowed values, where they form a list
  };
  std::vector<Option> options;
  std::vector<CommandTree> commands;
  std::vector<std::string> words;  ///< allowed values of the positional argument, where they form a list
};
[[nodiscard]] CommandTree command_tree();

/// The completion script for bash, zsh or fish; kInvalidArgument for another shell.
[[nodiscard]] Result<std::string> completion_script(const std::string& shell);

}  // namespace seeker::cli
