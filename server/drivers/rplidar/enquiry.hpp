/// \file
/// One question to an RPLIDAR until its answer can be trusted.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/time.hpp"
#include "server/protocols/rplidar/answer_reader.hpp"
#include "server/protocols/rplidar/request.hpp"

namespace seeker::drivers {

/// Single answers carry no checksum, so each question is asked until two answers in a row agree.
class Enquiry {
 public:
  /// `tries` at least 1: how often silence is answered by asking again; disagreement may take twice as many.
  Enquiry(int tries, Duration timeout) : tries_(tries), timeout_(timeout) {}

  /// Begins with another question. The caller sends its bytes.
  void begin(const rplidar::Request& request, RobotTime now);
  /// Takes an answer; returns it when it agrees with the one before. Nothing: the question is to be asked again, if
  /// ask_again() allows.
  [[nodiscard]] std::optional<rplidar::AnswerValue> confirm(const rplidar::AnswerValue& answer);
  /// Whether the question may be put once more; counts it.
  [[nodiscard]] bool ask_again(RobotTime now);
  /// When silence has lasted too long.
  [[nodiscard]] RobotTime deadline() const { return deadline_; }
  [[nodiscard]] const rplidar::Request& request() const { return request_; }

 private:
  int tries_;
  Duration timeout_;
  int left_ = 0;
  bool extended_ = false;
  RobotTime deadline_;
  rplidar::Request request_;
  std::optional<rplidar::AnswerValue> answer_;
};

}  // namespace seeker::drivers
