/// \file
/// Experiment R2: are a tracker's errors as large as it says? Simulated tours of a building, scored by the normalised
/// estimation error squared (NEES; Bar-Shalom, Li & Kirubarajan 2001, 5.4) of the robot.
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

/// Makes the tracker of one run; its frame `map` is the robot's start. `model` is the robot it rides on.
using MakeTracker = std::function<std::unique_ptr<slam::PoseTracker>(const sim::RobotModel& model)>;

/// Standard deviations of what wheels are off by all the time.
struct UnevenWheels {
  double way_sigma = 0.0;             ///< both alike, of their sizes
  double bend_sigma_rad_per_m = 0.0;  ///< one larger than the other
  double base_sigma = 0.0;            ///< of the distance between them
};

struct ConsistencyParams {
  std::vector<std::uint64_t> seeds;
  std::vector<Point2> tour;  ///< in the frame `world`, driven by the true pose: the same way in every run
  double speed_m_s = 0.5;
  double turn_rad_s = 0.8;
  double scan_period_s = 0.2;
  double instant_s = 10.0;  ///< NEES is taken this far apart
  double time_limit_s = 600.0;
  double odometry_factor = 1.0;  ///< on the random errors of the odometry
  UnevenWheels wheels;           ///< other ones in each run; no tracker is told
};

/// One tracker at one instant of one run.
struct NeesSample {
  std::uint64_t seed = 0;
  double time_s = 0.0;
  double nees = 0.0;
  Pose2 error;  ///< estimate - truth in the frame `map`
  Pose2 sigma;  ///< what the tracker says of it
};

/// Mean over all runs at one instant.
struct NeesMean {
  double time_s = 0.0;
  double nees = 0.0;
  double error_m = 0.0;  ///< root mean square of the position's error
  double sigma_m = 0.0;  ///< what it should be
  int runs = 0;
};

struct NeesStudy {
  std::vector<NeesSample> samples;
  std::vector<NeesMean> means;
  double low = 0.0;  ///< 95 % of the means of as many runs lie between them (chi-square, 3 dof a run)
  double high = 0.0;
  int inside = 0;  ///< means in the band

  [[nodiscard]] double share_inside() const;
};

/// Band of 95 % of the mean of `runs` values of chi-square with 3 degrees of freedom.
[[nodiscard]] std::pair<double, double> nees_band(int runs);

/// Drives all runs. Errors: those of the simulation, a tour that was not finished in time, a tracker's refusal.
[[nodiscard]] Result<NeesStudy> study_consistency(const sim::World& world, const sim::RobotModel& model,
                                                  const MakeTracker& make_tracker, const ConsistencyParams& params);

/// The robot's random errors only: no wheel is larger than it says.
[[nodiscard]] sim::RobotModel without_systematic_errors(sim::RobotModel model, double odometry_factor);

[[nodiscard]] sim::RobotModel with_uneven_wheels(sim::RobotModel model, const UnevenWheels& wheels, Rng& rng);

[[nodiscard]] Table nees_table(const NeesStudy& study);
/// Mean NEES over time with its band, a series per study.
[[nodiscard]] Image nees_chart(const std::string& title, const std::vector<std::pair<std::string, NeesStudy>>& studies);
/// R2: at least nine of ten means in the band.
[[nodiscard]] Check nees_check(const std::string& name, const NeesStudy& study);

}  // namespace seeker::lab
