/// \file
/// Mission `survey`: stereo pictures in several directions at several places become a database of landmarks (spec S2.4
/// to S2.7).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/app/landmarks/landmark_library.hpp"
#include "server/app/missions/goto_behaviour.hpp"
#include "server/app/missions/rotate_and_look.hpp"
#include "server/app/runtime/background.hpp"
#include "server/localize/localiser_params.hpp"
#include "server/localize/survey.hpp"

namespace seeker::app {

struct SurveyParams {
  double spacing_m = 1.5;  ///< of the four places around the first, where none are given
  RotateAndLookParams look;
};

/// What a survey needs to know of the camera and of the database it makes.
struct SurveySettings {
  SurveyParams params;
  GotoParams go;
  StereoGeometry geometry;
  localize::DatabaseParams database;
  localize::LeverArm arm;
  double eye_height_m = 0.0;
  bool inline_work = true;  ///< lockstep: the database is made within a tick
};

class SurveyBehaviour final : public Behaviour {
 public:
  /// kRefused: no stereo camera, or there is such a database and the mission does not replace it.
  [[nodiscard]] static Result<std::unique_ptr<Behaviour>> create(const SurveySettings& settings,
                                                                 const api::SurveyMission& mission,
                                                                 std::shared_ptr<LandmarkLibrary> library,
                                                                 const Situation& situation);

  [[nodiscard]] Decision step(const Situation& situation) override;
  void on_look(const Result<StereoLook>& look) override;
  void map_moved(const MapMove& move) override;
  void resumed(RobotTime now) override;

 private:
  enum class Phase : std::uint8_t { kDrive, kLook, kSave };

  SurveyBehaviour(const SurveySettings& settings, const api::SurveyMission& mission,
                  std::shared_ptr<LandmarkLibrary> library, const Situation& situation);
  void drive(const Situation& situation, Decision& decision);
  void look(const Situation& situation, Decision& decision);
  void save(Decision& decision);
  void begin_place();
  void begin_save();
  [[nodiscard]] double progress() const;

  SurveySettings settings_;
  api::SurveyMission mission_;
  std::shared_ptr<LandmarkLibrary> library_;
  std::string map_name_;
  bool places_given_;
  Phase phase_ = Phase::kDrive;
  std::size_t place_ = 0;
  std::unique_ptr<GotoBehaviour> drive_;
  RotateAndLook sweep_;
  std::vector<localize::Sighting> sightings_;
  std::vector<UnreachablePlace> unreachable_;
  std::vector<BehaviourEvent> events_;  ///< for the next step
  Background<api::LandmarkSummary> saving_;
};

}  // namespace seeker::app
