#include "server/slam/line_slam.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::slam {
namespace {

/// chi-square of 3 dof at 99.9 %: a match farther from the prediction says that the odometry was wrong.
constexpr double kContradiction = 16.27;
/// ... and one that is farther than this, ten deviations, that the match itself may be the wrong one.
constexpr double kJump = 100.0;

/// The scan without the beams of lines that were paired: what they say has been used.
LaserScan without_paired_lines(LaserScan scan, const lines::ScanLines& found,
                               const std::vector<lines::SegmentObservation>& observations,
                               const Association& association) {
  std::vector<bool> paired(found.lines.size(), false);
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (association.matches[k].verdict == SpVerdict::kPaired) {
      paired[observations[k].line] = true;
    }
  }
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const std::int32_t line = found.line_of_beam[beam];
    if (line != lines::kNoLine && paired[static_cast<std::size_t>(line)]) {
      scan.ranges_m[beam] = kNoReturn;
    }
  }
  return scan;
}

MatchParams far_search(const PointNetParams& params) {
  MatchParams far = params.match;
  far.search_m = params.far_m;
  far.search_rad = params.far_rad;
  far.search_ratio = params.far_ratio;
  return far;
}

}  // namespace

struct LineSlam::Scan {
  const LaserScan& scan;
  lines::ScanLines found;
  std::vector<lines::SegmentObservation> observations;
  std::vector<OrientedPoint> all_points;  ///< in `base`
  std::vector<OrientedPoint> points;      ///< thinned
  Pose2 before;                           ///< node_T_base at the previous used scan
  Pose2 predicted;                        ///< node_T_base now, by odometry
  double wheels_rotation_rad = 0.0;       ///< rotation by the wheels since the previous used scan
  double dt_s = 0.0;                      ///< time since the previous used scan
  bool gap = false;                       ///< after a longer distance than a match bridges safely
  bool silent = false;                    ///< the wheels reported no motion
};

LineSlam::LineSlam(const LineSlamParams& params, const Pose2& map_T_base)
    : params_(params),
      extractor_(lines::make_extractor(params.extractor)),
      matcher_(params.points.match),
      far_matcher_(far_search(params.points)),
      odometry_scale_(params.odometry_scale),
      odometry_bias_(params.odometry_bias),
      unseen_(params.unseen),
      rotation_sense_(params.rotation_sense),
      jump_(params.points.jump),
      travelled_(params.odometry),
      cloud_(params.points.cloud),
      backend_(params.loops, params.known_ground),
      recogniser_(params.relocalise.place),
      claim_(params.relocalise.claim) {
  begin(map_T_base, RobotTime{});
}

void LineSlam::reset(const Pose2& map_T_base) {
  travelled_.reset({});
  begin(map_T_base, last_scan_.value_or(RobotTime{}));
}

void LineSlam::begin(const Pose2& map_T_base, RobotTime stamp) {
  backend_ = MapBackend(params_.loops, params_.known_ground);
  backend_.begin_first(map_T_base, stamp);
  start_local_map();
  cloud_.clear();
  odometry_bias_.forget_match();
  unseen_ = UnseenMotion(params_.unseen);
  rotation_sense_.clear();
  jump_.clear();
  travelled_.correct({}, Matrix3::Zero());
  at_last_scan_ = {};
  next_id_ = 1;
  forget_places();
  hint_map_T_node_.reset();
  kept_map_T_node_.reset();
  quality_ = LocalisationQuality::kUnknown;
  cause_ = "no odometry yet";
  failures_ = 0;
  repeats_ = 0;
  stood_ = 0;
  distance_since_loops_m_ = 0.0;
  distance_since_leftover_m_ = 0.0;
  rotation_since_leftover_rad_ = 0.0;
  ++revision_;
  counts_ = {};
}

void LineSlam::start_local_map() {
  lines_ = std::make_unique<SpMap>(Pose2{}, Matrix3::Zero(), params_.lines);
  distance_m_ = 0.0;
}

