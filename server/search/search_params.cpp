#include "server/search/search_params.hpp"

#include <initializer_list>
#include <string>
#include <utility>

#include "common/core/searched_floor.hpp"

namespace seeker::search {
namespace {

Status all_positive(std::initializer_list<std::pair<const char*, double>> fields) {
  for (const auto& [name, value] : fields) {
    if (!(value > 0.0)) {
      return fail(Errc::kInvalidArgument, std::string(name) + " must be above zero");
    }
  }
  return {};
}

Status all_probabilities(std::initializer_list<std::pair<const char*, double>> fields) {
  for (const auto& [name, value] : fields) {
    if (!(value > 0.0) || !(value <= 1.0)) {
      return fail(Errc::kInvalidArgument, std::string(name) + " must lie in (0, 1]");
    }
  }
  return {};
}

Status validate_lengths(const SearchParams& p) {
  return all_positive({{"paper.cell_m", p.paper.cell_m},
                       {"paper.sonar_limit_m", p.paper.sonar_limit_m},
                       {"paper.robot_radius_m", p.paper.robot_radius_m},
                       {"paper.area_m2", p.paper.area_m2},
                       {"paper.reach_time_s", p.paper.reach_time_s},
                       {"paper.progress_time_s", p.paper.progress_time_s},
                       {"paper.stuck_time_s", p.paper.stuck_time_s},
                       {"plan.cell_m", p.plan.cell_m},
                       {"plan.look_spacing_m", p.plan.look_spacing_m},
                       {"plan.stop_spacing_m", p.plan.stop_spacing_m},
                       {"plan.travel_offset_m", p.plan.travel_offset_m},
                       {"plan.goal_time_s", p.plan.goal_time_s},
                       {"plan.retry_s", p.plan.retry_s},
                       {"plan.min_cut_off_m2", p.plan.min_cut_off_m2},
                       {"mission.image_timeout_s", p.mission.image_timeout_s},
                       {"mission.standoff_m", p.mission.standoff_m},
                       {"mission.confirm_time_s", p.mission.confirm_time_s},
                       {"mission.approach_time_s", p.mission.approach_time_s},
                       {"evidence.cell_m", p.evidence.cell_m},
                       {"detection.bearing_sigma_rad", p.detection.bearing_sigma_rad},
                       {"detection.sonar_sigma_m", p.detection.sonar_sigma_m},
                       {"detection.lidar_sigma_m", p.detection.lidar_sigma_m},
                       {"detection.floor_sigma_m", p.detection.floor_sigma_m}});
}

}  // namespace

Status validate(const SearchParams& params) {
  if (const Status lengths = validate_lengths(params); !lengths) {
    return lengths;
  }
  if (const Status probabilities =
          all_probabilities({{"evidence.threshold", params.evidence.threshold},
                             {"evidence.max_probability", params.evidence.max_probability},
                             {"plan.cell_target_probability", params.plan.cell_target_probability},
                             {"detection.doubtful_unseen", params.detection.doubtful_unseen}});
      !probabilities) {
    return probabilities;
  }
  if (params.evidence.cell_m > kMaxSearchedCell_m) {
    return fail(Errc::kInvalidArgument,
                "evidence.cell_m must be at most 1 m");  // others would refuse what was searched
  }
  if (params.plan.max_failures < 1 || params.plan.waits.max_waits < 0 || params.plan.waits.max_for_nobody < 0) {
    return fail(Errc::kInvalidArgument, "plan.max_failures must be 1 or more, the numbers of plan.waits 0 or more");
  }
  if (params.paper.passes_limit < 0 || params.detection.confirm_places < 1) {
    return fail(Errc::kInvalidArgument,
                "paper.passes_limit must be 0 (from eq (1)) or more, detection.confirm_places 1 or more");
  }
  return validate(params.hit_rate);
}

}  // namespace seeker::search
