#include "server/drivers/merged/merged_lidar.hpp"

#include <utility>

#include "common/core/assert.hpp"

namespace seeker::drivers {
namespace {

/// For people: the first scanner is number 1. Its faults keep their names.
std::string numbered(const std::string& id, std::size_t lidar) {
  return lidar == 0 ? id : id + "-" + std::to_string(lidar + 1);
}

void add(const LinkStatistics& more, LinkStatistics& sum) {
  sum.bytes_in += more.bytes_in;
  sum.bytes_out += more.bytes_out;
  sum.packets_in += more.packets_in;
  sum.packets_bad += more.packets_bad;
  sum.bytes_skipped += more.bytes_skipped;
  sum.connects += more.connects;
}

}  // namespace

MergedLidar::MergedLidar(std::vector<std::shared_ptr<LidarDriver>> lidars, PoseAt odom_T_base_at,
                         const MergedLidarParams& params)
    : lidars_(std::move(lidars)), odom_T_base_at_(std::move(odom_T_base_at)), params_(params), newest_(lidars_.size()) {
  SEEKER_ASSERT(!lidars_.empty());
}

Status MergedLidar::activate() {
  newest_.assign(lidars_.size(), std::nullopt);
  first_stamp_.reset();
  for (std::size_t k = 0; k < lidars_.size(); ++k) {
    if (Status opened = lidars_[k]->activate(); !opened) {
      for (std::size_t open = 0; open < k; ++open) {
        lidars_[open]->deactivate();
      }
      return opened;
    }
  }
  return {};
}

void MergedLidar::deactivate() {
  for (const std::shared_ptr<LidarDriver>& lidar : lidars_) {
    lidar->deactivate();
  }
}

Status MergedLidar::set_period(Duration period) {
  for (const std::shared_ptr<LidarDriver>& lidar : lidars_) {
    if (Status set = lidar->set_period(period); !set) {
      return set;
    }
  }
  return {};
}

Result<std::optional<LaserScan>> MergedLidar::read() {
  bool fresh = false;
  for (std::size_t k = 0; k < lidars_.size(); ++k) {
    Result<std::optional<LaserScan>> scan = lidars_[k]->read();
    if (!scan) {
      return scan;
    }
    if (!*scan) {
      continue;
    }
    if (Status valid = validate(**scan); !valid) {
      return fail_with_context("scanner " + std::to_string(k + 1), valid.error());
    }
    newest_[k] = std::move(**scan);
    fresh = fresh || k == 0;
  }
  if (!fresh) {
    return std::optional<LaserScan>();
  }
  first_stamp_ = first_stamp_.value_or(newest_.front()->stamp);
  return std::optional(merge());
}

LaserScan MergedLidar::merge() const {
  std::vector<LaserScan> scans;
  scans.reserve(newest_.size());
  for (std::size_t k = 0; k < newest_.size(); ++k) {
    if (newest_[k] && !is_silent(k)) {
      scans.push_back(*newest_[k]);
    }
  }
  return merged_scan(
      scans, [this](RobotTime stamp) { return odom_T_base_at_(stamp).value_or(Pose2{}); }, params_.merge);
}

bool MergedLidar::is_silent(std::size_t lidar) const {
  if (lidar == 0 || !first_stamp_) {
    return false;
  }
  const RobotTime last = newest_[lidar] ? newest_[lidar]->stamp : *first_stamp_;
  return newest_.front()->stamp - last > params_.max_age;
}

std::vector<DeviceFault> MergedLidar::faults() const {
  std::vector<DeviceFault> all;
  for (std::size_t k = 0; k < lidars_.size(); ++k) {
    for (DeviceFault& fault : lidars_[k]->faults()) {
      fault.id = numbered(fault.id, k);
      all.push_back(std::move(fault));
    }
    if (is_silent(k)) {
      all.push_back({numbered("silent", k), "scanner " + std::to_string(k + 1) + " gives no scans while the first does",
                     "check its cable and power", true});
    }
  }
  return all;
}

std::optional<LinkStatistics> MergedLidar::statistics() const {
  std::optional<LinkStatistics> sum;
  for (const std::shared_ptr<LidarDriver>& lidar : lidars_) {
    if (const std::optional<LinkStatistics> one = lidar->statistics()) {
      sum = sum.value_or(LinkStatistics{});
      add(*one, *sum);
    }
  }
  return sum;
}

}  // namespace seeker::drivers
