/// \file
/// What the robot remembers over a restart: missions with their journal, events and detections, and small settings.
/// Plain values only: who stores something decides how it is written as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::store {

using Blob = std::vector<std::uint8_t>;

/// Version of the tables this program writes. An older file is brought up to it; a newer one is refused.
inline constexpr std::int64_t kSchemaVersion = 1;
/// Largest blob accepted or handed back.
inline constexpr std::size_t kMaxBlob_bytes = std::size_t{64} << 20U;
/// Largest text accepted in one field.
inline constexpr std::size_t kMaxText_bytes = std::size_t{64} << 10U;

/// How a mission ended. Stamps are robot time in nanoseconds.
struct MissionEndRecord {
  std::int64_t ended_ns = 0;
  std::string outcome;  ///< stable word, e.g. "TARGET_FOUND"
  std::string cause;
  std::string remedy;

  friend bool operator==(const MissionEndRecord&, const MissionEndRecord&) = default;
};

struct MissionRecord {
  std::string id;
  std::string kind;  ///< stable word, e.g. "search"
  Blob request;      ///< as the client sent it
  std::int64_t started_ns = 0;
  std::optional<MissionEndRecord> end;  ///< absent while it runs, and after a crash

  friend bool operator==(const MissionRecord&, const MissionRecord&) = default;
};

struct EventRecord {
  std::string mission;         ///< empty: not part of a mission
  std::uint64_t sequence = 0;  ///< unique in its mission; writing one again replaces it
  std::int64_t robot_time_ns = 0;
  std::optional<std::int64_t> mission_time_ns;  ///< since the mission's start
  std::string severity;
  std::string kind;
  std::string text;

  friend bool operator==(const EventRecord&, const EventRecord&) = default;
};

struct DetectionRecord {
  std::uint64_t id = 0;  ///< never reused; a refined detection is saved again with its id
  std::string mission;
  std::string target;
  std::int64_t stamp_ns = 0;
  Blob data;

  friend bool operator==(const DetectionRecord&, const DetectionRecord&) = default;
};

/// What a mission needs to be resumed: its grid lists and evidence as bytes. Kept compressed, with a checksum.
struct Checkpoint {
  std::int64_t robot_time_ns = 0;
  Blob journal;

  friend bool operator==(const Checkpoint&, const Checkpoint&) = default;
};

/// A mission that has a beginning and no end: the program was killed while it ran.
struct UnfinishedMission {
  MissionRecord mission;
  std::optional<Checkpoint> checkpoint;

  friend bool operator==(const UnfinishedMission&, const UnfinishedMission&) = default;
};

/// The state file `seeker.db` in a folder. One program at a time, one thread at a time. Every call that returns
/// without an error is on the disk: a kill or a power cut afterwards does not undo it, and never leaves half of it.
///
/// Errors of all calls: kIo (full disk, no permission), kCorrupt, kTooLarge, kBusy (another program has it open),
/// kInvalidArgument (empty id).
class Store {
 public:
  /// Opens or creates the store; makes the folder. kUnsupportedVersion: written by a newer program, left as it is.
  /// kCorrupt: the damaged file was moved aside (the message says where to), so that the next open starts afresh.
  [[nodiscard]] static Result<Store> open(const std::filesystem::path& folder);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  /// Notes a mission as running. The same id again replaces its request, start and end, and drops its checkpoint. Where
  /// it had no end it goes on: its events stay. Where it had one this is another mission: those of the old one go.
  [[nodiscard]] Status begin_mission(const MissionRecord& mission);
  /// kNotFound: no such mission. Drops the checkpoint, which nobody needs any more.
  [[nodiscard]] Status end_mission(const std::string& id, const MissionEndRecord& end);
  /// Replaces the mission's checkpoint. kNotFound: no such mission.
  [[nodiscard]] Status save_checkpoint(const std::string& mission, const Checkpoint& checkpoint);
  /// The newest mission without an end.
  [[nodiscard]] Result<std::optional<UnfinishedMission>> unfinished_mission() const;
  [[nodiscard]] Result<std::optional<MissionRecord>> mission(const std::string& id) const;
  /// The newest `limit` missions, newest first.
  [[nodiscard]] Result<std::vector<MissionRecord>> missions(std::size_t limit) const;

  [[nodiscard]] Status record_event(const EventRecord& event);
  /// All of them or none: one write to the disk instead of one each.
  [[nodiscard]] Status record_events(std::span<const EventRecord> events);
  /// Events of a mission by rising sequence.
  [[nodiscard]] Result<std::vector<EventRecord>> events(const std::string& mission) const;
  /// Highest sequence among them, 0 when there are none: a mission that goes on counts from there.
  [[nodiscard]] Result<std::uint64_t> highest_event(const std::string& mission) const;

  [[nodiscard]] Status save_detection(const DetectionRecord& detection);
  /// Detections of a mission by rising id.
  [[nodiscard]] Result<std::vector<DetectionRecord>> detections(const std::string& mission) const;
  /// Highest id ever saved, 0 when there is none: the next detection gets a higher one.
  [[nodiscard]] Result<std::uint64_t> highest_detection_id() const;

  [[nodiscard]] Status put(const std::string& key, const Blob& value);
  /// Nothing for a key that was never put.
  [[nodiscard]] Result<std::optional<Blob>> get(const std::string& key) const;

 private:
  struct Body;
  explicit Store(std::unique_ptr<Body> body);
  std::unique_ptr<Body> body_;
};

}  // namespace seeker::store
