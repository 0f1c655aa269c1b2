/// \file
/// The SPmap alone as a pose tracker, for experiment R2: lines of each scan are added to one map that is never divided.
#pragma once

#include <memory>
#include <optional>

#include "server/lines/make_extractor.hpp"
#include "server/lines/observation.hpp"
#include "server/sim/robot_model.hpp"
#include "server/slam/pose_tracker.hpp"
#include "server/slam/sp_map.hpp"

namespace seeker::lab {

struct SpTrackerParams {
  lines::ExtractorParams lines;
  lines::ObservationParams observation;
  slam::SpMapParams map;
  sim::OdometryModel odometry;  ///< its random part is the noise model of the increments
  /// Standard deviation of the slip of every increment, along and lateral; keeps its covariance positive definite.
  double slip_sigma_m = 0.00002;
};

class SpTracker final : public slam::PoseTracker {
 public:
  explicit SpTracker(const SpTrackerParams& params);

  [[nodiscard]] Status predict(const Pose2& odom_T_base, RobotTime stamp) override;
  [[nodiscard]] Status update(const LaserScan& scan) override;
  [[nodiscard]] PoseEstimate estimate() const override;
  void reset(const Pose2& map_T_base) override;

  [[nodiscard]] const slam::SpMap& map() const { return map_; }
  [[nodiscard]] const slam::SpUpdateReport& report() const { return report_; }

 private:
  [[nodiscard]] Matrix3 increment_covariance(const Pose2& increment) const;

  SpTrackerParams params_;
  std::unique_ptr<lines::Extractor> extractor_;
  lines::ScanLines found_;
  slam::SpMap map_;
  slam::SpUpdateReport report_;
  std::optional<Pose2> last_odom_T_base_;
  RobotTime stamp_;
};

}  // namespace seeker::lab
