#include "server/app/composition/robot_assembly.hpp"

#include <memory>
#include <utility>

#include "server/app/composition/device_factory.hpp"
#include "server/app/composition/estimators.hpp"
#include "server/app/composition/live_options.hpp"
#include "server/app/composition/robot_behaviours.hpp"

namespace seeker::app {
namespace {

Status check_safety(const Devices& devices, const RangeInputs& inputs) {
  const bool fed = (devices.lidar != nullptr && inputs.scan) || (devices.sonar != nullptr && inputs.echoes);
  const bool can_be_fed = devices.lidar != nullptr || devices.sonar != nullptr;
  return fed || !can_be_fed ? Status()
                            : fail(Errc::kInvalidArgument,
                                   "connections.safety: neither the lidar nor the sonar of this robot feeds the safety "
                                   "supervisor; connect one of them");
}

/// Null where the robot has no camera or no fleet, or is told to take no pictures.
Result<std::shared_ptr<const vision::ViewFeatureExtractor>> picture_extractor(const RobotOptions& options,
                                                                              const Devices& devices) {
  const bool in_fleet = options.fleet.lead || !options.fleet.join.empty();
  if (!in_fleet || devices.camera == nullptr || options.loop.pictures.at == PicturesAt::kNever) {
    return std::shared_ptr<const vision::ViewFeatureExtractor>();
  }
  if (const Status ok = vision::validate(options.search.recogniser); !ok) {
    return fail_with_context("search.recogniser", ok.error());
  }
  vision::DetectorParams detector;
  detector.wanted = options.loop.pictures.features;
  return std::make_shared<const vision::ViewFeatureExtractor>(options.search.recogniser.view, detector);
}

/// Everything but the devices.
Result<Assembly> complete(const RobotOptions& robot, LandmarkStorage landmarks, MadeDevices made) {
  Assembly assembly;
  assembly.parts.devices = std::move(made.devices);
  assembly.simulation = std::move(made.simulation);
  assembly.faults = std::move(made.faults);
  assembly.landmarks = std::make_shared<LandmarkLibrary>(std::move(landmarks));
  if (const Status ok = validate(robot); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  LoopParts& parts = assembly.parts;
  if (const Status ok = check_safety(parts.devices, robot.loop.connections.safety); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  // One copy for all that goes by the settings as they are now; they change on the loop's thread only.
  const auto options = std::make_shared<RobotOptions>(robot);
  Result<SearchTools> tools = make_search_tools(*options);
  if (!tools) {
    return tl::unexpected<Error>(tools.error());
  }
  const auto shared_tools = std::make_shared<SearchTools>(std::move(*tools));
  std::optional<StereoMissions> stereo;
  if (parts.devices.stereo != nullptr) {
    parts.stereo = vision::make_stereo_extractor(parts.devices.stereo->geometry(), options->stereo.features);
    stereo.emplace(*options, parts.devices, assembly.landmarks);
  }
  Result<std::unique_ptr<Estimator>> estimator = make_estimator(*options, parts.devices, assembly.landmarks);
  if (!estimator) {
    return tl::unexpected<Error>(estimator.error());
  }
  assembly.landmarks->set_in_use(database_in_use(*options));
  parts.estimator = std::move(*estimator);
  auto pictures = picture_extractor(*options, parts.devices);
  if (!pictures) {
    return tl::unexpected<Error>(pictures.error());
  }
  parts.pictures = std::move(*pictures);
  parts.estimator_type = to_string(options->estimator);
  parts.recogniser_type = name_of(recogniser_names(), options->recogniser);
  parts.planner_type = name_of(planner_names(), options->search.strategy);
  parts.occupancy = options->occupancy;
  parts.lines = options->lines;
  parts.forget_places = [memory = shared_tools->memory] { memory->reset(); };
  parts.activate_recogniser = [options, shared_tools] { return load_solids_into(*options, *shared_tools); };
  parts.behaviours = RobotBehaviours(options, shared_tools, parts.devices.camera != nullptr, std::move(stereo));
  parts.configuration = std::make_shared<LiveOptions>(options, parts.devices, assembly.landmarks);
  return assembly;
}

}  // namespace

Result<Assembly> assemble(const RobotOptions& options, LandmarkStorage landmarks) {
  Result<MadeDevices> made = make_devices(options);
  return made ? complete(options, std::move(landmarks), std::move(*made))
              : Result<Assembly>(tl::unexpected<Error>(made.error()));
}

Result<SharedAssembly> assemble_shared(std::span<const RobotOptions> robots) {
  Result<MadeSharedDevices> made = make_shared_devices(robots);
  if (!made) {
    return tl::unexpected<Error>(made.error());
  }
  SharedAssembly shared{made->world, made->barrier, {}};
  shared.robots.reserve(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Result<Assembly> completed = complete(robots[i], {}, std::move(made->robots[i]));
    if (!completed) {
      return tl::unexpected<Error>(completed.error());
    }
    shared.robots.push_back(std::move(*completed));
  }
  return shared;
}

}  // namespace seeker::app
