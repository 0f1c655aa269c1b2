/// \file
/// The database localiser: the pose from odometry and from landmarks that the stereo camera recognises (spec S2.8,
/// S2.9), beginning without a known pose.
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

/// Result of one frame.
struct LocaliserStep {
  LocalisationQuality quality = LocalisationQuality::kUnknown;
  std::string cause;        ///< why the quality is not kLocalised; empty otherwise
  double confidence = 0.0;  ///< 0 to 1: from inliers, their innovations and the pose's covariance
  int features = 0;
  int in_range = 0;                 ///< number of these within the range limits
  int matched = 0;                  ///< number of associations before the vote
  std::vector<FrameMatch> inliers;  ///< matches that agreed; they corrected the pose if `corrected`
  /// Landmarks that should be visible, matched or not; only while the pose is known.
  std::vector<LandmarkId> expected;
  double nis = 0.0;  ///< sum of squared innovations, 2 degrees of freedom per inlier
  bool corrected = false;
  bool relocalised = false;  ///< the pose was found by relocalisation with this frame
  UncertainPose last_T_eye;  ///< pose of the eye relative to the previous frame, by odometry alone
};

/// Not thread-safe. Time and random numbers are arguments; the database is only read.
class StereoLocaliser {
 public:
  /// Creates a localiser. Fails with kInvalidArgument for a database of another calibration (with the remedy) or
  /// parameters out of range, and with kNotReady for an empty database.
  [[nodiscard]] static Result<StereoLocaliser> create(const StereoGeometry& geometry,
                                                      std::shared_ptr<const LandmarkDatabase> database,
                                                      const LocaliserParams& params);
  StereoLocaliser(StereoLocaliser&&) noexcept;
  StereoLocaliser& operator=(StereoLocaliser&&) noexcept;
  ~StereoLocaliser();

  /// Replaces the database by another version of it, after an update; the pose is kept. Errors are those of create().
  [[nodiscard]] Status use(std::shared_ptr<const LandmarkDatabase> database);

  /// Starts with a known pose: LOCALISED until frames contradict it. Fails with kInvalidArgument when it is not finite
  /// or the covariance is invalid.
  [[nodiscard]] Status start_at(const Pose2& map_T_base, const Matrix3& covariance);
  /// Starts without a known pose: UNKNOWN until a pose is found and another frame confirms it.
  void start_anywhere();

  /// Motion of the base over `tau_s` seconds, by its encoders (spec S2.8).
  void predict(const Twist2& velocity, double tau_s);
  /// Processes one frame's features. `rng` is used only during relocalisation.
  const LocaliserStep& update(std::span<const vision::StereoFeature> features, Rng& rng);
  /// Processes a frame that cannot be used: the pose continues by odometry, with `cause` as the reason.
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
