#include "server/app/composition/robot_assembly.hpp"

#include <utility>

#include "server/app/composition/device_factory.hpp"
#include "server/app/composition/estimators.hpp"
#include "server/app/composition/robot_behaviours.hpp"

namespace seeker::app {
namespace {

Status validate(const StereoSettings& settings) {
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

/// Everything but the devices.
Result<Assembly> complete(const RobotOptions& options, LandmarkStorage landmarks, MadeDevices made) {
  Assembly assembly;
  assembly.parts.devices = std::move(made.devices);
  assembly.simulation = std::move(made.simulation);
  assembly.faults = std::move(made.faults);
  assembly.landmarks.library = std::make_shared<LandmarkLibrary>(std::move(landmarks));
  if (const Status ok = search::validate(options.search.search); !ok) {
    return fail_with_context("search.coverage", ok.error());
  }
  if (const Status ok = explore::validate(options.explore); !ok) {
    return fail_with_context("explore", ok.error());
  }
  if (const Status ok = fleet::validate(options.topology); !ok) {
    return fail_with_context("topology", ok.error());
  }
  const Result<SearchTools> tools = make_search_tools(options);
  if (!tools) {
    return tl::unexpected<Error>(tools.error());
  }
  LoopParts& parts = assembly.parts;
  std::optional<StereoMissions> stereo;
  if (parts.devices.stereo != nullptr) {
    if (const Status ok = validate(options.stereo); !ok) {
      return fail_with_context("stereo", ok.error());
    }
    parts.stereo = vision::make_stereo_extractor(parts.devices.stereo->geometry(), options.stereo.features);
  }
  if (options.estimator == EstimatorType::kLandmarks) {
    assembly.landmarks.in_use = options.stereo.estimator.database;
  }
  Result<std::unique_ptr<Estimator>> estimator = make_estimator(options, parts.devices, assembly.landmarks.library);
  if (!estimator) {
    return tl::unexpected<Error>(estimator.error());
  }
  parts.estimator = std::move(*estimator);
  if (parts.devices.stereo != nullptr) {
    stereo.emplace(options, parts.devices, assembly.landmarks);
  }
  parts.estimator_type = to_string(options.estimator);
  parts.occupancy = options.occupancy;
  parts.lines = options.lines;
  parts.forget_places = [memory = tools->memory] { memory->reset(); };
  parts.behaviours = RobotBehaviours(options, *tools, parts.devices.camera != nullptr, std::move(stereo));
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
