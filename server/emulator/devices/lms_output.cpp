#include "server/emulator/devices/lms_output.hpp"

#include <algorithm>
#include <utility>

#include "server/protocols/lms200/telegram.hpp"

namespace seeker::emulator {

void LmsOutput::send(std::vector<std::uint8_t> bytes, RobotTime earliest, std::uint32_t baud) {
  if (waiting_.size() >= kMaxWaiting) {
    return;
  }
  const RobotTime start = std::max(earliest, free_at_);
  free_at_ = start + lms200::transfer_time(bytes.size(), baud);
  waiting_.push_back({start, std::move(bytes)});
}

void LmsOutput::release(RobotTime now, std::vector<std::uint8_t>& taken) {
  while (!waiting_.empty() && waiting_.front().start <= now) {
    taken.insert(taken.end(), waiting_.front().bytes.begin(), waiting_.front().bytes.end());
    waiting_.pop_front();
  }
}

void LmsOutput::clear() {
  waiting_.clear();
  free_at_ = RobotTime::min();
}

RobotTime LmsOutput::next_start() const { return waiting_.empty() ? RobotTime::max() : waiting_.front().start; }

}  // namespace seeker::emulator
