/// \file
/// What is wrong with the robot now.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/api/robot_state.hpp"

namespace seeker::app {

/// Faults by id: raised while their cause lasts, cleared when it goes.
class FaultList {
 public:
  /// True when the fault is new (the caller logs an event).
  bool raise(api::Fault fault);
  /// True when it was there.
  bool clear(const std::string& id);
  [[nodiscard]] std::optional<api::Fault> find(const std::string& id) const;
  [[nodiscard]] const std::vector<api::Fault>& all() const { return faults_; }
  /// The first fault that forbids motion (kError or worse); null when there is none.
  [[nodiscard]] const api::Fault* blocking() const;

 private:
  std::vector<api::Fault> faults_;
};

}  // namespace seeker::app