Status LineSlam::predict(const Pose2& odom_T_base, RobotTime stamp) {
  const Status taken = travelled_.predict(odom_T_base, stamp);
  const PoseEstimate& travelled = travelled_.estimate();
  const bool first = quality_ == LocalisationQuality::kUnknown && !backend_.apart();
  if (first || travelled.quality == LocalisationQuality::kDegraded) {
    quality_ = travelled.quality;
    cause_ = travelled.cause;
  }
  return taken;
}

std::optional<LocalBelief> LineSlam::local_belief() const {
  if (!last_scan_) {
    return std::nullopt;
  }
  return LocalBelief{lines_.get(), backend_.pose(backend_.maps().back().id)};
}

Status LineSlam::update(const LaserScan& scan) {
  if (Status valid = validate(scan); !valid) {
    return valid;
  }
  if (Status fresh = check_repeats(scan); !fresh) {
    return fresh;
  }
  if (Status mounted = check_direction(); !mounted) {
    return mounted;
  }
  ++counts_.scans;
  const PoseEstimate travelled = travelled_.estimate();
  const bool jumped = odometry_jumped();
  if (is_early(scan)) {
    return {};
  }
  if (stands_still(scan)) {
    ++counts_.still;
    look_again(scan);
    return {};
  }
  stood_ = 0;
  matched_ = false;
  used_ranges_ = scan.ranges_m;
  Scan step{.scan = scan,
            .found = {},
            .observations = {},
            .all_points = {},
            .points = {},
            .before = lines_->robot(),
            .predicted = {},
            .wheels_rotation_rad = travelled.map_T_base.theta_rad,
            .dt_s = to_seconds(scan.stamp - std::exchange(used_stamp_, scan.stamp))};
  step.silent = !jumped && unseen_.is_silent(travelled.map_T_base);
  const UncertainPose motion = expected_motion(travelled, step.silent, step.dt_s);
  lines_->predict(motion.a_T_b, motion.covariance);
  step.predicted = lines_->robot();
  note_distance(motion.a_T_b);
  const double sigma_m = std::sqrt(motion.covariance.topLeftCorner<2, 2>().maxCoeff());
  step.gap = jumped || moved({}, motion.a_T_b, params_.points.gap_m, params_.points.gap_rad) ||
             (step.silent && sigma_m > params_.points.gap_m);
  extractor_->extract(scan, step.found);
  noise_ = step.found.noise;
  step.all_points = oriented_points(scan, params_.points.normals, noise_);
  Status outcome;
  if (uses_points() && step.all_points.size() < static_cast<std::size_t>(params_.points.match.min_pairs)) {
    quality_ = LocalisationQuality::kDegraded;
    cause_ = "too few returns: the pose goes on by odometry";
    outcome = fail(Errc::kNotReady, "the scan has too few returns on surfaces to say where the robot is");
  } else {
    step.points = thin_out(step.all_points, params_.points.match_points);
    step.observations = lines::observe(scan, step.found, params_.observation);
    counts_.lines += step.observations.size();
    follow(step);
  }
  recover_place();
  return outcome;
}

void LineSlam::recover_place() {
  if (backend_.apart()) {
    look_for_robot();
  } else if (failures_ >= params_.relocalise.lost_scans) {
    // The odometry says about where it is: of places that look alike it is the one there, if any of them is.
    (void)look_where_it_stood(estimate().map_T_base);
  } else if (backend_.loops().contradictions >= params_.relocalise.contradictions) {
    (void)relocalise(std::nullopt);
  }
}

void LineSlam::follow(Scan& scan) {
  if (!uses_points()) {
    follow_lines(scan.observations, scan.scan);
    keep(scan, 0.0);
    return;
  }
  if (cloud_.empty()) {
    update_lines(scan.observations, lines_->associate(scan.observations));
    quality_ = LocalisationQuality::kLocalised;
    cause_.clear();
    keep(scan, 0.0);
    return;
  }
  const MatchResult match = match_points(scan);
  if (!believable(scan, match)) {
    ++counts_.unbelieved;
    odometry_bias_.forget_match();
    note_failure(scan);
    return;
  }
  if (!scan.silent && !scan.gap) {
    rotation_sense_.note(scan.wheels_rotation_rad, wrap_angle(match.map_T_base.theta_rad - scan.before.theta_rad));
  }
  correct(scan, match);
  matched_ = true;
  failures_ = 0;
  note_quality(match);
  keep(scan, match.inlier_ratio);
  if (distance_since_loops_m_ >= params_.loops.every_m) {
    distance_since_loops_m_ = 0.0;
    backend_.plan_loops(lines_->robot());
  }
  if (backend_.step_loops()) {
    ++revision_;
  }
}

