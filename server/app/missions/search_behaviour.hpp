/// \file
/// Mission `search`: the coverage search of server/search behind the loop's behaviour interface.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "server/app/missions/behaviour.hpp"
#include "server/app/missions/map_view_finder.hpp"
#include "server/app/missions/mission_recogniser.hpp"
#include "server/app/missions/picture_round.hpp"
#include "server/search/search_mission.hpp"
#include "server/vision/solids/target_recogniser.hpp"

namespace seeker::app {

/// What searches leave behind for one another: the evidence that `gaps_only` continues from.
using EvidenceMemory = std::shared_ptr<std::optional<search::EvidenceGrid>>;

/// The recogniser of solids (spec S6).
struct SolidSettings {
  std::string model;  ///< file that `seeker-lab train-solids` wrote, relative to the robot file; empty: no solids
};

struct SearchBehaviourParams {
  search::SearchParams search;
  vision::RecogniserParams recogniser;
  SolidSettings solids;
  RoundParams round;                         ///< of cameras that do not see all around
  std::optional<search::Strategy> strategy;  ///< instead of the mission's mode: the baselines of the experiments
};

/// What all missions that look for targets share.
struct SearchTools {
  std::shared_ptr<const search::ControlTable> table;
  EvidenceMemory memory;
  std::shared_ptr<const vision::SolidModel> solids;  ///< null: this robot recognises none
};

class SearchBehaviour final : public Behaviour {
 public:
  /// Refuses targets that the recogniser cannot use. `views` where the mission explores too, else null.
  [[nodiscard]] static Result<std::unique_ptr<Behaviour>> create(const SearchBehaviourParams& params,
                                                                 const api::SearchMission& mission,
                                                                 const SearchTools& tools,
                                                                 std::unique_ptr<MapViewFinder> views = nullptr);
  ~SearchBehaviour() override;

  [[nodiscard]] Decision step(const Situation& situation) override;
  [[nodiscard]] std::shared_ptr<const vision::Recogniser> recogniser() const override { return recogniser_.get(); }
  [[nodiscard]] Status use(const vision::RecogniserParams& params) override { return recogniser_.use(params); }
  void on_recognition(const Recognition& recognition) override;
  void resumed(RobotTime now) override;
  void map_moved(const MapMove& move) override;
  [[nodiscard]] MissionMemory memory() const override;
  void remember(const MissionMemory& memory) override;
  [[nodiscard]] std::optional<api::GridReport> grid() const override;
  [[nodiscard]] std::optional<SearchedFloor> searched(const Point2& middle_map, int side_cells) const override;
  [[nodiscard]] std::vector<api::Detection> detections() const override;

 private:
  SearchBehaviour(search::SearchMission mission, MissionRecogniser recogniser, EvidenceMemory memory,
                  std::unique_ptr<MapViewFinder> views);
  [[nodiscard]] Decision look_around(const Situation& situation);
  void receive(const FleetView* fleet);

  search::SearchMission mission_;
  MissionRecogniser recogniser_;
  EvidenceMemory memory_;
  SharedSearch others_;  ///< what the mission received last
  std::unique_ptr<MapViewFinder> views_;
  std::optional<PictureRound> round_;  ///< in place of a single picture
  int pictures_around_ = 1;
  bool stepped_ = false;
  Point2 place_map_ = Point2::Zero();  ///< of the robot at the last step
};

}  // namespace seeker::app
