#include "server/app/composition/robot_options.hpp"

#include "common/api/robot_state.hpp"
#include "server/app/composition/estimators.hpp"
#include "server/app/composition/link_options.hpp"
#include "server/app/composition/loop_options.hpp"
#include "server/app/composition/stereo_mode.hpp"
#include "server/options/camera_options.hpp"
#include "server/options/explore_options.hpp"
#include "server/options/fleet_options.hpp"
#include "server/options/hardware_options.hpp"
#include "server/options/line_slam_options.hpp"
#include "server/options/lines_options.hpp"
#include "server/options/nav_options.hpp"
#include "server/options/search_options.hpp"
#include "server/options/sim_options.hpp"
#include "server/options/slam_options.hpp"
#include "server/options/solids_options.hpp"
#include "server/options/stereo_options.hpp"
#include "server/options/vision_options.hpp"

// None of these may stand in an unnamed namespace: argument-dependent look-up would not find them from Fields.

namespace seeker::drivers {
void describe(config::Fields& f, SimDeviceParams& params) {
  f.seconds("base_period_s", params.base_period);
  f.check("base_period_s", params.base_period > Duration::zero(), "must be above 0");
  f.seconds("lidar_period_s", params.lidar_period);
  f.check("lidar_period_s", params.lidar_period > Duration::zero(), "must be above 0");
  f.seconds("sonar_period_s", params.sonar_period);
  f.check("sonar_period_s", params.sonar_period > Duration::zero(), "must be above 0");
  f.seconds("command_timeout_s", params.command_timeout);
}

void describe(config::Fields& f, ReplayParams& params) {
  f.angle_deg("angle_min_deg", params.angle_min_rad);
  f.angle_deg("angle_step_deg", params.angle_step_rad);
  f.field("range_min_m", params.range_min_m);
  f.field("range_max_m", params.range_max_m);
  f.field("base_T_laser", params.base_T_laser);
}

}  // namespace seeker::drivers

