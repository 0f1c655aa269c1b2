/// \file
/// The recogniser of a mission's targets.
#pragma once

#include <memory>
#include <vector>

#include "common/api/mission.hpp"
#include "server/vision/solids/target_recogniser.hpp"

namespace seeker::app {

/// Knows the targets, so that the recogniser can be made again while the mission goes on.
class MissionRecogniser {
 public:
  /// Refuses targets that the recogniser cannot use. `solids` may be null: the robot recognises none.
  [[nodiscard]] static Result<MissionRecogniser> make(const std::vector<api::TargetSpec>& targets,
                                                      const vision::RecogniserParams& params,
                                                      std::shared_ptr<const vision::SolidModel> solids);

  /// Makes the recogniser again. Errors leave it as it was.
  [[nodiscard]] Status use(const vision::RecogniserParams& params);
  [[nodiscard]] const std::shared_ptr<const vision::Recogniser>& get() const { return recogniser_; }

 private:
  std::vector<vision::TargetModel> targets_;
  std::shared_ptr<const vision::SolidModel> solids_;
  std::shared_ptr<const vision::Recogniser> recogniser_;
};

}  // namespace seeker::app
