#include "server/app/maps/robot_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "server/app/estimators/estimator.hpp"

namespace seeker::app {
namespace {

tl::unexpected<Error> no_map() {
  return fail(Errc::kNotReady,
              "this robot's estimator keeps no map of segments; start it with --set estimator=line_slam");
}

/// The robot's surroundings first, since they count where a piece is as near: what it does there must go on.
MapMove move_of(const std::vector<slam::MapPiece>& before, const std::vector<slam::MapPiece>& after,
                const Pose2& old_map_T_base, const Pose2& map_T_base) {
  std::vector<MapMove::Piece> moved = {{old_map_T_base.translation(), map_T_base * inverse(old_map_T_base)}};
  for (const slam::MapPiece& old : before) {
    const auto now = std::find_if(after.begin(), after.end(), [&](const slam::MapPiece& p) { return p.id == old.id; });
    if (now != after.end()) {
      moved.push_back({old.map_T_piece * old.middle_piece, now->map_T_piece * inverse(old.map_T_piece)});
    }
  }
  return MapMove(std::move(moved));
}

}  // namespace

RobotMap::RobotMap(const RobotMapParams& params, const nav::OccupancyParams& occupancy, slam::MapTracker* tracker)
    : params_(params), occupancy_params_(occupancy), tracker_(tracker), occupancy_(occupancy) {}

PoseEstimate RobotMap::follow(const PoseEstimate& estimate, RobotTime now, const std::optional<Pose2>& old_map_T_base) {
  PoseEstimate out = estimate;
  out.map_epoch += epoch_offset_;
  const std::vector<slam::MapPiece> before =
      std::exchange(pieces_, tracker_ != nullptr ? tracker_->pieces() : std::vector<slam::MapPiece>{});
  if (out.map_epoch != epoch_) {
    epoch_ = out.map_epoch;
    last_move_ = old_map_T_base ? move_of(before, pieces_, *old_map_T_base, out.map_T_base) : MapMove{};
    const bool little =
        old_map_T_base && distance_m(*old_map_T_base, out.map_T_base) < params_.calm_move_m &&
        std::abs(wrap_angle(out.map_T_base.theta_rad - old_map_T_base->theta_rad)) < params_.calm_rotation_rad;
    if (!rendering()) {
      begin_rendering(little);
    } else {
      moved_again_ = true;
    }
  }
  const bool given_up = out.quality == LocalisationQuality::kLost;
  if (relocalising_since_ &&
      (is_placed(out.quality) || given_up || now - *relocalising_since_ > params_.relocalise_limit)) {
    relocalising_since_.reset();
  }
  return out;
}

Status RobotMap::integrate(const LaserScan& scan, const Pose2& map_T_base) {
  if (fresh_) {
    waiting_.push_back({scan, map_T_base});
  }
  return occupancy_.integrate(scan, map_T_base);
}

Status RobotMap::integrate(const SonarScan& scan, const Pose2& map_T_base) {
  return occupancy_.integrate(scan, map_T_base);
}

void RobotMap::begin_rendering(bool calm) {
  moved_again_ = false;
  rendered_epoch_ = epoch_;
  scans_per_tick_ = calm ? params_.calm_scans_per_tick : params_.render_scans_per_tick;
  waiting_.clear();
  fresh_.emplace(occupancy_params_);
  if (tracker_ != nullptr) {
    tracker_->for_each_scan([this](const LaserScan& scan, const Pose2& map_T_base) {
      waiting_.push_back({scan, map_T_base});
    });
  }
}

void RobotMap::step() {
  if (moved_again_ && !rendering()) {
    begin_rendering(false);
  }
  if (!rendering()) {
    return;
  }
  for (int k = 0; k < scans_per_tick_ && !waiting_.empty(); ++k) {
    // A full map keeps what lies inside: the live scans report it.
    static_cast<void>(fresh_->integrate(waiting_.front().scan, waiting_.front().map_T_base));
    waiting_.pop_front();
  }
  if (waiting_.empty()) {
    replace_occupancy(std::move(*fresh_), rendered_epoch_);
    fresh_.reset();
  }
}

void RobotMap::replace_occupancy(nav::OccupancyMap map, std::uint32_t epoch) {
  // Clients' revisions lie below the new map's, so that they get all of it.
  revision_base_ = revision() + 1;
  occupancy_ = std::move(map);
  occupancy_epoch_ = epoch;
}

api::TileUpdate RobotMap::tiles_since(std::uint64_t revision) const {
  api::TileUpdate update;
  update.revision = this->revision();
  update.map_epoch = occupancy_epoch_;
  update.tiles = occupancy_.tiles_since(revision > revision_base_ ? revision - revision_base_ : 0);
  for (OccupancyTile& tile : update.tiles) {
    tile.revision += revision_base_;
  }
  return update;
}

bool RobotMap::take_segments(RobotTime now) {
  if (tracker_ == nullptr || (segments_at_ && now - *segments_at_ < params_.segment_period)) {
    return false;
  }
  if (tracker_revision_ == tracker_->revision() && segments_epoch_ == epoch_) {
    return false;
  }
  tracker_revision_ = tracker_->revision();
  segments_epoch_ = epoch_;
  segments_at_ = now;
  return segments_.take(tracker_->segments(), epoch_);
}

Result<api::SegmentUpdate> RobotMap::segments_since(std::uint64_t revision) const {
  const bool none = tracker_ == nullptr && segments_.revision() == 0;
  return none ? Result<api::SegmentUpdate>(no_map()) : segments_.since(revision);
}

std::optional<api::LineMapStatus> RobotMap::status() const {
  if (tracker_ == nullptr) {
    return std::nullopt;
  }
  api::LineMapStatus status;
  status.name = identity_.name;
  status.use = identity_.use;
  status.segments = static_cast<std::uint32_t>(segments_.size());
  status.revision = segments_.revision();
  status.relocalising = relocalising();
  return status;
}

std::vector<MapSegment> RobotMap::segments() const {
  return tracker_ == nullptr ? std::vector<MapSegment>() : tracker_->segments();
}

Result<LineMap> RobotMap::map() const { return tracker_ == nullptr ? Result<LineMap>(no_map()) : tracker_->map(); }

Status RobotMap::load(const LineMap& map, const MapIdentity& identity, RobotTime now) {
  if (tracker_ == nullptr) {
    return no_map();
  }
  const slam::MapUse use = identity.use == api::MapUse::kLocalise ? slam::MapUse::kLocalise : slam::MapUse::kContinue;
  if (Status ok = tracker_->load(map, use); !ok) {
    return ok;
  }
  identity_ = identity;
  relocalising_since_ = now;
  take_new_frame(tracker_->estimate().map_epoch);
  return {};
}

void RobotMap::begin_new_map() {
  tracker_->reset({});
  forget_map();
  take_new_frame(tracker_->estimate().map_epoch);
}

void RobotMap::exchange_tracker(slam::MapTracker* tracker, std::uint32_t epoch) {
  tracker_ = tracker;
  forget_map();
  take_new_frame(epoch);
  segments_.take({}, epoch_);
}

void RobotMap::forget_map() {
  identity_ = {};
  pieces_.clear();
  relocalising_since_.reset();
}

/// A map of another place: nothing of the old one may be used, nor be taken for the new one by a client.
void RobotMap::take_new_frame(std::uint32_t estimator_epoch) {
  ++epoch_;
  epoch_offset_ = epoch_ - estimator_epoch;
  replace_occupancy(nav::OccupancyMap(occupancy_params_), epoch_);
  begin_rendering(false);
  tracker_revision_.reset();
  segments_at_.reset();
}

Status RobotMap::look_for_robot(const std::function<Status(slam::MapTracker&)>& look, RobotTime now) {
  if (tracker_ == nullptr) {
    return no_map();
  }
  Status ok = look(*tracker_);
  if (ok) {
    relocalising_since_ = now;
  }
  return ok;
}

Status RobotMap::relocalise(const std::optional<Pose2>& map_T_base, RobotTime now) {
  return look_for_robot([&](slam::MapTracker& tracker) { return tracker.relocalise(map_T_base); }, now);
}

Status RobotMap::look_where_it_stood(const Pose2& map_T_base, RobotTime now) {
  return look_for_robot([&](slam::MapTracker& tracker) { return tracker.look_where_it_stood(map_T_base); }, now);
}

}  // namespace seeker::app
