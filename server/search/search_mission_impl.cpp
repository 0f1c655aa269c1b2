#include "server/search/search_mission_impl.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"
#include "server/search/map_coverage.hpp"
#include "server/search/paper_coverage.hpp"

namespace seeker::search {
namespace {

/// Slower than this a robot stands.
constexpr double kStandingStep_m = 0.004;
constexpr double kStandingStep_rad = 0.01;
/// The driven distance is measured in steps of this length, so that noise of a standing robot adds nothing.
constexpr double kPathStep_m = 0.05;
/// Period at which reachable floor is recorded, whether or not a path is planned.
constexpr double kNoteFloor_s = 3.0;

LocalPlanner make_planner(const SearchRequest& request, const SearchParams& params,
                          const std::shared_ptr<const ControlTable>& table) {
  LocalPlannerParams local;
  local.drive = params.paper.drive;
  local.silence_s = params.paper.sonar_silence_s;
  return {table, request.areas, local};
}

std::unique_ptr<CoverageStrategy> make_strategy(const SearchRequest& request, const SearchParams& params,
                                                const LocalPlanner& planner) {
  switch (request.strategy) {
    case Strategy::kPaper: return std::make_unique<PaperCoverage>(params.paper, planner, request.areas);
    case Strategy::kSpiral:
      return std::make_unique<MapCoverage>(params.plan, std::make_unique<SpiralChooser>(params.plan));
    case Strategy::kFrontier:
      return std::make_unique<MapCoverage>(params.plan, std::make_unique<FrontierChooser>(params.plan));
    case Strategy::kPlan: break;
  }
  return std::make_unique<MapCoverage>(params.plan, std::make_unique<PlanChooser>(params.plan));
}

/// As printed, every sighting is looked at again at once: none is doubtful.
SearchParams params_for(const SearchRequest& request, SearchParams params) {
  if (request.strategy == Strategy::kPaper) {
    params.detection.doubtful_score = 0.0;
  }
  return params;
}

}  // namespace

SearchMission::Impl::Impl(SearchRequest request, const SearchParams& params,
                          const std::shared_ptr<const ControlTable>& table)
    : request_(std::move(request)),
      params_(params_for(request_, params)),
      floors_(params.plan.cost, request_.areas, params.evidence.cell_m, params.plan.map_period_s),
      evidence_(params.evidence, params.hit_rate),
      tracker_(request_.targets, params_.detection),
      planner_(make_planner(request_, params, table)),
      strategy_(make_strategy(request_, params, planner_)),
      visit_(params, planner_, request_.strategy != Strategy::kPaper) {}

void SearchMission::Impl::note_floor(const Point2& robot_map, RobotTime now) {
  if (!floor_noted_at_ || to_seconds(now - *floor_noted_at_) >= kNoteFloor_s) {
    floor_noted_at_ = now;
    static_cast<void>(floors_.view());  // where the robot stands walled in, nothing new can be reached
  }
  const auto& last = floors_.last();
  if (last != noted_floor_) {
    known_floor_.add(*last, robot_map, params_.hit_rate.max_range_m);
    noted_floor_ = last;
  }
}

StrategyInput SearchMission::Impl::strategy_input(const SearchInput& input) {
  return {{input.now - paused_, input.map_T_base, input.sonar, input.laser, floors_},
          evidence_,
          smallest_target_m(),
          input.map_views,
          known_floor_};
}

double SearchMission::Impl::smallest_target_m() const {
  double smallest = kMaxTargetSize_m;
  for (const SearchTarget& target : request_.targets) {
    smallest = std::min({smallest, target.width_m, target.height_m});
  }
  return smallest;
}

std::string SearchMission::Impl::name_of(int target) const {
  return "'" + request_.targets.at(static_cast<std::size_t>(target)).name + "'";
}

SearchStep SearchMission::Impl::step(const SearchInput& input) {
  SearchStep out;
  last_now_ = input.now;
  if (end_) {
    out.phase = "done";
    out.activity = end_->cause;
    out.end = end_;
    return out;
  }
  if (!is_finite(input.map_T_base)) {
    out.phase = "stopped";
    out.activity = "the pose is not known; waiting for the localisation";
    return out;
  }
  account(input, out);
  floors_.attend(input.map, input.map_T_base, input.now - paused_);
  note_floor(input.map_T_base.translation(), input.now - paused_);
  const StrategyInput now = strategy_input(input);
  if (!end_) {
    process_looks(now, out);
  }
  if (!end_) {
    confirm_next(now.now, false);
    if (visit_.active()) {
      run_visit(now, out);
    } else {
      run_cover(now, out);
    }
  }
  if (end_) {
    out.command = {};
    out.wants_image = false;
    out.phase = "done";
    out.activity = end_->cause;
    out.end = end_;
  }
  return out;
}

void SearchMission::Impl::account(const SearchInput& input, SearchStep& out) {
  const Point2 here = input.map_T_base.translation();
  if (!std::exchange(started_, true)) {
    path_anchor_ = here;
    last_pose_ = input.map_T_base;
    map_epoch_ = input.map_epoch;
  }
  if (const double step = (here - path_anchor_).norm(); step > kPathStep_m) {
    path_length_m_ += step;
    path_anchor_ = here;
  }
  const bool stands = distance_m(input.map_T_base, last_pose_) < kStandingStep_m &&
                      std::abs(wrap_angle(input.map_T_base.theta_rad - last_pose_.theta_rad)) < kStandingStep_rad;
  if (!stands) {
    standing_since_.reset();
  } else if (!standing_since_) {
    standing_since_ = input.now - paused_;
  }
  last_pose_ = input.map_T_base;
  pose_covariance_ = input.covariance;
  if (std::exchange(map_epoch_, input.map_epoch) != input.map_epoch) {
    strategy_->interrupted(input.now - paused_);
    visit_.interrupted();
  }
  const double sigma = std::sqrt(std::max({0.0, input.covariance(0, 0), input.covariance(1, 1)}));
  if (!(sigma <= params_.mission.max_position_sigma_m)) {
    finish(EndKind::kUncertain, "the robot's position is uncertain by " + text(sigma) + " m",
           "localise again, then search the gaps only", out);
  }
}

void SearchMission::Impl::run_cover(const StrategyInput& input, SearchStep& out) {
  StrategyStep step = strategy_->step(input);
  if (step.done) {
    out.events.insert(out.events.end(), step.events.begin(), step.events.end());
    if (confirm_next(input.now, true)) {
      return;
    }
    finish_covered(step, input, out);
    return;
  }
  hand_over(std::move(step), input, out);
}

void SearchMission::Impl::hand_over(StrategyStep&& from, const StrategyInput& input, SearchStep& out) {
  out.command = from.command;
  out.wants_image = from.wants_image;
  out.while_moving = from.while_moving;
  out.phase = std::move(from.phase);
  out.activity = std::move(from.activity);
  out.planned_path = std::move(from.planned_path);
  out.events.insert(out.events.end(), std::make_move_iterator(from.events.begin()),
                    std::make_move_iterator(from.events.end()));
  settle_image(input, out);
}

/// A still picture waits until the robot stands; one that does not come is gone without.
void SearchMission::Impl::settle_image(const StrategyInput& input, SearchStep& out) {
  if (!out.wants_image) {
    waiting_since_.reset();
    return;
  }
  if (!out.while_moving) {
    out.command = {};
    const bool settled = standing_since_ && to_seconds(input.now - *standing_since_) >= params_.mission.settle_s;
    if (!settled && !waiting_since_) {
      out.wants_image = false;
      return;
    }
  }
  if (!waiting_since_) {
    waiting_since_ = input.now;
  } else if (to_seconds(input.now - *waiting_since_) > params_.mission.image_timeout_s) {
    if (!std::exchange(image_missing_, true)) {
      out.events.push_back({"no_image", "no picture came in time; going on without"});
    }
    image_taken(input);
    out.wants_image = false;
  }
}

void SearchMission::Impl::image_taken(const StrategyInput& input) {
  waiting_since_.reset();
  if (visit_.active()) {
    visit_.image_taken();
  } else {
    strategy_->image_taken(input);
  }
}

void SearchMission::Impl::resume(RobotTime now) {
  paused_ += now - last_now_;
  strategy_->interrupted(now - paused_);
  visit_.interrupted();
  waiting_since_.reset();
  standing_since_.reset();
}

void SearchMission::Impl::transform(const MapMove& move) {
  strategy_->transform(move);
  evidence_.transform(move);
  tracker_.transform(move);
  floors_.transform(move);
  known_floor_.transform(move);
  noted_floor_ = floors_.last();  // made from the map before
  visit_.interrupted();
  path_anchor_ = move * path_anchor_;
  last_pose_ = move * last_pose_;
  for (PendingLook& look : looks_) {
    look.camera_map = move * look.camera_map;
  }
  for (Point2& p : refused_) {
    p = move * p;
  }
  for (Pose2& bearing : refused_bearings_) {
    bearing = move * bearing;
  }
}

}  // namespace seeker::search
