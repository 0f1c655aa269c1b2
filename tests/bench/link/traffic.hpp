/// \file
/// What the robot of the benchmark publishes: the same values for every stack.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "common/api/robot_api.hpp"

namespace seeker::link_bench {

inline constexpr std::chrono::milliseconds kStatusPeriod{50};
inline constexpr int kStatusesPerImage = 2;  ///< of the tick in which both are published, the status comes first
/// A picture that zstd cannot make smaller, of the size of a JPEG of 640x480: 60 kB.
inline constexpr int kImageWidth_px = 200;
inline constexpr int kImageHeight_px = 100;

/// Publishes status and images at their periods on a thread of its own, from the constructor to the destructor. Each is
/// stamped with now() just before.
class Traffic {
 public:
  using Publish = std::function<void(api::Topic topic, RobotTime stamp, const api::Payload& payload)>;
  explicit Traffic(Publish publish);
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;
  ~Traffic();

 private:
  void run();

  Publish publish_;
  api::RobotStatus status_;
  api::ImageFrame image_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace seeker::link_bench
