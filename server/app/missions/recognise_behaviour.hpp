/// \file
/// Mission `recognise`: which targets are in front of the camera. The robot turns on the spot where more than one
/// direction is asked for, and never leaves its place.
#pragma once

#include <memory>
#include <vector>

#include "server/app/missions/behaviour.hpp"
#include "server/app/missions/picture_round.hpp"
#include "server/app/missions/search_behaviour.hpp"

namespace seeker::app {

class RecogniseBehaviour final : public Behaviour {
 public:
  /// Refuses targets that the recogniser cannot use.
  [[nodiscard]] static Result<std::unique_ptr<Behaviour>> create(const SearchBehaviourParams& params,
                                                                 const api::RecogniseMission& mission,
                                                                 std::shared_ptr<const vision::SolidModel> solids,
                                                                 const Situation& situation);

  [[nodiscard]] Decision step(const Situation& situation) override;
  [[nodiscard]] std::shared_ptr<const vision::Recogniser> recogniser() const override { return recogniser_.get(); }
  [[nodiscard]] Status use(const vision::RecogniserParams& params) override { return recogniser_.use(params); }
  void on_recognition(const Recognition& recognition) override { round_.take(recognition); }
  void map_moved(const MapMove& move) override;
  void resumed(RobotTime now) override;
  [[nodiscard]] std::vector<api::Detection> detections() const override;

 private:
  RecogniseBehaviour(const SearchBehaviourParams& params, const api::RecogniseMission& mission,
                     MissionRecogniser recogniser, const Situation& situation);
  [[nodiscard]] api::MissionEnd end() const;

  std::vector<search::SearchTarget> targets_;
  MissionRecogniser recogniser_;
  search::DetectionTracker tracker_;
  PictureRound round_;
  std::size_t pictures_ = 0;
};

}  // namespace seeker::app
