/// \file
/// A recorded log in place of hardware: clock, base and lidar of one source.
#pragma once

#include <memory>
#include <optional>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/drivers/interfaces/drivers.hpp"
#include "server/drivers/interfaces/pacer.hpp"
#include "server/drivers/replay/carmen_reader.hpp"

namespace seeker::drivers {

/// Mount of the log's laser, which CARMEN logs do not state.
struct ReplayParams {
  double angle_min_rad = -kPi / 2.0;
  double angle_step_rad = 0.0;  ///< 0: as stated in the line, otherwise 180 degrees over the number of beams
  double range_min_m = 0.02;    ///< a beam below it is unusable (quality 0)
  double range_max_m = 80.0;    ///< a beam at or above it has no return (81 m and more is CARMEN's code)
  Pose2 base_T_laser;
};

/// Plays records in the order of their stamps; robot time 0 is the log's first stamp. It is shared by the drivers
/// below, all in the loop's thread. The log's corrected poses are not passed on.
class ReplaySource {
 public:
  /// Opens a log. Errors of CarmenReader::open; kParse when the file holds no record at all.
  [[nodiscard]] static Result<std::shared_ptr<ReplaySource>> open(const std::filesystem::path& path,
                                                                  const ReplayParams& params = {});

  /// Takes the records stamped up to `now`; the newest of each kind waits for its reader. It stops before a second
  /// scan, so that none is lost where two fall into one tick, and after a scan that does not state its own odometry, so
  /// that the scan is used with the odometry before it: now() is then the time of the last record taken.
  void advance_to(RobotTime now);
  /// Takes exactly the next record, so that no record is replaced unread; false at the end.
  bool advance_one();
  [[nodiscard]] RobotTime now() const { return now_; }
  /// The log's clock at robot time 0.
  [[nodiscard]] double first_stamp_s() const { return *first_stamp_s_; }
  /// True when the last record has been taken.
  [[nodiscard]] bool finished() const { return !pending_; }
  [[nodiscard]] const ReplaySummary& summary() const { return reader_.summary(); }

  [[nodiscard]] std::optional<OdometrySample> take_odometry();
  [[nodiscard]] std::optional<LaserScan> take_scan();

 private:
  ReplaySource(CarmenReader reader, const ReplayParams& params);
  void fetch() { pending_ = reader_.next(); }
  void deliver(const CarmenOdometry& odometry);
  void deliver(const CarmenScan& scan);
  void deliver_pose(const Pose2& odom_T_base, RobotTime stamp);
  [[nodiscard]] RobotTime robot_time_of(const CarmenRecord& record) const;

  CarmenReader reader_;
  ReplayParams params_;
  std::optional<CarmenRecord> pending_;
  std::optional<double> first_stamp_s_;
  RobotTime now_;
  std::optional<OdometrySample> odometry_;
  std::optional<OdometrySample> last_odometry_;
  std::optional<LaserScan> scan_;
  bool scans_have_odometry_ = false;  ///< then ODOM lines are not used, because pose and scan belong together
};

/// Robot time follows the log. Lockstep: at speed 0 as fast as possible, otherwise paced by the wall clock.
class ReplayClock final : public Clock {
 public:
  ReplayClock(std::shared_ptr<ReplaySource> source, double speed);

  [[nodiscard]] RobotTime now() const override { return source_->now(); }
  /// kCancelled once the last record has been taken before this call.
  [[nodiscard]] Status advance(Duration period) override;
  [[nodiscard]] Result<bool> await(Duration limit) override { return pacer_.await(limit); }
  [[nodiscard]] bool lockstep() const override { return true; }
  void let_go() override { pacer_.rest(); }
  [[nodiscard]] double speed() const override { return pacer_.speed(); }
  [[nodiscard]] std::optional<TickTiming> timing() const override { return pacer_.timing(); }

 private:
  std::shared_ptr<ReplaySource> source_;
  Pacer pacer_;
};

/// The recorded odometry. It cannot be driven: kRefused for any motion; a zero velocity is accepted.
class ReplayBase final : public BaseDriver {
 public:
  explicit ReplayBase(std::shared_ptr<ReplaySource> source) : source_(std::move(source)) {}

  [[nodiscard]] Status activate() override { return {}; }
  void deactivate() override {}
  [[nodiscard]] Result<std::optional<OdometrySample>> read() override { return source_->take_odometry(); }
  [[nodiscard]] Status set_velocity(const Twist2& velocity, RobotTime now) override;
  [[nodiscard]] Status set_motors(bool enabled) override;
  [[nodiscard]] Status drivable() const override;

 private:
  std::shared_ptr<ReplaySource> source_;
};

class ReplayLidar final : public LidarDriver {
 public:
  explicit ReplayLidar(std::shared_ptr<ReplaySource> source) : source_(std::move(source)) {}

  [[nodiscard]] Status activate() override { return {}; }
  void deactivate() override {}
  [[nodiscard]] Result<std::optional<LaserScan>> read() override { return source_->take_scan(); }

 private:
  std::shared_ptr<ReplaySource> source_;
};

/// A logged scan in the program's form, with the codes for "none" replaced and the mount filled in.
[[nodiscard]] LaserScan to_laser_scan(const CarmenScan& scan, const ReplayParams& params, RobotTime stamp);

}  // namespace seeker::drivers
