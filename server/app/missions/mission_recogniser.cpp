#include "server/app/missions/mission_recogniser.hpp"

#include <utility>

#include "server/app/missions/target_values.hpp"

namespace seeker::app {

Result<MissionRecogniser> MissionRecogniser::make(const std::vector<api::TargetSpec>& targets,
                                                  const vision::RecogniserParams& params,
                                                  std::shared_ptr<const vision::SolidModel> solids) {
  MissionRecogniser made;
  made.targets_ = target_models(targets);
  made.solids_ = std::move(solids);
  if (const Status ok = made.use(params); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return made;
}

Status MissionRecogniser::use(const vision::RecogniserParams& params) {
  Result<std::unique_ptr<vision::Recogniser>> recogniser =
      vision::make_target_recogniser(targets_, params, solids_.get());
  if (!recogniser) {
    return tl::unexpected<Error>(recogniser.error());
  }
  recogniser_ = std::move(*recogniser);
  return {};
}

}  // namespace seeker::app
