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
  return SearchTools{std::make_shared<const search::ControlTable>(std::move(*table)),
                     std::make_shared<std::optional<search::EvidenceGrid>>(), nullptr};
}

Status load_solids_into(const RobotOptions& options, SearchTools& tools) {
  Result<std::shared_ptr<const vision::SolidModel>> solids = load_solids(options);
  if (!solids) {
    return tl::unexpected<Error>(solids.error());
  }
  tools.solids = std::move(*solids);
  return {};
}

RobotBehaviours::RobotBehaviours(std::shared_ptr<const RobotOptions> options, std::shared_ptr<const SearchTools> tools,
                                 bool has_camera, std::optional<StereoMissions> stereo)
    : options_(std::move(options)), tools_(std::move(tools)), has_camera_(has_camera), stereo_(std::move(stereo)) {}

/// A solid has no picture to recognise it by.
std::vector<api::TargetSpec> RobotBehaviours::as_recognised(std::vector<api::TargetSpec> targets) const {
  for (api::TargetSpec& target : targets) {
    if (options_->recogniser && target.recogniser != api::RecogniserKind::kSolid) {
      target.recogniser = *options_->recogniser;
    }
  }
  return targets;
}

Result<std::unique_ptr<Behaviour>> RobotBehaviours::operator()(const api::MissionTask& task,
                                                               const Situation& situation) {
  if (const auto* go = std::get_if<api::GotoMission>(&task)) {
    return std::unique_ptr<Behaviour>(std::make_unique<GotoBehaviour>(options_->go, *go));
  }
  if (const auto* home = std::get_if<api::ReturnMission>(&task)) {
    return return_to_start(*home);
  }
  if (const auto* explore = std::get_if<api::ExploreMission>(&task)) {
    return ExploreBehaviour::create({options_->explore, options_->topology}, *explore, situation);
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
    api::RecogniseMission mission = *recognise;
    mission.targets = as_recognised(std::move(mission.targets));
    return RecogniseBehaviour::create(options_->search, mission, tools_->solids, situation);
  }
  return search(std::get<api::SearchMission>(task), situation);
}

Result<std::unique_ptr<Behaviour>> RobotBehaviours::return_to_start(const api::ReturnMission& mission) const {
  api::GotoMission home;
  home.waypoints = mission.along;
  home.waypoints.emplace_back(Point2::Zero());  // the map begins where the robot was started
  home.keep_out = mission.keep_out;
  GotoParams go = options_->go;
  go.cost_map.unknown_traversable = false;  // the robot came over floor that it has seen
  return std::unique_ptr<Behaviour>(
      std::make_unique<GotoBehaviour>(go, std::move(home), mission.bound, mission.along.size()));
}

Result<std::unique_ptr<Behaviour>> RobotBehaviours::search(const api::SearchMission& mission,
                                                           const Situation& situation) const {
  std::unique_ptr<MapViewFinder> views;
  if (mission.explore) {
    if (const Status grows = check_map_grows(situation); !grows) {
      return tl::unexpected<Error>(grows.error());
    }
    views = std::make_unique<MapViewFinder>(options_->explore, nav::ForbiddenAreas{mission.bound, mission.keep_out});
  }
  api::SearchMission recognised = mission;
  recognised.targets = as_recognised(std::move(recognised.targets));
  return SearchBehaviour::create(options_->search, recognised, *tools_, std::move(views));
}

}  // namespace seeker::app
