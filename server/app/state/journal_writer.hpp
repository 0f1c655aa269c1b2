/// \file
/// A queue before the store: what is waiting is written in order, several at a time, and reported when it is on the
/// disk.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "server/store/store.hpp"

namespace seeker::app {

/// What becomes of the writes. All are called on the writer's thread; one that is empty is not called.
struct JournalWatch {
  std::function<void(const Error&)> failing;  ///< the disk takes nothing; what is waiting is tried again until it does
  std::function<void()> writes_again;         ///< after failing(): what was waiting is being written
  /// One record will be missing: the store refused it, or too many were waiting. The first one only, since what is
  /// refused for want of it would hide the cause.
  std::function<void(const Error&)> lost;
};

/// What to do about a disk that takes nothing.
inline constexpr const char* kJournalRemedy =
    "free space on the disk of the state folder; it is tried again by itself, and missions that run go on";

/// How it goes with the journal.
struct JournalHealth {
  std::size_t waiting = 0;      ///< writes that the disk has not taken yet
  std::uint64_t dropped = 0;    ///< writes since the start that it never took
  std::optional<Error> failed;  ///< why the disk takes nothing now
};

/// Any thread may ask for writes; one thread of its own does them, so that the disk never delays the loop.
class JournalWriter {
 public:
  using Write = std::function<Status(store::Store&)>;
  using OnKept = std::function<void(const Status&)>;

  /// `store` must outlive it and is used by its thread alone.
  explicit JournalWriter(store::Store& store);
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;
  ~JournalWriter() { finish(); }

  /// Writes after what was asked for before. `on_kept` is called when this and all before it is on the disk, with the
  /// error where the store refused it, and with an error as soon as the disk takes nothing; it is written later then,
  /// without another report. Either may be empty.
  void write(Write write, OnKept on_kept);
  /// Writes before anything that waits; never dropped.
  void write_first(Write write, OnKept on_kept);
  void set_watch(JournalWatch watch);
  [[nodiscard]] JournalHealth health() const;
  /// Writes what is waiting, tried once, then ends; harmless when repeated. What is asked for later is not written.
  void finish();

 private:
  struct Entry {
    Write write;
    OnKept on_kept;
  };
  /// What is written at once.
  struct Batch {
    std::vector<Entry> first;  ///< of write_first()
    std::vector<Entry> rest;
    std::vector<Status> outcomes;  ///< of each, in this order
  };

  void enqueue(std::deque<Entry>& queue, std::size_t most, Entry entry);
  void drop_oldest(std::deque<Entry>& queue);
  void work();
  [[nodiscard]] bool wait_for_work(std::unique_lock<std::mutex>& lock);
  [[nodiscard]] Batch take_batch();
  [[nodiscard]] Status write_all(Batch& batch);
  void attempt(std::unique_lock<std::mutex>& lock);
  void report_kept(Batch& batch, bool recovered);
  void report_failing(std::unique_lock<std::mutex>& lock);
  void note_lost(const Error& error);

  store::Store& store_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Entry> first_;
  std::deque<Entry> waiting_;
  std::vector<OnKept> dropped_callbacks_;  ///< of records that were dropped
  JournalWatch watch_;
  std::optional<Error> failure_;  ///< while the disk takes nothing
  std::chrono::steady_clock::time_point retry_at_;
  bool unreported_ = false;  ///< something was asked for since the failure was reported
  std::uint64_t dropped_ = 0;
  bool loss_reported_ = false;
  bool quit_ = false;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace seeker::app
