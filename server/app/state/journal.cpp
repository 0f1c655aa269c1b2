#include "server/app/state/journal.hpp"

#include <utility>

#include "common/wire/convert.hpp"

namespace seeker::app {
namespace {

/// Waiting writes; a disk that is this far behind is not coming back soon.
constexpr std::size_t kMaxWaiting = 10'000;

/// The setting that holds the emergency stop: one byte, 0 when it is released.
constexpr const char* kEstopKey = "estop";

std::int64_t ns(RobotTime time) { return time.time_since_epoch().count(); }

store::Blob to_blob(const google::protobuf::MessageLite& message) {
  store::Blob blob(message.ByteSizeLong());
  message.SerializeWithCachedSizesToArray(blob.data());
  return blob;
}

/// A request as it was stored; nothing where it cannot be read any more.
std::optional<api::MissionRequest> parse_request(const store::Blob& blob) {
  wire::pb::MissionRequest message;
  if (!message.ParseFromArray(blob.data(), static_cast<int>(blob.size()))) {
    return std::nullopt;
  }
  wire::Check check;
  api::MissionRequest request;
  wire::read(message, request, check);
  if (!check.ok() || !api::validate(request)) {
    return std::nullopt;
  }
  return request;
}

/// Of a mission that nobody goes on with.
Status close_cut_off(store::Store& store, const store::MissionRecord& mission) {
  return store.end_mission(
      mission.id, {.ended_ns = mission.started_ns, .outcome = "FAULT", .cause = "the program ended", .remedy = ""});
}

}  // namespace

Result<std::unique_ptr<Journal>> Journal::open(const std::filesystem::path& folder) {
  Result<store::Store> store = store::Store::open(folder);
  if (!store) {
    return tl::unexpected<Error>(store.error());
  }
  auto journal = std::unique_ptr<Journal>(new Journal(std::move(*store)));
  const Result<std::uint64_t> highest = journal->store_.highest_detection_id();
  if (!highest) {
    return tl::unexpected<Error>(highest.error());
  }
  journal->highest_detection_id_ = *highest;
  journal->find_unfinished();
  const Result<std::optional<store::Blob>> estop = journal->store_.get(kEstopKey);
  journal->estop_ = !estop || (estop->has_value() && **estop != store::Blob{0});
  journal->thread_ = std::thread([raw = journal.get()] { raw->work(); });
  return journal;
}

Journal::Journal(store::Store store) : store_(std::move(store)) {}

Journal::~Journal() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Journal::find_unfinished() {
  Result<std::optional<store::UnfinishedMission>> found = store_.unfinished_mission();
  if (!found || !found->has_value()) {
    return;
  }
  store::MissionRecord& mission = (*found)->mission;
  unfinished_ = parse_request(mission.request);
  if (unfinished_) {
    open_ = std::move(mission);
  } else {
    static_cast<void>(close_cut_off(store_, mission));  // a request that cannot be read will never be resumed
  }
}

void Journal::set_on_error(std::function<void(const Error&)> on_error) {
  const std::lock_guard lock(mutex_);
  on_error_ = std::move(on_error);
}

std::uint64_t Journal::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

JournalHealth Journal::health() const {
  const std::lock_guard lock(mutex_);
  return {queue_.size() + urgent_.size(), dropped_, failed_};
}

void Journal::enqueue(Write write) {
  {
    const std::lock_guard lock(mutex_);
    if (queue_.size() >= kMaxWaiting) {
      queue_.pop_front();
      ++dropped_;
    }
    queue_.push_back(std::move(write));
  }
  wake_.notify_one();
}

void Journal::mission_started(const api::MissionRequest& request, RobotTime now) {
  const std::optional<store::MissionRecord> cut_off = std::exchange(open_, std::nullopt);
  if (cut_off && cut_off->id != request.id) {
    enqueue([record = *cut_off](store::Store& store) { return close_cut_off(store, record); });
  }
  // A mission that is resumed takes the place of its own record.
  enqueue([this, request, now](store::Store& store) {
    wire::pb::MissionRequest message;
    wire::write(request, &message);
    const Status begun = store.begin_mission({.id = request.id,
                                              .kind = std::string(api::task_name(request.task)),
                                              .request = to_blob(message),
                                              .started_ns = ns(now),
                                              .end = std::nullopt});
    const Result<std::uint64_t> highest = store.highest_event(request.id);
    events_before_ = highest ? *highest : 0;
    return begun && !highest ? tl::unexpected(highest.error()) : begun;
  });
}

void Journal::mission(const api::MissionStatus& status) {
  if (!status.end) {
    return;
  }
  enqueue([id = status.id, end = *status.end, now = status.updated](store::Store& store) {
    return store.end_mission(id, {.ended_ns = ns(now),
                                  .outcome = std::string(to_string(end.outcome)),
                                  .cause = end.cause,
                                  .remedy = end.remedy});
  });
}

void Journal::event(const api::Event& event) {
  enqueue([this, event](store::Store& store) {
    store::EventRecord record;
    record.mission = event.mission;
    record.sequence = events_before_ + event.sequence;
    record.robot_time_ns = ns(event.stamp);
    if (event.mission_time) {
      record.mission_time_ns = event.mission_time->count();
    }
    record.severity = to_string(event.severity);
    record.kind = event.kind;
    record.text = event.text;
    return store.record_event(record);
  });
}

void Journal::detection(const api::Detection& detection) {
  enqueue([detection](store::Store& store) {
    wire::pb::Detection message;
    wire::write(detection, &message);
    return store.save_detection({.id = detection.id,
                                 .mission = detection.mission,
                                 .target = detection.target,
                                 .stamp_ns = ns(detection.stamp),
                                 .data = to_blob(message)});
  });
}

void Journal::keep_estop(bool engaged, std::function<void(const Status&)> kept) {
  {
    const std::lock_guard lock(mutex_);
    urgent_.emplace_back([engaged, kept = std::move(kept)](store::Store& store) {
      const Status written = store.put(kEstopKey, store::Blob{static_cast<std::uint8_t>(engaged ? 1 : 0)});
      kept(written);
      return written;
    });
  }
  wake_.notify_one();
}

void Journal::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return quit_ || !queue_.empty() || !urgent_.empty(); });
    std::deque<Write>& next = urgent_.empty() ? queue_ : urgent_;
    if (next.empty()) {
      return;
    }
    const Write write = std::move(next.front());
    next.pop_front();
    lock.unlock();
    const Status written = write(store_);
    lock.lock();
    if (!written && !failed_) {
      failed_ = written.error();
    }
    if (!written && !error_reported_ && on_error_) {
      error_reported_ = true;
      on_error_(written.error());
    }
  }
}

}  // namespace seeker::app
