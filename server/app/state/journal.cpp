#include "server/app/state/journal.hpp"

#include <utility>

#include "common/wire/convert.hpp"

namespace seeker::app {
namespace {

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
  auto journal = std::unique_ptr<Journal>(new Journal(std::move(*store), folder));
  const Result<std::uint64_t> highest = journal->store_.highest_detection_id();
  if (!highest) {
    return tl::unexpected<Error>(highest.error());
  }
  journal->highest_detection_id_ = *highest;
  journal->find_unfinished();
  journal->read_estop();
  journal->writer_ = std::make_unique<JournalWriter>(journal->store_);
  return journal;
}

Journal::Journal(store::Store store, std::filesystem::path folder)
    : store_(std::move(store)), folder_(std::move(folder)), lost_(store_.lost()) {}

void Journal::note_lost(const std::string& what) { lost_ += (lost_.empty() ? "" : "; ") + what; }

void Journal::read_estop() {
  const Result<std::optional<store::Blob>> estop = store_.get(kEstopKey);
  // Whether it was latched in a journal that cannot be read nobody knows.
  const bool unknown = !estop || !store_.lost().empty();
  estop_ = unknown || (estop->has_value() && **estop != store::Blob{0});
  if (unknown) {
    note_lost("whether the emergency stop was latched is not known, so it is");
    static_cast<void>(store_.put(kEstopKey, store::Blob{1}));  // until somebody releases it
  }
}

void Journal::find_unfinished() {
  Result<std::optional<store::MissionRecord>> found = store_.unfinished_mission();
  if (!found) {
    note_lost("the mission that was cut off cannot be read: " + found.error().message);
  }
  if (!found || !found->has_value()) {
    return;
  }
  store::MissionRecord& mission = **found;
  unfinished_ = parse_request(mission.request);
  if (unfinished_) {
    open_ = std::move(mission);
    return;
  }
  note_lost("the request of mission '" + mission.id + "', which was cut off, cannot be read: start it anew");
  static_cast<void>(close_cut_off(store_, mission));  // it will never be resumed
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

void Journal::keep_estop(bool engaged, JournalWriter::OnKept on_kept) {
  writer_->write_first(
      [engaged](store::Store& store) {
        return store.put(kEstopKey, store::Blob{static_cast<std::uint8_t>(engaged ? 1 : 0)});
      },
      std::move(on_kept));
}

}  // namespace seeker::app
