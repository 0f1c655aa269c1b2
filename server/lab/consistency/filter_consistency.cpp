#include "server/lab/consistency/filter_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/image/plot.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::lab {
namespace {

constexpr double kShareWanted = 0.9;
constexpr double kReached_m = 0.2;
constexpr double kRotationGain = 2.0;     ///< 1/s
constexpr double kRotateFirst_rad = 0.5;  ///< a goal farther off to the side: rotate on the spot
constexpr int kTicksPerSecond = 20;

/// Drives to one place after the other by the true pose.
class Tour {
 public:
  explicit Tour(const ConsistencyParams& params) : params_(&params) {}

  [[nodiscard]] bool done() const { return next_ == params_->tour.size(); }
  Twist2 command(const Pose2& world_T_base) {
    while (!done() && (params_->tour[next_] - world_T_base.translation()).norm() < kReached_m) {
      ++next_;
    }
    if (done()) {
      return {};
    }
    const double bearing_rad = bearing_to(world_T_base, params_->tour[next_]);
    const double rotation = std::clamp(kRotationGain * bearing_rad, -params_->rotation_rad_s, params_->rotation_rad_s);
    return {std::abs(bearing_rad) > kRotateFirst_rad ? 0.0 : params_->speed_m_s, rotation};
  }

 private:
  const ConsistencyParams* params_;
  std::size_t next_ = 0;
};

NeesSample score(const PoseEstimate& estimate, const sim::GroundTruth& truth, std::uint64_t seed, double time_s) {
  const Pose2 map_T_base = inverse(truth.world_T_start) * truth.world_T_base;
  const Pose2& believed = estimate.map_T_base;
  NeesSample sample;
  sample.seed = seed;
  sample.time_s = time_s;
  sample.error = {believed.x_m - map_T_base.x_m, believed.y_m - map_T_base.y_m,
                  wrap_angle(believed.theta_rad - map_T_base.theta_rad)};
  const Eigen::Vector3d error(sample.error.x_m, sample.error.y_m, sample.error.theta_rad);
  sample.nees = error.dot(estimate.covariance.inverse() * error);
  const Eigen::Vector3d sigma = estimate.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  sample.sigma = {sigma(0), sigma(1), sigma(2)};
  return sample;
}

Status run_tour(const sim::World& world, const sim::RobotModel& model, slam::PoseTracker& tracker,
                const ConsistencyParams& params, std::uint64_t seed, std::vector<NeesSample>& samples) {
  Result<sim::Simulation> simulation = sim::Simulation::create(world, model, seed);
  if (!simulation) {
    return tl::unexpected<Error>(simulation.error());
  }
  const Duration tick = seconds(1.0 / kTicksPerSecond);
  const auto scan_ticks = static_cast<int>(std::lround(params.scan_period_s * kTicksPerSecond));
  const auto instant_ticks = static_cast<int>(std::lround(params.instant_s * kTicksPerSecond));
  Tour tour(params);
  for (int k = 0; !tour.done(); ++k) {
    const double time_s = static_cast<double>(k) / kTicksPerSecond;
    if (time_s > params.time_limit_s) {
      return fail(Errc::kTimeout,
                  "the tour of R2 did not end in " + fixed(params.time_limit_s, 0) +
                      " s, the robot is stuck at x = " + fixed(simulation->truth().world_T_base.x_m, 2) +
                      ", y = " + fixed(simulation->truth().world_T_base.y_m, 2) + ": put its places where it can go");
    }
    const RobotTime now = simulation->now();
    if (Status ok = tracker.predict(simulation->odometry().odom_T_base, now); !ok) {
      return ok;
    }
    if (k % scan_ticks == 0) {
      if (Status ok = tracker.update(simulation->scan()); !ok) {
        return ok;
      }
    }
    if (k > 0 && k % instant_ticks == 0) {
      samples.push_back(score(tracker.estimate(), simulation->truth(), seed, time_s));
    }
    simulation->command(tour.command(simulation->truth().world_T_base));
    simulation->advance(tick);
  }
  return {};
}

void summarise(NeesStudy& study, int runs) {
  std::map<long, NeesMean> means;
  for (const NeesSample& sample : study.samples) {
    NeesMean& mean = means[std::lround(sample.time_s * 1000.0)];
    mean.time_s = sample.time_s;
    mean.nees += sample.nees;
    mean.error_m += sample.error.x_m * sample.error.x_m + sample.error.y_m * sample.error.y_m;
    mean.sigma_m += sample.sigma.x_m * sample.sigma.x_m + sample.sigma.y_m * sample.sigma.y_m;
    ++mean.runs;
  }
  std::tie(study.low, study.high) = nees_band(runs);
  for (auto& [time, mean] : means) {
    if (mean.runs < runs) {
      continue;  // some runs had ended
    }
    mean.nees /= mean.runs;
    mean.error_m = std::sqrt(mean.error_m / mean.runs);
    mean.sigma_m = std::sqrt(mean.sigma_m / mean.runs);
    study.inside += mean.nees >= study.low && mean.nees <= study.high ? 1 : 0;
    study.means.push_back(mean);
  }
}

}  // namespace

double NeesStudy::share_inside() const {
  return means.empty() ? 0.0 : static_cast<double>(inside) / static_cast<double>(means.size());
}

