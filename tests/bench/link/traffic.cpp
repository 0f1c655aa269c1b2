#include "tests/bench/link/traffic.hpp"

#include <utility>

#include "common/core/rng.hpp"
#include "tests/bench/link/latencies.hpp"
#include "tests/support/fake_robot.hpp"

namespace seeker::link_bench {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr int kChannels = 3;
constexpr std::uint64_t kByteValues = 256;

api::ImageFrame noise() {
  api::ImageFrame out;
  out.camera = "omni";
  out.frame.image = Image(kImageWidth_px, kImageHeight_px, kChannels);
  Rng rng(kSeed);
  for (std::uint8_t& byte : out.frame.image.data()) {
    byte = static_cast<std::uint8_t>(rng.below(kByteValues));
  }
  return out;
}

}  // namespace

Traffic::Traffic(Publish publish)
    : publish_(std::move(publish)), status_(testing::default_fake_values().status), image_(noise()) {
  thread_ = std::thread([this] { run(); });
}

Traffic::~Traffic() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Traffic::run() {
  auto due = std::chrono::steady_clock::now();
  for (int tick = 0;; ++tick) {
    due += kStatusPeriod;
    std::unique_lock lock(mutex_);
    if (changed_.wait_until(lock, due, [this] { return stopping_; })) {
      return;
    }
    lock.unlock();
    status_.stamp = now();
    publish_(api::Topic::kStatus, status_.stamp, status_);
    if (tick % kStatusesPerImage == 0) {
      image_.frame.stamp = now();
      publish_(api::Topic::kImage, image_.frame.stamp, image_);
    }
  }
}

}  // namespace seeker::link_bench
