#include "server/search/local_planner.hpp"

#include <utility>

#include "common/core/assert.hpp"

namespace seeker::search {

LocalPlanner::LocalPlanner(std::shared_ptr<const ControlTable> table, nav::ForbiddenAreas areas,
                           const LocalPlannerParams& params)
    : table_(std::move(table)), areas_(std::move(areas)), params_(params) {
  SEEKER_ASSERT(table_ != nullptr);
}

Result<Sectors> LocalPlanner::sense(const SonarScan* sonar, const Pose2& map_T_base, RobotTime now) const {
  if (sonar == nullptr) {
    return fail(Errc::kNotReady, "no sonar ring is fitted, and the local planner sees by sonar; choose the mode plan");
  }
  if (to_seconds(now - sonar->stamp) > params_.silence_s) {
    return fail(Errc::kTimeout, "the sonars are silent; check their driver and cable");
  }
  auto sectors = fuse_sectors(*sonar);
  if (!sectors) {
    return sectors;
  }
  return with_virtual_walls(*sectors, areas_, map_T_base, params_.ring_radius_m);
}

Result<Twist2> LocalPlanner::drive(const Sectors& sectors, double target_rad) const {
  const HeadingResult heading = table_->look_up(sectors, target_rad);
  if (!heading) {
    return fail(Errc::kInvalidArgument,
                "the local planner has no heading: " + std::string(to_string(heading.error())) + "; check the sonars");
  }
  return drive_command(*heading, sectors[Sector::kFront], params_.drive);
}

}  // namespace seeker::search