MatchResult LineSlam::match_points(Scan& scan) {
  const ReferenceCloud& reference = cloud_.around(scan.predicted);
  MatchResult match = matcher_.match(reference, scan.points, scan.predicted);
  if (!scan.gap && match.inlier_ratio >= params_.points.good_ratio) {
    return matcher_.weighed(reference, scan.points, scan.predicted, std::move(match));
  }
  // After a gap even a fair match may be a wrong one, and a poor one may only have begun in the wrong place.
  ++counts_.searched;
  Matrix3 covariance = lines_->robot_covariance_map();
  if (scan.silent && !unseen_.on()) {
    covariance += unseen_.expected(scan.dt_s).covariance;
  }
  match = matcher_.match_widely(reference, scan.points, scan.predicted, covariance, std::move(match));
  if (scan.gap && match.inlier_ratio < params_.points.good_ratio) {
    match = far_matcher_.match_widely(reference, scan.points, scan.predicted, covariance, std::move(match));
  }
  return match;
}

bool LineSlam::believable(const Scan& scan, const MatchResult& match) {
  // What the odometry did not expect asks for more than a corner that happens to fit.
  const Matrix3 covariance = with_floor(match.covariance, params_.points.map_sigma_m, params_.points.map_sigma_rad);
  const double surprise = lines_->pose_d2(match.map_T_base, covariance, match.degenerate_direction);
  // So does a robot that did not know its place before: one more wrong scan in the map keeps it there.
  const bool careful = surprise > kContradiction || failures_ > 0;
  const bool far =
      moved(scan.predicted, match.map_T_base, params_.points.max_correction_m, params_.points.max_correction_rad);
  const double ratio = far       ? params_.points.sure_ratio
                       : careful ? params_.points.good_ratio
                                 : params_.points.accept_ratio;
  const bool fits = match.pairs >= params_.points.match.min_pairs && match.inlier_ratio >= ratio;
  // After a gap wheels may have slipped by any distance; within a few centimetres they have not. Silent wheels do not
  // contradict any possible motion.
  const bool impossible = unseen_.is_too_fast(inverse(scan.before) * match.map_T_base, scan.dt_s);
  const bool jumps = !scan.gap && (scan.silent ? impossible : far || surprise > kJump);
  if (!fits || !jumps) {
    jump_.clear();
    return fits;
  }
  return jump_.confirms(match.map_T_base, scan.predicted);
}

void LineSlam::use_points(const Scan& scan, const MatchResult& match) {
  const Matrix3 covariance = with_floor(match.covariance, params_.points.map_sigma_m, params_.points.map_sigma_rad);
  if (lines_->pose_d2(match.map_T_base, covariance, match.degenerate_direction) > kContradiction) {
    // The wheels slipped more than their noise model admits: the prediction is widened by its offset from the match.
    const Pose2 off = inverse(scan.predicted) * match.map_T_base;
    lines_->predict({}, Eigen::Vector3d(off.x_m * off.x_m + off.y_m * off.y_m, off.x_m * off.x_m + off.y_m * off.y_m,
                                        off.theta_rad * off.theta_rad)
                            .asDiagonal());
  }
  lines_->observe_pose(match.map_T_base, covariance, match.degenerate_direction);
}

void LineSlam::use_leftover(const Scan& scan, const Association& association) {
  const LaserScan rest = without_paired_lines(scan.scan, scan.found, scan.observations, association);
  const std::vector<OrientedPoint> points =
      thin_out(oriented_points(rest, params_.points.normals, noise_), params_.points.match_points);
  const MatchResult match = matcher_.match(cloud_.around(lines_->robot()), points, lines_->robot());
  const Matrix3 covariance = with_floor(match.covariance, params_.points.map_sigma_m, params_.points.map_sigma_rad);
  if (match.pairs >= params_.points.match.min_pairs &&
      lines_->pose_d2(match.map_T_base, covariance, match.degenerate_direction) < kContradiction) {
    lines_->observe_pose(match.map_T_base, covariance, match.degenerate_direction);
  }
}

