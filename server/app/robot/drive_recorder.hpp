/// \file
/// Records what the robot drives on: its odometry and scans, as a CARMEN log.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "common/core/scan.hpp"
#include "server/app/estimators/odometry_history.hpp"
#include "server/app/loop/loop_hooks.hpp"
#include "server/app/runtime/disk_worker.hpp"
#include "server/drivers/interfaces/drivers.hpp"
#include "server/drivers/replay/line_sink.hpp"

namespace seeker::app {

struct DriveRecorderParams {
  std::chrono::milliseconds flush_period{1000};       ///< wall time after which what was recorded goes to the disk
  std::size_t piece_bytes = std::size_t{256} << 10U;  ///< text that goes to the disk sooner
  std::size_t pieces_waiting = 64;  ///< pieces that wait for a slow disk; what comes beyond them is left out
};

/// Takes readings on the loop's thread, which never waits for the disk. Odometry is recorded as measured, without the
/// calibration of the wheels, so that a replay with the same robot file corrects it once; scans are recorded as they
/// are after the motion of the base was taken out of them, each with the odometry at its own stamp.
class DriveRecorder {
 public:
  /// Creates the file (LineSink::create). `epoch_s` is the log's clock at robot time 0: seconds since 1970, or 0 where
  /// the robot's time is not that of the world. Errors of the file.
  [[nodiscard]] static Result<std::unique_ptr<DriveRecorder>> create(const std::filesystem::path& path,
                                                                     const std::string& robot_id, double epoch_s,
                                                                     const DriveRecorderParams& params = {});
  DriveRecorder(const DriveRecorder&) = delete;
  DriveRecorder& operator=(const DriveRecorder&) = delete;
  /// Writes the rest.
  ~DriveRecorder();

  /// Follows the readings of a loop, which must not tick any more when this ends.
  void follow(LoopHooks& hooks);
  /// Called from any thread when something was not recorded: once where the disk is too slow (kBusy), and once where
  /// the recording ends because the disk is full or gone (kIo). To be set before the first reading.
  void set_on_error(std::function<void(const Error&)> on_error) { on_error_ = std::move(on_error); }

  void add(const drivers::OdometrySample& measured);
  void add(const LaserScan& scan);
  /// The file that is written.
  [[nodiscard]] std::filesystem::path path() const { return path_; }

 private:
  DriveRecorder(drivers::LineSink sink, double epoch_s, const DriveRecorderParams& params);
  void write_scans(bool all);
  void record(const std::string& text);
  void post();
  void report(const Error& error) const;

  DriveRecorderParams params_;
  double epoch_s_;
  std::filesystem::path path_;
  std::function<void(const Error&)> on_error_;
  OdometryHistory history_;      ///< as measured
  std::deque<LaserScan> scans_;  ///< which wait for odometry of their stamps
  std::optional<RobotTime> last_odometry_;
  std::optional<Pose2> base_T_laser_;  ///< as last written into a comment
  std::string text_;                   ///< not with the worker yet
  std::chrono::steady_clock::time_point posted_;
  bool behind_ = false;  ///< the disk was too slow once
  std::atomic<bool> failed_{false};
  drivers::LineSink sink_;  ///< for the worker only
  DiskWorker worker_;       ///< the last member: it ends first
};

}  // namespace seeker::app
