#include "server/app/state/journal_writer.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace seeker::app {
namespace {

/// Waiting records; a disk that is this far behind is not coming back soon.
constexpr std::size_t kMaxWaiting = 10'000;
/// Records in one write to the disk: an emergency stop waits for one such write at most.
constexpr std::size_t kMaxBatch = 256;
/// How long a disk that takes nothing is left alone.
constexpr std::chrono::milliseconds kRetryPeriod{500};

/// Whether the disk is to blame, so that the same record may be written later.
bool of_the_disk(const Error& error) {
  return error.code == Errc::kIo || error.code == Errc::kBusy || error.code == Errc::kCorrupt;
}

Status closed() { return fail(Errc::kNotReady, "the journal is closed; the program ends"); }

}  // namespace

JournalWriter::JournalWriter(store::Store& store) : store_(store), thread_([this] { work(); }) {}

void JournalWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void JournalWriter::set_watch(JournalWatch watch) {
  const std::lock_guard lock(mutex_);
  watch_ = std::move(watch);
}

JournalHealth JournalWriter::health() const {
  const std::lock_guard lock(mutex_);
  return {first_.size() + waiting_.size(), dropped_, failure_};
}

void JournalWriter::write(Write write, OnKept on_kept) {
  enqueue(waiting_, kMaxWaiting, {std::move(write), std::move(on_kept)});
}

void JournalWriter::write_first(Write write, OnKept on_kept) {
  enqueue(first_, std::numeric_limits<std::size_t>::max(), {std::move(write), std::move(on_kept)});
}

void JournalWriter::enqueue(std::deque<Entry>& queue, std::size_t most, Entry entry) {
  std::unique_lock lock(mutex_);
  if (ended_) {
    lock.unlock();
    if (entry.on_kept) {
      entry.on_kept(closed());
    }
    return;
  }
  if (queue.size() >= most) {
    drop_oldest(queue);
  }
  queue.push_back(std::move(entry));
  unreported_ = true;
  lock.unlock();
  wake_.notify_one();
}

void JournalWriter::drop_oldest(std::deque<Entry>& queue) {
  if (queue.front().on_kept) {
    dropped_callbacks_.push_back(std::move(queue.front().on_kept));
  }
  dropped_ += queue.front().write ? 1 : 0;
  queue.pop_front();
}

void JournalWriter::work() {
  std::unique_lock lock(mutex_);
  while (wait_for_work(lock)) {
    if (failure_ && !quit_ && std::chrono::steady_clock::now() < retry_at_) {
      report_failing(lock);
    } else {
      attempt(lock);
    }
  }
  ended_ = true;
}

/// False at the end: all is written, or the last attempt has failed.
bool JournalWriter::wait_for_work(std::unique_lock<std::mutex>& lock) {
  const auto waits = [this] { return !first_.empty() || !waiting_.empty(); };
  if (failure_ && !quit_) {
    wake_.wait_until(lock, retry_at_, [this] { return quit_ || unreported_; });
    return true;
  }
  wake_.wait(lock, [&] { return quit_ || waits(); });
  return waits();
}

JournalWriter::Batch JournalWriter::take_batch() {
  Batch batch;
  const auto take = [](std::deque<Entry>& from, std::size_t most, std::vector<Entry>& into) {
    const auto end = from.begin() + static_cast<std::ptrdiff_t>(std::min(from.size(), most));
    std::move(from.begin(), end, std::back_inserter(into));
    from.erase(from.begin(), end);
  };
  take(first_, first_.size(), batch.first);
  take(waiting_, kMaxBatch, batch.rest);
  return batch;
}

/// Error: nothing of the batch is on the disk. A record that the store refuses keeps no other from being written.
Status JournalWriter::write_all(Batch& batch) {
  batch.outcomes.clear();
  return store_.together([&]() -> Status {
    for (const std::vector<Entry>* part : {&batch.first, &batch.rest}) {
      for (const Entry& entry : *part) {
        batch.outcomes.push_back(entry.write ? entry.write(store_) : Status());
        if (const Status& last = batch.outcomes.back(); !last && of_the_disk(last.error())) {
          return last;
        }
      }
    }
    return {};
  });
}

void JournalWriter::attempt(std::unique_lock<std::mutex>& lock) {
  Batch batch = take_batch();
  std::vector<OnKept> dropped = std::exchange(dropped_callbacks_, {});
  const bool full = dropped_ > 0;
  const bool last = quit_;  // the end may be asked for meanwhile: then another attempt follows
  lock.unlock();
  for (const OnKept& on_kept : dropped) {
    on_kept(fail(Errc::kIo, "the disk does not follow"));
  }
  if (full) {
    note_lost({Errc::kIo, "more than " + std::to_string(kMaxWaiting) + " records were waiting for the disk"});
  }
  const Status written = write_all(batch);
  if (written) {
    const bool recovered = failure_.has_value();
    report_kept(batch, recovered);
    lock.lock();
    failure_.reset();
    return;
  }
  lock.lock();
  first_.insert(first_.begin(), std::make_move_iterator(batch.first.begin()),
                std::make_move_iterator(batch.first.end()));
  waiting_.insert(waiting_.begin(), std::make_move_iterator(batch.rest.begin()),
                  std::make_move_iterator(batch.rest.end()));
  const bool new_failure = !failure_.has_value();
  failure_ = written.error();
  retry_at_ = std::chrono::steady_clock::now() + kRetryPeriod;
  const auto failing = watch_.failing;
  if (new_failure && failing) {
    lock.unlock();
    failing(written.error());
    lock.lock();
  }
  ended_ = last;  // before the lock is given up: what comes now is refused, not forgotten
  report_failing(lock);
  if (last) {
    first_.clear();
    waiting_.clear();
  }
}

void JournalWriter::report_kept(Batch& batch, bool recovered) {
  std::size_t k = 0;
  for (const std::vector<Entry>* part : {&batch.first, &batch.rest}) {
    for (const Entry& entry : *part) {
      const Status& outcome = batch.outcomes[k++];
      if (!outcome) {
        note_lost(outcome.error());
      }
      if (entry.on_kept) {
        entry.on_kept(outcome);
      }
    }
  }
  if (recovered) {
    std::unique_lock lock(mutex_);
    const auto writes_again = watch_.writes_again;
    lock.unlock();
    if (writes_again) {
      writes_again();
    }
  }
}

/// What is waiting keeps its place; whoever wants to know when it is written knows now that it is not.
void JournalWriter::report_failing(std::unique_lock<std::mutex>& lock) {
  std::vector<OnKept> callbacks = std::exchange(dropped_callbacks_, {});
  for (std::deque<Entry>* queue : {&first_, &waiting_}) {
    for (Entry& entry : *queue) {
      if (entry.on_kept) {
        callbacks.push_back(std::exchange(entry.on_kept, nullptr));
      }
    }
  }
  std::erase_if(waiting_, [](const Entry& entry) { return !entry.write; });
  unreported_ = false;
  const Status failure = tl::unexpected<Error>(*failure_);
  lock.unlock();
  for (const OnKept& on_kept : callbacks) {
    on_kept(failure);
  }
  lock.lock();
}

void JournalWriter::note_lost(const Error& error) {
  std::unique_lock lock(mutex_);
  const auto lost = watch_.lost;
  if (std::exchange(loss_reported_, loss_reported_ || lost != nullptr)) {
    return;
  }
  lock.unlock();
  if (lost) {
    lost(error);
  }
}

}  // namespace seeker::app
