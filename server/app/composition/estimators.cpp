#include "server/app/composition/estimators.hpp"

#include "common/core/assert.hpp"
#include "common/core/rng.hpp"
#include "server/app/estimators/landmark_estimator.hpp"
#include "server/app/estimators/tracker_estimator.hpp"
#include "server/slam/line_slam.hpp"
#include "server/slam/odometry_tracker.hpp"
#include "server/slam/scan_map_tracker.hpp"

namespace seeker::app {
namespace {

bool needs_lidar(EstimatorType type) { return type == EstimatorType::kScanMatch || type == EstimatorType::kLineSlam; }

}  // namespace

const std::vector<std::pair<std::string_view, EstimatorType>>& estimator_names() {
  static const std::vector<std::pair<std::string_view, EstimatorType>> kNames = {
      {"odometry", EstimatorType::kOdometry},
      {"scan_match", EstimatorType::kScanMatch},
      {"line_slam", EstimatorType::kLineSlam},
      {"landmarks", EstimatorType::kLandmarks}};
  return kNames;
}

std::string_view to_string(EstimatorType type) {
  for (const auto& [name, known] : estimator_names()) {
    if (known == type) {
      return name;
    }
  }
  return "unknown";
}

bool is_tracker(EstimatorType type) { return type != EstimatorType::kLandmarks; }

std::string database_in_use(const RobotOptions& options) {
  return options.estimator == EstimatorType::kLandmarks ? options.stereo.estimator.database : "";
}

std::unique_ptr<slam::PoseTracker> make_tracker(EstimatorType type, const RobotOptions& options) {
  SEEKER_ASSERT(is_tracker(type));
  switch (type) {
    case EstimatorType::kOdometry: return std::make_unique<slam::OdometryTracker>(options.tracking.odometry);
    case EstimatorType::kScanMatch: return std::make_unique<slam::ScanMapTracker>(options.tracking);
    default: break;
  }
  slam::LineSlamParams slam = options.slam;
  slam.extractor = options.lines;
  return std::make_unique<slam::LineSlam>(slam);
}

Result<std::unique_ptr<Estimator>> make_estimator(const RobotOptions& options, const Devices& devices,
                                                  const std::shared_ptr<LandmarkLibrary>& library) {
  if (needs_lidar(options.estimator) && devices.lidar == nullptr) {
    return fail(Errc::kInvalidArgument, "estimator " + std::string(to_string(options.estimator)) +
                                            " needs a lidar, and this robot has none; write 'estimator: odometry'");
  }
  if (is_tracker(options.estimator)) {
    return std::unique_ptr<Estimator>(std::make_unique<TrackerEstimator>(make_tracker(options.estimator, options)));
  }
  if (devices.stereo == nullptr) {
    return fail(Errc::kInvalidArgument, "estimator landmarks needs a stereo camera, and this robot has none");
  }
  const LandmarkEstimatorParams& params = options.stereo.estimator;
  if (const Status ok = validate_map_name(params.database); !ok) {
    return fail(Errc::kInvalidArgument,
                "estimator landmarks needs the name of a database; give it with --set stereo.estimator.database=NAME");
  }
  const Result<LoadedLandmarks> loaded = library->load(params.database);
  if (!loaded) {
    return tl::unexpected<Error>(loaded.error());
  }
  Result<localize::StereoLocaliser> localiser =
      localize::StereoLocaliser::create(devices.stereo->geometry(), loaded->database, options.stereo.localiser);
  if (!localiser) {
    return fail_with_context("database '" + params.database + "'", localiser.error());
  }
  return std::unique_ptr<Estimator>(std::make_unique<LandmarkEstimator>(
      std::move(*localiser), loaded->database, params,
      LandmarkUpdating{
          .library = library, .geometry = devices.stereo->geometry(), .inline_work = devices.clock->lockstep()},
      Rng(options.sim.seed).fork("landmark-estimator")));
}

}  // namespace seeker::app
