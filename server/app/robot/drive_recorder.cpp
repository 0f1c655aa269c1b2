#include "server/app/robot/drive_recorder.hpp"

#include <utility>

#include "server/drivers/replay/carmen_writer.hpp"

namespace seeker::app {
namespace {

/// Scans wait for odometry; a base that reports less often than this is silent.
constexpr std::size_t kMostScansWaiting = 8;

}  // namespace

Result<std::unique_ptr<DriveRecorder>> DriveRecorder::create(const std::filesystem::path& path,
                                                             const std::string& robot_id, double epoch_s,
                                                             const DriveRecorderParams& params) {
  Result<drivers::LineSink> sink = drivers::LineSink::create(path);
  if (!sink) {
    return tl::unexpected<Error>(sink.error());
  }
  std::unique_ptr<DriveRecorder> recorder(new DriveRecorder(std::move(*sink), epoch_s, params));
  recorder->text_ = drivers::carmen_header(robot_id);
  return recorder;
}

DriveRecorder::DriveRecorder(drivers::LineSink sink, double epoch_s, const DriveRecorderParams& params)
    : params_(params),
      epoch_s_(epoch_s),
      path_(sink.path()),
      posted_(std::chrono::steady_clock::now()),
      sink_(std::move(sink)),
      worker_(params.pieces_waiting, "pieces of a recording") {}

DriveRecorder::~DriveRecorder() {
  write_scans(true);
  post();
  worker_.finish();
}

void DriveRecorder::follow(LoopHooks& hooks) {
  hooks.on_odometry = [this](const drivers::OdometrySample& measured) { add(measured); };
  hooks.on_scan = [this](const LaserScan& scan) { add(scan); };
}

void DriveRecorder::add(const drivers::OdometrySample& measured) {
  if (last_odometry_ && measured.stamp <= *last_odometry_) {
    return;
  }
  last_odometry_ = measured.stamp;
  history_.add(measured);
  const double since_start_s = to_seconds(measured.stamp);
  record(drivers::carmen_odometry_line({.odom_T_base = measured.odom_T_base, .velocity = measured.velocity},
                                       {epoch_s_ + since_start_s, since_start_s}));
  write_scans(false);
}

void DriveRecorder::add(const LaserScan& scan) {
  scans_.push_back(scan);
  write_scans(false);
}

void DriveRecorder::write_scans(bool all) {
  while (!scans_.empty()) {
    const LaserScan& scan = scans_.front();
    const bool wait = !last_odometry_ || scan.stamp > *last_odometry_;
    if (wait && !all && scans_.size() <= kMostScansWaiting) {
      return;
    }
    if (const std::optional<Pose2> odom_T_base = history_.predicted_at(scan.stamp)) {
      if (base_T_laser_ != scan.base_T_laser) {
        base_T_laser_ = scan.base_T_laser;
        record(drivers::carmen_mount_comment(scan.base_T_laser));
      }
      const double since_start_s = to_seconds(scan.stamp);
      record(drivers::carmen_scan_line(scan, *odom_T_base, history_.at(scan.stamp)->velocity,
                                       {epoch_s_ + since_start_s, since_start_s}));
    }
    scans_.pop_front();
  }
}

void DriveRecorder::record(const std::string& text) {
  if (failed_) {
    return;
  }
  text_ += text;
  const bool due = std::chrono::steady_clock::now() - posted_ >= params_.flush_period;
  if (due || text_.size() >= params_.piece_bytes) {
    post();
  }
}

void DriveRecorder::post() {
  posted_ = std::chrono::steady_clock::now();
  if (text_.empty()) {
    return;
  }
  const Status posted = worker_.post([this, text = std::exchange(text_, {})] {
    if (failed_) {
      return;
    }
    if (const Status written = sink_.write_and_flush(text); !written) {
      failed_ = true;
      report(written.error());
    }
  });
  if (!posted && !behind_) {
    behind_ = true;
    report({Errc::kBusy, path_.string() +
                             " cannot be written as fast as the robot drives: readings are left out; record onto "
                             "another disk"});
  }
}

void DriveRecorder::report(const Error& error) const {
  if (on_error_) {
    on_error_(error);
  }
}

}  // namespace seeker::app