void LineSlam::correct(Scan& scan, const MatchResult& match) {
  const Matrix3 covariance = with_floor(match.covariance, params_.points.map_sigma_m, params_.points.map_sigma_rad);
  const bool contradicted = lines_->pose_d2(match.map_T_base, covariance, match.degenerate_direction) > kContradiction;
  const bool unseen = scan.silent && (unseen_.on() || contradicted);
  if (unseen) {
    odometry_bias_.forget_match();
  } else {
    learn_odometry(match, covariance);
  }
  const bool far = moved(scan.predicted, match.map_T_base, params_.points.first_m, params_.points.first_rad);
  // Lines that begin the next local map hold no information about the odometry's error up to this scan.
  const bool full = map_is_full();
  const bool joins = full && params_.points.use == PointUse::kLeftover;
  const bool points_first = params_.points.use == PointUse::kAll || scan.gap || contradicted || unseen || far || joins;
  if (points_first) {
    use_points(scan, match);
  }
  if (full) {
    scan.before = inverse(lines_->robot()) * scan.before;
    begin_next_map(scan.scan.stamp, params_.points.carried_keyframes);
  }
  const Association association = lines_->associate(scan.observations);
  const SpUpdateReport report = update_lines(scan.observations, association);
  counts_.paired += static_cast<std::uint64_t>(report.paired);
  const bool farther = distance_since_leftover_m_ >= params_.points.leftover_m ||
                       rotation_since_leftover_rad_ >= params_.points.leftover_rad;
  if (!points_first && farther && params_.points.use == PointUse::kLeftover) {
    distance_since_leftover_m_ = 0.0;
    rotation_since_leftover_rad_ = 0.0;
    use_leftover(scan, association);
  }
  if (unseen) {
    unseen_.note(inverse(scan.before) * lines_->robot(), scan.dt_s);
  }
  lines_->observe_free_space(scan.scan);
}

void LineSlam::note_failure(const Scan& scan) {
  const Pose2 pose = lines_->robot();
  const ReferenceCloud& reference = cloud_.around(pose);
  const auto known = std::count_if(scan.points.begin(), scan.points.end(), [&](const OrientedPoint& point) {
    return reference.nearest(pose * point.p, params_.points.match.first_gate_m) != nullptr;
  });
  const bool elsewhere =
      static_cast<double>(known) < params_.points.new_space_ratio * static_cast<double>(scan.points.size());
  if (elsewhere || seen_through(reference, scan.scan, pose, params_.points.through) < params_.points.denied_ratio) {
    if (failures_ > 0) {
      // Where the robot went meanwhile is known badly: a map of its own, which a loop can move, takes what it sees now.
      begin_next_map(scan.scan.stamp, 0);
    }
    failures_ = 0;
    quality_ = LocalisationQuality::kDegraded;
    cause_ = "unseen space: the pose goes on by odometry";
    update_lines(scan.observations, lines_->associate(scan.observations));
    keep(scan, 0.0);
    return;
  }
  ++failures_;
  const bool lost = failures_ >= params_.lost_after;
  quality_ = lost ? LocalisationQuality::kLost : LocalisationQuality::kDegraded;
  cause_ = lost ? std::to_string(failures_) + " scans in a row do not fit the map" : "the scan does not fit the map";
}

void LineSlam::keep(const Scan& scan, double known) {
  const Pose2& pose = lines_->robot();
  if (cloud_.needs_keyframe(pose, known)) {
    cloud_.add(pose, scan.all_points);
  }
  std::vector<MapKeyframe>& kept = backend_.newest().keyframes;
  const bool fresh = std::none_of(kept.begin(), kept.end(), [&](const MapKeyframe& keyframe) {
    return !moved(keyframe.node_T_base, pose, params_.local.keyframe_distance_m, params_.local.keyframe_rotation_rad);
  });
  if (fresh) {
    kept.push_back(pack_keyframe(scan.scan, backend_.newest().id, pose));
  }
}

}  // namespace seeker::slam
