/// \file
/// Experiment R2: whether the errors of a tracker agree with its covariance. Simulated tours of a building are scored
/// by the normalised estimation error squared (NEES; Bar-Shalom, Li & Kirubarajan 2001, 5.4) of the robot.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/rng.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/sim/robot_model.hpp"
#include "server/sim/world.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::lab {

/// Makes the tracker of one run; its frame `map` is the robot's start. `model` is the robot that it estimates.
using MakeTracker = std::function<std::unique_ptr<slam::PoseTracker>(const sim::RobotModel& model)>;

/// Standard deviations of the systematic errors of the wheels.
struct UnevenWheels {
  double scale_sigma = 0.0;            ///< scale error common to both wheels, relative
  double drift_sigma_rad_per_m = 0.0;  ///< heading drift by different wheel sizes
  double base_sigma = 0.0;             ///< scale error of the distance between the wheels, relative
};

struct ConsistencyParams {
  std::vector<std::uint64_t> seeds;
  /// Places in the frame `world`, driven with the true pose, so that the path is the same in every run.
  std::vector<Point2> tour;
  double speed_m_s = 0.5;
  double rotation_rad_s = 0.8;
  double scan_period_s = 0.2;
  double instant_s = 10.0;  ///< time between two values of the NEES
  double time_limit_s = 600.0;
  double odometry_factor = 1.0;  ///< factor of the random errors of the odometry
  UnevenWheels wheels;           ///< drawn again for each run; no tracker is given them
};

/// One tracker at one instant of one run.
struct NeesSample {
  std::uint64_t seed = 0;
  double time_s = 0.0;
  double nees = 0.0;
  Pose2 error;  ///< estimate - truth in the frame `map`
  Pose2 sigma;  ///< standard deviations reported by the tracker
};

/// Mean over all runs at one instant.
struct NeesMean {
  double time_s = 0.0;
  double nees = 0.0;
  double error_m = 0.0;  ///< root mean square of the position error
  double sigma_m = 0.0;  ///< position error expected from the covariances
  int runs = 0;
};

struct NeesStudy {
  std::vector<NeesSample> samples;
  std::vector<NeesMean> means;
  double low = 0.0;  ///< lower limit of 95 % of the means of as many runs (chi-square, 3 dof for each run)
  double high = 0.0;
  int inside = 0;  ///< number of means in the band

  [[nodiscard]] double share_inside() const;
};

/// The 95 % band of the mean of `runs` values of chi-square with 3 degrees of freedom.
[[nodiscard]] std::pair<double, double> nees_band(int runs);

/// Drives all runs. Errors: those of the simulation, a tour that was not finished in time, an error of a tracker.
[[nodiscard]] Result<NeesStudy> study_consistency(const sim::World& world, const sim::RobotModel& model,
                                                  const MakeTracker& make_tracker, const ConsistencyParams& params);

/// The model with the robot's random errors only, without scale errors of the wheels.
[[nodiscard]] sim::RobotModel without_systematic_errors(sim::RobotModel model, double odometry_factor);

[[nodiscard]] sim::RobotModel with_uneven_wheels(sim::RobotModel model, const UnevenWheels& wheels, Rng& rng);

[[nodiscard]] Table nees_table(const NeesStudy& study);
/// Chart of the mean NEES over time with its band, one series for each study.
[[nodiscard]] Image nees_chart(const std::string& title, const std::vector<std::pair<std::string, NeesStudy>>& studies);
/// R2: at least nine of ten means in the band.
[[nodiscard]] Check nees_check(const std::string& name, const NeesStudy& study);

}  // namespace seeker::lab
