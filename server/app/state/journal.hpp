/// \file
/// Writes what happens to the store, on its own thread: the disk never delays the loop.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/api/robot_state.hpp"
#include "server/app/state/journal_writer.hpp"
#include "server/store/store.hpp"

namespace seeker::app {

/// Missions, their events and detections in order. What happens is written on a thread of its own; when_kept() says
/// when that is done. While the disk takes nothing, the newest records wait for it in memory, some thousands of them.
class Journal {
 public:
  /// Opens the store. Errors as Store::open().
  [[nodiscard]] static Result<std::unique_ptr<Journal>> open(const std::filesystem::path& folder);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal() = default;

  /// Sentences about what an earlier run of the program had kept and this one cannot read; empty where nothing is lost.
  [[nodiscard]] const std::string& lost() const { return lost_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
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
  /// Keeps the emergency stop before anything that waits; `on_kept` is called on the journal's thread when it is on the
  /// disk, or with the error.
  void keep_estop(bool engaged, JournalWriter::OnKept on_kept);
  /// Calls `on_kept` on the journal's thread when all that was given to the journal before is on the disk. With an
  /// error where the disk takes nothing: it is written when it can be, but a kill before that loses it.
  void when_kept(JournalWriter::OnKept on_kept) { writer_->write(nullptr, std::move(on_kept)); }
  void set_watch(JournalWatch watch) { writer_->set_watch(std::move(watch)); }
  /// Writes what is waiting, then ends the thread; harmless when repeated.
  void finish() { writer_->finish(); }
  [[nodiscard]] JournalHealth health() const { return writer_->health(); }

 private:
  Journal(store::Store store, std::filesystem::path folder);
  void enqueue(JournalWriter::Write write) { writer_->write(std::move(write), nullptr); }
  void find_unfinished();
  void read_estop();
  void note_lost(const std::string& what);

  store::Store store_;
  std::filesystem::path folder_;
  std::string lost_;
  std::optional<api::MissionRequest> unfinished_;
  std::optional<store::MissionRecord> open_;  ///< of unfinished_, until a mission begins
  std::uint64_t highest_detection_id_ = 0;
  std::uint64_t events_before_ = 0;  ///< of the newest mission, from before it was resumed; the writer's thread alone
  bool estop_ = false;
  std::unique_ptr<JournalWriter> writer_;  ///< the last one: it ends before what it writes with
};

}  // namespace seeker::app
