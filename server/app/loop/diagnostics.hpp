/// \file
/// Diagnostics records what is wrong with the robot and what has happened to it: faults, the states of its components,
/// and numbered events.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "common/api/robot_state.hpp"
#include "common/core/result.hpp"
#include "server/app/loop/loop_hooks.hpp"
#include "server/app/runtime/components.hpp"
#include "server/app/runtime/fault_list.hpp"
#include "server/app/runtime/update_hub.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::app {

/// The fault while the disk takes nothing: what happens is not kept, so that no mission may begin.
inline constexpr const char* kJournalFailed = "journal-failed";
/// The fault while who commands what cannot be recorded.
inline constexpr const char* kAuditFailed = "audit-failed";

/// Owns the faults, the component states and the event numbers. A fault that is new, or that goes, is an
/// event. Lives on the loop's thread.
class Diagnostics {
 public:
  /// `hub` and `hooks` must outlive it.
  Diagnostics(std::shared_ptr<const drivers::Clock> clock, UpdateHub& hub, const LoopHooks& hooks);

  /// Raises the fault `id`; one that is there already is updated without a new event.
  void raise(const std::string& id, const std::string& component, const std::string& message, const std::string& remedy,
             api::Severity severity = api::Severity::kError);
  /// Clears the fault and returns whether it was there.
  bool clear(const std::string& id);
  /// Takes the estimator's or the map's answer to a reading: an error raises the warning `id`, success clears it.
  void note_reading(const Status& status, const std::string& id);

  /// Reports the wall time that the work on one picture took (LoopHooks::on_work).
  void note_work(std::string_view work, Duration took) const;

  /// Emits an event that belongs to no mission, stamped with the present robot time.
  void log(const std::string& kind, const std::string& text, api::Severity severity = api::Severity::kInfo);
  /// Hands an event to the journal as it is and, with the next sequence number, to subscribers.
  void emit(const api::Event& event);

  [[nodiscard]] const FaultList& faults() const { return faults_; }
  [[nodiscard]] Components& components() { return components_; }
  [[nodiscard]] const Components& components() const { return components_; }

 private:
  std::shared_ptr<const drivers::Clock> clock_;
  UpdateHub& hub_;
  const LoopHooks& hooks_;
  FaultList faults_;
  Components components_;
  std::uint64_t event_sequence_ = 0;
};

}  // namespace seeker::app
