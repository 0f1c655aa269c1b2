// The map of line SLAM as a whole: its local maps one after the other; handed out, loaded, searched for the robot.
#include <algorithm>
#include <numbers>
#include <utility>

#include "server/slam/covariance.hpp"
#include "server/slam/line_slam.hpp"
#include "server/slam/segment_fusion.hpp"

namespace seeker::slam {
namespace {

constexpr const char* kLooking = "looking for the robot in the map";

MapSegment to_value(const SpMap& map, const SpSegment& segment, std::uint32_t node, std::uint64_t id_base,
                    RobotTime now) {
  MapSegment value;
  value.id = id_base + segment.id;
  value.node = node;
  value.map_T_segment = segment.map_T_segment;
  value.length_m = segment.length_m;
  value.left_real = segment.real[lines::kLeft];
  value.right_real = segment.real[lines::kRight];
  value.covariance = map.segment_covariance(segment.id).topLeftCorner<2, 2>();
  value.hits = static_cast<std::uint32_t>(segment.hits);
  value.created = now;
  value.last_seen = now;
  return value;
}

}  // namespace

void LineSlam::store_local_map() {
  LocalMap& newest = backend_.newest();
  newest.segments_node.clear();
  std::uint64_t last_id = 0;
  for (const SpSegment& segment : lines_->segments()) {
    newest.segments_node.push_back(to_value(*lines_, segment, newest.id, next_id_, last_scan_.value_or(RobotTime{})));
    last_id = std::max(last_id, segment.id);
  }
  next_id_ += last_id;
}

bool LineSlam::map_is_full() const {
  return distance_m_ >= params_.local.max_distance_m || lines_->segments().size() >= params_.local.max_segments;
}

// Its frame is the robot where its first scan is taken, not where the last one of the present map was: what the robot
// may be off by along the path between the two belongs to the joint. A local map that begins with an uncertain heading
// learns of it what no wall says, because the Jacobians of one wall are taken at ever other estimates: after 10 m a
// tenth to a seventh of its variance (Julier & Uhlmann 2001; Huang, Mourikis & Roumeliotis 2010).
void LineSlam::begin_next_map(RobotTime stamp, std::size_t carried) {
  store_local_map();
  const Pose2 last_T_new = lines_->robot();
  const Matrix3 covariance =
      with_floor(lines_->robot_covariance_map(), params_.local.joint_sigma_m, params_.local.joint_sigma_rad);
  backend_.begin_next(last_T_new, covariance, stamp);
  start_local_map();
  cloud_.move_to(inverse(last_T_new), {}, carried);
  odometry_bias_.change_frame(inverse(last_T_new));
  jump_.clear();
  last_try_ = inverse(last_T_new) * last_try_;
  claim_.change_node(last_T_new);
  for (std::optional<Pose2>* map_T_node : {&kept_map_T_node_, &hint_map_T_node_}) {
    if (*map_T_node) {
      *map_T_node = **map_T_node * last_T_new;
    }
  }
}

std::vector<MapSegment> LineSlam::segments() const {
  std::vector<MapSegment> all = backend_.segments(backend_.map_end());
  append_newest(all);
  return fuse(std::move(all), params_.fusion);
}

void LineSlam::append_newest(std::vector<MapSegment>& all) const {
  const std::uint32_t newest = backend_.maps().back().id;
  if (newest >= backend_.map_end()) {
    return;
  }
  const Pose2& map_T_node = backend_.pose(newest);
  for (const SpSegment& segment : lines_->segments()) {
    MapSegment value = to_value(*lines_, segment, newest, next_id_, last_scan_.value_or(RobotTime{}));
    value.map_T_segment = map_T_node * value.map_T_segment;
    all.push_back(value);
  }
}

LineMap LineSlam::map() const {
  LineMap whole = backend_.assemble(backend_.map_end());
  append_newest(whole.segments);
  whole.next_id = std::max(whole.next_id, next_id_);
  for (const MapSegment& segment : whole.segments) {
    whole.next_id = std::max(whole.next_id, segment.id + 1);
  }
  return whole;
}

Status LineSlam::load(const LineMap& map, MapUse use) {
  if (Status valid = validate(map); !valid) {
    return valid;
  }
  if (map.nodes.empty() || map.keyframes.empty()) {
    return fail(Errc::kInvalidArgument, "the map holds no scans, so that nothing can be found in it; save it again");
  }
  begin({}, last_scan_.value_or(RobotTime{}));
  backend_.load(map, use);
  next_id_ = map.next_id;
  // Before relocalise(), which would take the loaded map's last part for the one that lines_ is about.
  backend_.begin_apart(last_scan_.value_or(RobotTime{}));
  return relocalise(std::nullopt);
}

Status LineSlam::relocalise(const std::optional<Pose2>& map_T_base) {
  if (map_T_base && !is_finite(*map_T_base)) {
    return fail(Errc::kInvalidArgument, "the place to look at is not a number");
  }
  if (!backend_.apart()) {
    if (backend_.maps().front().keyframes.empty()) {
      return fail(Errc::kNotReady, "there is no map yet to look for the robot in; drive a little or load one");
    }
    store_local_map();
    backend_.begin_apart(last_scan_.value_or(RobotTime{}));
    start_local_map();
    cloud_.clear();
    odometry_bias_.forget_match();
    jump_.clear();
    failures_ = 0;
  }
  // What is driven from now on is known.
  hint_map_T_node_ = map_T_base ? std::optional(*map_T_base * inverse(lines_->robot())) : std::nullopt;
  kept_map_T_node_.reset();
  claim_.clear();
  forget_places();
  tries_ = 0;
  scans_since_try_ = params_.relocalise.every_scans;  // the next scan is a try
  quality_ = LocalisationQuality::kUnknown;
  search_cause_ = kLooking;
  cause_ = search_cause_;
  ++revision_;
  return {};
}

Status LineSlam::look_where_it_stood(const Pose2& map_T_base) {
  if (!is_finite(map_T_base)) {
    return fail(Errc::kInvalidArgument, "the place to look at is not a number");
  }
  if (Status looking = relocalise(std::nullopt); !looking) {
    return looking;
  }
  // Motion from now on is measured: the robot may roll out, or rotate on the spot.
  kept_map_T_node_ = map_T_base * inverse(lines_->robot());
  distance_since_kept_m_ = 0.0;
  return {};
}

void LineSlam::look_for_robot() {
  // What follow() thinks of the pose is about the local map alone.
  const bool lost = tries_ >= params_.relocalise.max_tries;
  quality_ = lost ? LocalisationQuality::kLost : LocalisationQuality::kUnknown;
  cause_ = search_cause_;
  const bool fresh = ++scans_since_try_ >= params_.relocalise.every_scans ||
                     moved(last_try_, lines_->robot(), params_.relocalise.every_m, params_.relocalise.every_rad);
  if (!fresh || backend_.newest().keyframes.empty()) {
    return;
  }
  scans_since_try_ = 0;
  last_try_ = lines_->robot();
  ++tries_;
  const Result<PlaceAnswer> answer = find_place(seen_lately());
  if (!answer) {
    search_cause_ = "the map cannot be searched everywhere, so name the robot's place: " + answer.error().message;
    return;
  }
  settle(*answer);
}

void LineSlam::forget_places() {
  whole_place_.reset();
  near_place_.reset();
}

const Result<PlaceMap>& LineSlam::whole_place() {
  if (!whole_place_) {
    whole_place_ = std::make_unique<Result<PlaceMap>>(PlaceMap::build(backend_.seen(), params_.relocalise.map));
  }
  return *whole_place_;
}

const Result<PlaceMap>& LineSlam::place_about(const Pose2& map_T_base) {
  if (whole_place_ && *whole_place_ && !(*whole_place_)->coarse()) {
    near_place_.reset();
    return *whole_place_;
  }
  constexpr double kDriven_m = 4.0;  // farther on, other scans show the surroundings
  if (!near_place_ || distance_m(near_place_at_, map_T_base) > kDriven_m) {
    // Whatever the robot sees from wherever it may be by then, and those who saw that from the other side.
    const double window_m =
        std::numbers::sqrt2 * std::max(params_.relocalise.hint_m, params_.relocalise.place.kept.about_m);
    const double range_m = kDriven_m + window_m + 2.0 * params_.loops.view_range_m;
    near_place_ = std::make_unique<Result<PlaceMap>>(
        PlaceMap::build(backend_.seen_about(map_T_base.translation(), range_m), params_.relocalise.map));
    near_place_at_ = map_T_base;
  }
  return *near_place_;
}

std::vector<SeenPoints> LineSlam::seen_lately() const {
  const Pose2 base_T_node = inverse(lines_->robot());
  std::vector<SeenPoints> seen;
  const std::vector<LocalMap>& maps = backend_.maps();
  const Pose2 newest_T_map = inverse(backend_.pose(maps.back().id));
  for (std::size_t k = maps.size(); k-- > 0 && backend_.is_apart(maps[k].id);) {
    const Pose2 base_T_other = base_T_node * (newest_T_map * backend_.pose(maps[k].id));
    const std::vector<MapKeyframe>& keyframes = maps[k].keyframes;
    for (std::size_t i = keyframes.size(); i-- > 0 && seen.size() < params_.relocalise.query_keyframes;) {
      seen.push_back(
          transform(base_T_other * keyframes[i].node_T_base, view_of(keyframes[i], params_.loops.view_range_m)));
    }
  }
  return seen;
}

Result<PlaceAnswer> LineSlam::find_place(const std::vector<SeenPoints>& seen) {
  const RelocaliseParams& params = params_.relocalise;
  if (kept_map_T_node_ && distance_since_kept_m_ <= params.place.kept.about_m) {
    const Pose2 stood = *kept_map_T_node_ * lines_->robot();
    if (const Result<PlaceMap>& about = place_about(stood)) {
      PlaceAnswer there = recogniser_.confirm(*about, seen, stood);
      if (there.verdict == PlaceVerdict::kUnique) {
        return there;
      }
    }
  } else if (hint_map_T_node_ && tries_ <= params.hint_tries) {
    const Pose2 hint = *hint_map_T_node_ * lines_->robot();
    const Result<PlaceMap>& about = place_about(hint);
    if (!about) {
      PlaceAnswer none;
      none.reason = "the map shows nothing about the place that was named";
      return none;
    }
    // Whoever names a place is taken at their word where scans agree, although they may fit elsewhere, too.
    PlaceAnswer there = recogniser_.confirm(*about, seen, hint);
    return there.verdict == PlaceVerdict::kUnique
               ? there
               : recogniser_.locate(*about, seen, SearchWindow{hint, params.hint_m, params.hint_rad});
  }
  const Result<PlaceMap>& whole = whole_place();
  if (!whole) {
    return tl::unexpected<Error>(whole.error());
  }
  return recogniser_.locate(*whole, seen);
}

void LineSlam::settle(const PlaceAnswer& answer) {
  const Pose2 base_T_node = inverse(lines_->robot());
  if (claim_.take(answer, lines_->robot())) {
    const MatchResult& match = answer.candidates.front().match;
    const Matrix3 to_a = compose_jacobian_a(match.map_T_base, base_T_node);
    backend_.anchor(match.map_T_base * base_T_node,
                    with_floor(to_a * match.covariance * to_a.transpose(), params_.relocalise.joint_sigma_m,
                               params_.relocalise.joint_sigma_rad));
    forget_places();
    kept_map_T_node_.reset();
    quality_ = LocalisationQuality::kLocalised;
    cause_.clear();
    ++revision_;
    return;
  }
  const bool lost = tries_ >= params_.relocalise.max_tries;
  const std::string why = answer.verdict == PlaceVerdict::kUnique ? "a place fits; further answers have to confirm it"
                                                                  : std::string(answer.reason);
  search_cause_ = (lost ? "the robot was not found in the map: " : kLooking + std::string(": ")) + why;
  quality_ = lost ? LocalisationQuality::kLost : LocalisationQuality::kUnknown;
  cause_ = search_cause_;
}

void LineSlam::for_each_scan(const std::function<void(const LaserScan&, const Pose2&)>& visit) const {
  for (const LocalMap& map : backend_.maps()) {
    if (map.id >= backend_.map_end()) {
      break;
    }
    for (const MapKeyframe& keyframe : map.keyframes) {
      visit(unpack_scan(keyframe), backend_.pose(map.id) * keyframe.node_T_base);
    }
  }
}

}  // namespace seeker::slam
