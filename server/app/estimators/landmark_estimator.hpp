/// \file
/// Estimator by a database of landmarks: odometry moves the pose, looks with the stereo camera correct it (spec S2.8,
/// S2.9).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/rng.hpp"
#include "server/app/estimators/estimator.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/app/runtime/background.hpp"
#include "server/localize/database_update.hpp"
#include "server/localize/stereo_localiser.hpp"

namespace seeker::app {

struct LandmarkEstimatorParams {
  std::string database;                                   ///< name of the database of landmarks
  Duration look_period = std::chrono::milliseconds(500);  ///< between looks, robot time
  Duration odometry_gap = std::chrono::seconds(1);        ///< longer silence is a typed fault
  /// Between updates of the database by what was seen (spec S2.10), robot time; 0: it is only read.
  Duration update_period = Duration::zero();
  localize::UpdateParams update;
};

/// Where updates go, and what sees them coming.
struct LandmarkUpdating {
  std::shared_ptr<LandmarkLibrary> library;
  StereoGeometry geometry;
  bool inline_work = true;  ///< lockstep: an update is made within a tick
};

/// The frame `map` is that of the database. Not for two threads at once.
class LandmarkEstimator final : public Estimator {
 public:
  /// `database` is the one that the localiser reads.
  LandmarkEstimator(localize::StereoLocaliser localiser, std::shared_ptr<const localize::LandmarkDatabase> database,
                    const LandmarkEstimatorParams& params, const LandmarkUpdating& updating, Rng rng);

  [[nodiscard]] Status on_odometry(const drivers::OdometrySample& sample) override;
  /// Walls say nothing here.
  [[nodiscard]] Status on_scan(const LaserScan& /*scan*/) override { return {}; }
  [[nodiscard]] bool wants_look(RobotTime now) const override;
  void look_begun(RobotTime stamp) override;
  void on_look(const Result<StereoLook>& look) override;
  [[nodiscard]] Status place_at(const PoseEstimate& place) override;
  [[nodiscard]] std::vector<std::string> take_news() override { return std::exchange(news_, {}); }
  [[nodiscard]] PoseEstimate estimate() const override;

 private:
  using Database = std::shared_ptr<const localize::LandmarkDatabase>;
  /// A version that is on the disk.
  struct Updated {
    Database database;
    localize::UpdateCounts counts;
  };

  void catch_up();
  void learn(const StereoLook& look);
  void begin_update(RobotTime now);
  void end_update();

  localize::StereoLocaliser localiser_;
  Database database_;
  LandmarkEstimatorParams params_;
  std::shared_ptr<LandmarkLibrary> library_;
  Rng rng_;
  StereoGeometry geometry_;
  localize::DatabaseUpdate update_;
  Background<Updated> updating_;
  std::optional<RobotTime> updated_at_;
  std::vector<std::string> news_;
  /// The one at which the localiser stands, and those after it: while a look is worked on the localiser waits at the
  /// time of its exposure, and catches up afterwards.
  std::vector<drivers::OdometrySample> samples_;
  bool looking_ = false;
  std::optional<RobotTime> looked_at_;
};

}  // namespace seeker::app
