/// \file
/// Writes what happens to the store, on its own thread: the disk never delays the loop.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/api/robot_state.hpp"
#include "server/store/store.hpp"

namespace seeker::app {

/// How it goes with the journal.
struct JournalHealth {
  std::size_t waiting = 0;      ///< writes that the disk has not taken yet
  std::uint64_t dropped = 0;    ///< writes since the start that it never took
  std::optional<Error> failed;  ///< the first write that failed
};

/// Missions, their events and detections in order. When the disk cannot follow, the oldest waiting entry is dropped and
/// counted. Only the first error is reported: what could not be written is missing later, and the errors of that hide
/// the cause.
class Journal {
 public:
  /// Opens the store. Errors as Store::open().
  [[nodiscard]] static Result<std::unique_ptr<Journal>> open(const std::filesystem::path& folder);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  /// Writes what is waiting, then ends the thread.
  ~Journal();

  /// The mission that was running when the program ended, killed or on request; nothing when none was. Its record stays
  /// open until it is resumed or another mission begins, over any number of restarts.
  [[nodiscard]] const std::optional<api::MissionRequest>& unfinished() const { return unfinished_; }
  [[nodiscard]] std::uint64_t highest_detection_id() const { return highest_detection_id_; }

  void mission_started(const api::MissionRequest& request, RobotTime now);
  void mission(const api::MissionStatus& status);
  void event(const api::Event& event);
  void detection(const api::Detection& detection);
  /// The emergency stop was latched when the program ended. One whose record cannot be read counts as latched.
  [[nodiscard]] bool estop() const { return estop_; }
  /// Keeps the emergency stop before anything that waits; `kept` is called on the journal's thread when it is on the
  /// disk, or with the error.
  void keep_estop(bool engaged, std::function<void(const Status&)> kept);
  /// Called on the journal's thread with the sentence of the first failed write.
  void set_on_error(std::function<void(const Error&)> on_error);
  [[nodiscard]] std::uint64_t dropped() const;
  [[nodiscard]] JournalHealth health() const;

 private:
  using Write = std::function<Status(store::Store&)>;

  explicit Journal(store::Store store);
  void enqueue(Write write);
  void work();
  void find_unfinished();

  store::Store store_;
  std::optional<api::MissionRequest> unfinished_;
  std::optional<store::MissionRecord> open_;  ///< of unfinished_, until a mission begins
  std::uint64_t highest_detection_id_ = 0;
  std::uint64_t events_before_ = 0;  ///< of the newest mission, from before it was resumed; the journal's thread alone
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Write> queue_;
  std::deque<Write> urgent_;  ///< written first and never dropped
  std::function<void(const Error&)> on_error_;
  bool estop_ = false;
  bool error_reported_ = false;  ///< the first one only
  std::optional<Error> failed_;  ///< the first one
  std::uint64_t dropped_ = 0;
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace seeker::app