namespace seeker::app {
void describe(config::Fields& f, GotoParams& params) {
  f.section("cost_map", params.cost_map);
  f.section("planner", params.planner);
  f.section("follower", params.follower);
  f.seconds("replan_period_s", params.replan_period);
  f.field("max_failures", params.max_failures);
  f.section("retry", params.retry);
}

void describe(config::Fields& f, SimSettings& settings) {
  f.field("world", settings.world);
  f.field("seed", settings.seed);
  f.field("speed", settings.speed);
  f.field("start", settings.start);
  f.field("random_target", settings.random_target);
  f.field("people", settings.people);
  f.section("robot", settings.robot);
  f.section("devices", settings.devices);
}

void describe(config::Fields& f, EmulatorSettings& settings) {
  f.field("address", settings.address);
  f.field("robot", settings.robot);
  f.field("tls", settings.tls);
}

void describe(config::Fields& f, FleetSettings& settings) {
  f.field("lead", settings.lead);
  f.field("address", settings.address);
  describe_port(f, settings.port);
  f.field("join", settings.join);
  f.seconds("period_s", settings.period);
  f.check("period_s", settings.period > Duration::zero(), "must be above 0");
  f.seconds("share_period_s", settings.share_period);
  f.check("share_period_s", settings.share_period > Duration::zero(), "must be above 0");
  f.seconds("floor_period_s", settings.floor_period);
  f.check("floor_period_s", settings.floor_period > Duration::zero(), "must be above 0");
  f.seconds("silence_s", settings.silence_limit);
  f.check("silence_s", settings.silence_limit > settings.share_period, "must be above share_period_s");
  f.seconds("search_age_s", settings.search_age);
  f.check("search_age_s", settings.search_age >= Duration::zero(), "must be 0 or more");
  f.section("merge", settings.merge);
}

void describe(config::Fields& f, ReplaySettings& settings) {
  f.field("log", settings.log);
  f.field("speed", settings.speed);
  f.field("wait_for_client", settings.wait_for_client);
  f.field("exit_at_end", settings.exit_at_end);
  f.section("laser", settings.params);
}

void describe(config::Fields& f, RealSettings& settings) {
  describe(f, settings.devices);
  f.optional_section("camera", settings.camera);
  f.section("camera_reader", settings.camera_reader);
}

void describe(config::Fields& f, FittedSensors& sensors) {
  f.field("lidar", sensors.lidar);
  f.field("sonar", sensors.sonar);
  f.field("camera", sensors.camera);
  f.field("stereo", sensors.stereo);
}

void describe(config::Fields& f, LandmarkEstimatorParams& params) {
  f.field("database", params.database);
  f.seconds("look_period_s", params.look_period);
  f.check("look_period_s", params.look_period > Duration::zero(), "must be above 0");
  f.seconds("odometry_gap_s", params.odometry_gap);
  f.seconds("update_period_s", params.update_period);
  f.section("update", params.update);
}

void describe(config::Fields& f, RotateAndLookParams& params) {
  f.section("follower", params.follower);
  f.field("settle_s", params.settle_s);
  f.angle_deg("still_deg_s", params.still_rad_s);
  f.field("rotation_time_s", params.rotation_time_s);
  f.field("tries", params.tries);
  f.check("tries", params.tries > 0, "must be above 0");
}

void describe(config::Fields& f, RoundParams& params) {
  f.section("look", params.look);
  f.angle_deg("overlap_deg", params.overlap_rad);
  f.check("overlap_deg", params.overlap_rad >= 0.0, "must be 0 or more");
  f.field("picture_timeout_s", params.picture_timeout_s);
  f.check("picture_timeout_s", params.picture_timeout_s > 0.0, "must be above 0");
}

void describe(config::Fields& f, SolidSettings& settings) { f.field("model", settings.model); }

void describe(config::Fields& f, SearchBehaviourParams& params) {
  f.section("coverage", params.search);
  f.section("recogniser", params.recogniser);
  f.section("solids", params.solids);
  f.section("round", params.round);
}

void describe(config::Fields& f, SurveyParams& params) {
  f.field("spacing_m", params.spacing_m);
  f.check("spacing_m", params.spacing_m > 0.0, "must be above 0");
  f.section("look", params.look);
}

void describe(config::Fields& f, StereoSettings& settings) {
  describe_mode(f, settings);
  f.optional_section("camera", settings.camera);
  f.section("features", settings.features);
  f.section("database", settings.database);
  f.section("localiser", settings.localiser);
  f.section("estimator", settings.estimator);
  f.section("survey", settings.survey);
}

namespace {

/// Plans and checks are made for a robot of that size, each with the margin that it has; the simulated one is so large.
void grow_robot(RobotOptions& options, double by_m) {
  for (nav::CostMapParams* cost : {&options.go.cost_map, &options.search.search.plan.cost, &options.explore.cost}) {
    cost->robot_radius_m += by_m;
    cost->preferred_clearance_m += by_m;
  }
  for (nav::ClearanceParams* clearance :
       {&options.loop.safety.clearance, &options.go.follower.clearance, &options.search.search.plan.follower.clearance,
        &options.search.round.look.follower.clearance, &options.explore.driver.follower.clearance,
        &options.stereo.survey.look.follower.clearance}) {
    clearance->radius_m += by_m;
  }
  options.search.search.paper.robot_radius_m += by_m;
  options.loop.fleet.robot_radius_m += by_m;  // the others are taken to be of its kind
  options.sim.robot.radius_m += by_m;
}

void describe_radius(config::Fields& f, RobotOptions& options) {
  constexpr double kLargest_m = 2.0;
  const double before_m = options.robot_radius_m;
  f.field("robot_radius_m", options.robot_radius_m);
  const bool valid = options.robot_radius_m > 0.0 && options.robot_radius_m <= kLargest_m;
  f.check("robot_radius_m", valid, "must be above 0 and at most 2");
  if (f.reading() && valid) {
    grow_robot(options, options.robot_radius_m - before_m);
  }
}

}  // namespace

const config::Choices<std::optional<api::RecogniserKind>>& recogniser_names() {
  static const config::Choices<std::optional<api::RecogniserKind>> kNames = {
      {"by_target", std::nullopt},
      {"template", api::RecogniserKind::kTemplate},
      {"features", api::RecogniserKind::kFeatures}};
  return kNames;
}

const config::Choices<std::optional<search::Strategy>>& planner_names() {
  static const config::Choices<std::optional<search::Strategy>> kNames = {{"by_mission", std::nullopt},
                                                                          {"paper", search::Strategy::kPaper},
                                                                          {"plan", search::Strategy::kPlan},
                                                                          {"spiral", search::Strategy::kSpiral},
                                                                          {"frontier", search::Strategy::kFrontier}};
  return kNames;
}

void describe(config::Fields& f, RobotOptions& options) {
  f.field("base", options.base);
  f.field("robot_id", options.robot_id);
  const Status id = api::validate_robot_id(options.robot_id);
  f.check("robot_id", id.has_value(), id ? "" : id.error().message);
  f.choice("driver", options.driver,
           config::Choices<DriverType>{{"sim", DriverType::kSim},
                                       {"replay", DriverType::kReplay},
                                       {"emulator", DriverType::kEmulator},
                                       {"hardware", DriverType::kHardware}});
  describe_radius(f, options);
  f.section("sensors", options.sensors);
  f.section("sim", options.sim);
  f.section("emulator", options.emulator);
  f.section("replay", options.replay);
  f.section("hardware", options.hardware);
  f.section("fleet", options.fleet);
  f.section("loop", options.loop);
  f.choice("estimator", options.estimator, estimator_names());
  f.choice("recogniser", options.recogniser, recogniser_names());
  f.choice("planner", options.search.strategy, planner_names());
  f.section("connections", options.loop.connections);
  f.section("odometry_calibration", options.loop.odometry_calibration);
  f.field("record", options.record);
  f.optional_section("metrics", options.metrics);
  f.section("tracking", options.tracking);
  f.section("lines", options.lines);
  f.section("slam", options.slam);
  f.section("occupancy", options.occupancy);
  f.section("goto", options.go);
  f.section("search", options.search);
  f.section("control_table", options.control_table);
  f.section("explore", options.explore);
  f.section("topology", options.topology);
  f.section("stereo", options.stereo);
  f.section("server", options.server);
}

namespace {

Status check_stereo(const StereoSettings& settings) {
  if (Status ok = vision::validate(settings.features); !ok) {
    return fail_with_context("features", ok.error());
  }
  if (Status ok = localize::validate(settings.database); !ok) {
    return fail_with_context("database", ok.error());
  }
  if (Status ok = localize::validate(settings.estimator.update); !ok) {
    return fail_with_context("estimator.update", ok.error());
  }
  const Status ok = localize::validate(settings.localiser);
  return ok ? ok : fail_with_context("localiser", ok.error());
}

}  // namespace

Status validate(const RobotOptions& options) {
  if (const Status ok = search::validate(options.search.search); !ok) {
    return fail_with_context("search.coverage", ok.error());
  }
  if (const Status ok = vision::validate(options.search.recogniser); !ok) {
    return fail_with_context("search.recogniser", ok.error());
  }
  if (const Status ok = explore::validate(options.explore); !ok) {
    return fail_with_context("explore", ok.error());
  }
  if (const Status ok = fleet::validate(options.topology); !ok) {
    return fail_with_context("topology", ok.error());
  }
  if (const Status ok = vision::validate(options.fleet.merge.pictures.views); !ok) {
    return fail_with_context("fleet.merge.pictures", ok.error());
  }
  const Status stereo = check_stereo(options.stereo);
  return stereo ? stereo : fail_with_context("stereo", stereo.error());
}

namespace {

/// `files_left`: how many more files may lie below this one.
Result<RobotOptions> read_over_base(const config::Document& document, const std::filesystem::path& file,
                                    int files_left) {
  RobotOptions alone;
  const Status read_alone = document.read(alone);
  if (alone.base.empty()) {
    if (!read_alone) {
      return tl::unexpected<Error>(read_alone.error());
    }
    alone.folders = {file.parent_path()};
    return alone;
  }
  if (files_left == 0) {
    return fail(Errc::kInvalidArgument, file.string() + ": base: more than " + std::to_string(kMaxRobotFiles) +
                                            " robot files on top of one another; does one of them name itself?");
  }
  const std::filesystem::path base = file.parent_path() / alone.base;
  const Result<config::Document> below = config::Document::load(base);
  if (!below) {
    return fail_with_context(file.string() + ": base", below.error());
  }
  Result<RobotOptions> options = read_over_base(*below, base, files_left - 1);
  if (!options) {
    return options;
  }
  if (const Status read = document.read(*options); !read) {
    return tl::unexpected<Error>(read.error());
  }
  options->base.clear();
  options->folders.insert(options->folders.begin(), file.parent_path());
  return options;
}

}  // namespace

Result<RobotOptions> parse_robot_options(std::string_view text, const std::string& name,
                                         const std::vector<std::string>& overrides) {
  const Result<config::Document> document = config::Document::parse(text, name, overrides);
  if (!document) {
    return tl::unexpected<Error>(document.error());
  }
  RobotOptions options;
  if (const Status read = document->read(options); !read) {
    return tl::unexpected<Error>(read.error());
  }
  if (!options.base.empty()) {
    return fail(Errc::kInvalidArgument, name + ": base: a text that is no file has no folder to find it in");
  }
  return options;
}

Result<RobotOptions> load_robot_options(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const Result<config::Document> document = config::Document::load(file, overrides);
  if (!document) {
    return tl::unexpected<Error>(document.error());
  }
  return read_over_base(*document, file, kMaxRobotFiles - 1);
}

std::filesystem::path resolve(const RobotOptions& options, const std::string& path) {
  std::filesystem::path written(path);
  if (written.is_absolute()) {
    return written;
  }
  for (const std::filesystem::path& folder : options.folders) {
    if (std::filesystem::path beside = folder / written; std::filesystem::exists(beside)) {
      return beside;
    }
  }
  return written;
}

Result<std::shared_ptr<const vision::SolidModel>> load_solids(const RobotOptions& options) {
  if (options.search.solids.model.empty()) {
    return nullptr;
  }
  Result<vision::SolidModel> model = options::load_solid_model(resolve(options, options.search.solids.model));
  if (!model) {
    return fail_with_context("search.solids.model", model.error());
  }
  return std::make_shared<const vision::SolidModel>(std::move(*model));
}

}  // namespace seeker::app
