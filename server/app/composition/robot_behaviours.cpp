#include "server/app/composition/robot_behaviours.hpp"

#include <utility>

#include "server/app/missions/recognise_behaviour.hpp"

namespace seeker::app {
namespace {

Result<std::unique_ptr<Behaviour>> no_stereo() {
  return fail(Errc::kRefused, "this robot has no stereo camera to find landmarks with");
}

}  // namespace

/// The evidence of other searches is forgotten with the map.
Result<SearchTools> make_search_tools(const RobotOptions& options) {
  Result<search::ControlTable> table = search::ControlTable::create(options.control_table);
  if (!table) {
    return fail_with_context("control_table", table.error());
  }
  Result<std::shared_ptr<const vision::SolidModel>> solids = load_solids(options);
  if (!solids) {
    return tl::unexpected<Error>(solids.error());
  }
  return SearchTools{std::make_shared<const search::ControlTable>(std::move(*table)),
                     std::make_shared<std::optional<search::EvidenceGrid>>(), std::move(*solids)};
}

RobotBehaviours::RobotBehaviours(const RobotOptions& options, SearchTools tools, bool has_camera,
                                 std::optional<StereoMissions> stereo)
    : go_(options.go),
      search_(options.search),
      explore_{options.explore, options.topology},
      tools_(std::move(tools)),
      has_camera_(has_camera),
      stereo_(std::move(stereo)) {}

Result<std::unique_ptr<Behaviour>> RobotBehaviours::operator()(const api::MissionTask& task,
                                                               const Situation& situation) {
  if (const auto* go = std::get_if<api::GotoMission>(&task)) {
    return std::unique_ptr<Behaviour>(std::make_unique<GotoBehaviour>(go_, *go));
  }
  if (const auto* home = std::get_if<api::ReturnMission>(&task)) {
    return return_to_start(*home);
  }
  if (const auto* explore = std::get_if<api::ExploreMission>(&task)) {
    return ExploreBehaviour::create(explore_, *explore, situation);
  }
  if (const auto* survey = std::get_if<api::SurveyMission>(&task)) {
    return stereo_ ? stereo_->survey(*survey, situation) : no_stereo();
  }
  if (const auto* localise = std::get_if<api::LocaliseMission>(&task)) {
    return stereo_ ? stereo_->localise(*localise, situation) : no_stereo();
  }
  if (!has_camera_) {
    return fail(Errc::kRefused, "this robot has no camera to search with");
  }
  if (const auto* recognise = std::get_if<api::RecogniseMission>(&task)) {
    return RecogniseBehaviour::create(search_, *recognise, tools_.solids.get(), situation);
  }
  return search(std::get<api::SearchMission>(task), situation);
}

Result<std::unique_ptr<Behaviour>> RobotBehaviours::return_to_start(const api::ReturnMission& mission) const {
  api::GotoMission home;
  home.waypoints = {Point2::Zero()};  // the map begins where the robot was started
  home.keep_out = mission.keep_out;
  GotoParams go = go_;
  go.cost_map.unknown_traversable = false;  // the robot came over floor that it has seen
  return std::unique_ptr<Behaviour>(std::make_unique<GotoBehaviour>(go, std::move(home), mission.bound));
}

Result<std::unique_ptr<Behaviour>> RobotBehaviours::search(const api::SearchMission& mission,
                                                           const Situation& situation) const {
  std::unique_ptr<MapViewFinder> views;
  if (mission.explore) {
    if (const Status grows = check_map_grows(situation); !grows) {
      return tl::unexpected<Error>(grows.error());
    }
    views = std::make_unique<MapViewFinder>(explore_.params, nav::ForbiddenAreas{mission.bound, mission.keep_out});
  }
  return SearchBehaviour::create(search_, mission, tools_, std::move(views));
}

}  // namespace seeker::app
