/// \file
/// Mission `search`: the coverage search of server/search behind the loop's behaviour interface.
#pragma once

#include <memory>
#include <optional>

#include "server/app/behaviour.hpp"
#include "server/app/map_views.hpp"
#include "server/search/search_mission.hpp"
#include "server/vision/multi_recogniser.hpp"

namespace seeker::app {

/// What searches leave behind for one another: the evidence that `gaps_only` continues from.
using EvidenceMemory = std::shared_ptr<std::optional<search::EvidenceGrid>>;

struct SearchBehaviourParams {
  search::SearchParams search;
  vision::RecogniserParams recogniser;
  std::optional<search::Strategy> strategy;  ///< instead of the mission's mode: the baselines of the experiments
};

class SearchBehaviour final : public Behaviour {
 public:
  /// Refuses targets that the recogniser cannot use. `views` where the mission explores too, else null.
  [[nodiscard]] static Result<std::unique_ptr<Behaviour>> create(
      const SearchBehaviourParams& params, const api::SearchMission& mission,
      const std::shared_ptr<const search::ControlTable>& table, EvidenceMemory memory,
      std::unique_ptr<MapViewFinder> views = nullptr);
  ~SearchBehaviour() override;

  [[nodiscard]] Decision step(const Situation& situation) override;
  [[nodiscard]] std::shared_ptr<const vision::Recogniser> recogniser() const override { return recogniser_; }
  void on_recognition(const Recognition& recognition) override;
  void resumed(RobotTime now) override;
  void map_moved(const Pose2& new_T_old) override;
  [[nodiscard]] std::optional<api::GridReport> grid() const override;
  [[nodiscard]] std::vector<api::Detection> detections() const override;

 private:
  SearchBehaviour(search::SearchMission mission, std::shared_ptr<const vision::Recogniser> recogniser,
                  EvidenceMemory memory, std::unique_ptr<MapViewFinder> views);

  search::SearchMission mission_;
  std::shared_ptr<const vision::Recogniser> recogniser_;
  EvidenceMemory memory_;
  std::unique_ptr<MapViewFinder> views_;
  bool stepped_ = false;
};

}  // namespace seeker::app