std::pair<double, double> nees_band(int runs) {
  // Wilson & Hilferty; for 150 degrees of freedom off by less than 1e-3 of the value.
  constexpr double kDof = 3.0;
  constexpr double kTwoSided95 = 1.959964;
  const double n = kDof * std::max(runs, 1);
  const double a = 2.0 / (9.0 * n);
  const auto quantile = [&](double sigmas) { return kDof * std::pow(1.0 - a + sigmas * std::sqrt(a), 3); };
  return {quantile(-kTwoSided95), quantile(kTwoSided95)};
}

Result<NeesStudy> study_consistency(const sim::World& world, const sim::RobotModel& model,
                                    const MakeTracker& make_tracker, const ConsistencyParams& params) {
  const sim::RobotModel robot = without_systematic_errors(model, params.odometry_factor);
  NeesStudy study;
  for (const std::uint64_t seed : params.seeds) {
    const std::unique_ptr<slam::PoseTracker> tracker = make_tracker(robot);
    Rng rng(seed);
    const sim::RobotModel driven = with_uneven_wheels(robot, params.wheels, rng);
    if (Status ok = run_tour(world, driven, *tracker, params, seed, study.samples); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
  }
  summarise(study, static_cast<int>(params.seeds.size()));
  return study;
}

sim::RobotModel without_systematic_errors(sim::RobotModel model, double odometry_factor) {
  sim::OdometryModel& m = model.odometry;
  m.left_wheel_scale = 1.0;
  m.right_wheel_scale = 1.0;
  m.wheel_base_scale = 1.0;
  m.sigma_distance *= odometry_factor;
  m.sigma_rotation *= odometry_factor;
  m.sigma_rotation_per_distance *= odometry_factor;
  return model;
}

sim::RobotModel with_uneven_wheels(sim::RobotModel model, const UnevenWheels& wheels, Rng& rng) {
  sim::OdometryModel& m = model.odometry;
  const double scale = rng.normal(wheels.scale_sigma);
  const double half_difference = 0.5 * model.wheel_base_m * rng.normal(wheels.drift_sigma_rad_per_m);
  m.left_wheel_scale *= 1.0 + scale - half_difference;
  m.right_wheel_scale *= 1.0 + scale + half_difference;
  m.wheel_base_scale *= 1.0 + rng.normal(wheels.base_sigma);
  return model;
}

Table nees_table(const NeesStudy& study) {
  Table table({"seed", "time_s", "nees", "error_x_m", "error_y_m", "error_theta_rad", "sigma_x_m", "sigma_y_m",
               "sigma_theta_rad"});
  for (const NeesSample& s : study.samples) {
    table.add({std::to_string(s.seed), fixed(s.time_s, 1), fixed(s.nees, 4), fixed(s.error.x_m, 6),
               fixed(s.error.y_m, 6), fixed(s.error.theta_rad, 7), fixed(s.sigma.x_m, 6), fixed(s.sigma.y_m, 6),
               fixed(s.sigma.theta_rad, 7)});
  }
  for (const NeesMean& m : study.means) {
    table.add({"mean", fixed(m.time_s, 1), fixed(m.nees, 4), fixed(m.error_m, 6), "", "", fixed(m.sigma_m, 6), "", ""});
  }
  return table;
}

Image nees_chart(const std::string& title, const std::vector<std::pair<std::string, NeesStudy>>& studies) {
  image::Chart chart;
  chart.title = title;
  chart.x_label = "time (s)";
  chart.y_label = "mean NEES of the robot, 3 dof";
  double highest = 0.0;
  for (const auto& [name, study] : studies) {
    image::Series series{.name = name, .x = {}, .y = {}, .style = image::SeriesStyle::kLineAndPoints};
    for (const NeesMean& mean : study.means) {
      series.x.push_back(mean.time_s);
      series.y.push_back(mean.nees);
      highest = std::max({highest, mean.nees, study.high});
    }
    chart.series.push_back(series);
  }
  const NeesStudy& first = studies.front().second;
  if (!first.means.empty()) {
    for (const double limit : {first.low, first.high}) {
      chart.series.push_back({.name = limit == first.low ? "95 % of consistent filters" : "",
                              .x = {first.means.front().time_s, first.means.back().time_s},
                              .y = {limit, limit},
                              .style = image::SeriesStyle::kLine,
                              .colour = image::kGrey,
                              .line = image::LineStyle::kDashed});
    }
  }
  chart.y_range = {0.0, 1.4 * highest};
  return image::draw_chart(chart);
}

Check nees_check(const std::string& name, const NeesStudy& study) {
  double mean = 0.0;
  for (const NeesMean& m : study.means) {
    mean += m.nees / static_cast<double>(study.means.size());
  }
  const double error_m = study.means.empty() ? 0.0 : study.means.back().error_m;
  return {.id = "R2",
          .passed = study.share_inside() >= kShareWanted,
          .figures = {{"case", name},
                      {"inside", std::to_string(study.inside) + "/" + std::to_string(study.means.size())},
                      {"band", fixed(study.low, 2) + ".." + fixed(study.high, 2)},
                      {"mean_nees", fixed(mean, 3)},
                      {"last_error_m", fixed(error_m, 4)},
                      {"runs", std::to_string(study.means.empty() ? 0 : study.means.back().runs)}}};
}

}  // namespace seeker::lab
