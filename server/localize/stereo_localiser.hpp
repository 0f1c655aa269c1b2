/// \file
/// The database localiser: where the robot is, from odometry and from what its stereo camera knows again (spec S2.8,
/// S2.9), from the moment it is switched on.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/core/pose_estimate.hpp"
#include "common/core/result.hpp"
#include "common/core/rng.hpp"
#include "server/localize/localiser_params.hpp"

namespace seeker::localize {

/// A feature of the newest frame that corrected the pose.
struct FrameMatch {
  std::size_t feature = 0;  ///< its index in the frame
  LandmarkId landmark = 0;

  friend bool operator==(const FrameMatch&, const FrameMatch&) = default;
};

/// What one frame did.
struct LocaliserStep {
  LocalisationQuality quality = LocalisationQuality::kUnknown;
  std::string cause;        ///< why the quality is not kLocalised; empty otherwise
  double confidence = 0.0;  ///< 0 .. 1: from inliers, their innovations and the pose's covariance
  int features = 0;
  int in_range = 0;                  ///< of these, near and far enough to be used
  int matched = 0;                   ///< taken for a landmark before they were asked whether they agree
  std::vector<FrameMatch> inliers;   ///< that agreed; they corrected the pose if `corrected`
  std::vector<LandmarkId> expected;  ///< landmarks that should show, matched or not; only while the pose is known
  double nis = 0.0;                  ///< sum of squared innovations, 2 degrees of freedom an inlier
  bool corrected = false;
  bool relocalised = false;  ///< the pose was found anew with this frame
  UncertainPose last_T_eye;  ///< the eye seen from where it was at the frame before, by odometry alone
};

/// Not for two threads at once. Time and chance are arguments; the database is only read.
class StereoLocaliser {
 public:
  /// kInvalidArgument: a database of another calibration (with the remedy), parameters out of range; kNotReady: an
  /// empty database.
  [[nodiscard]] static Result<StereoLocaliser> create(const StereoGeometry& geometry,
                                                      std::shared_ptr<const LandmarkDatabase> database,
                                                      const LocaliserParams& params);
  StereoLocaliser(StereoLocaliser&&) noexcept;
  StereoLocaliser& operator=(StereoLocaliser&&) noexcept;
  ~StereoLocaliser();

  /// Another version of the same database, after an update: the pose stays. Errors of create().
  [[nodiscard]] Status use(std::shared_ptr<const LandmarkDatabase> database);

  /// The pose is known: LOCALISED until frames say otherwise. kInvalidArgument: not finite, or no covariance.
  [[nodiscard]] Status start_at(const Pose2& map_T_base, const Matrix3& covariance);
  /// The pose is not known: UNKNOWN until a place is found and another frame confirms it.
  void start_anywhere();

  /// Motion of the base over `tau_s` seconds, by its encoders (spec S2.8).
  void predict(const Twist2& velocity, double tau_s);
  /// One frame's features. `rng` is only drawn from while the place is looked for.
  const LocaliserStep& update(std::span<const vision::StereoFeature> features, Rng& rng);
  /// A frame that cannot be used: the pose coasts, and says so with `cause`.
  const LocaliserStep& miss(const std::string& cause);

  [[nodiscard]] const LocaliserStep& last() const;
  /// Pose and covariance of the base as predicted and corrected so far. While UNKNOWN the pose is the origin, and the
  /// covariance is as large as a building.
  [[nodiscard]] PoseEstimate estimate(RobotTime stamp) const;
  [[nodiscard]] const EyeBelief& belief() const;
  [[nodiscard]] const LocaliserParams& params() const;

 private:
  struct State;
  explicit StereoLocaliser(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace seeker::localize
