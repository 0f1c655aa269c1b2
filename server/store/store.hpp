/// \file
/// State of a robot that survives a restart: missions with their journal, events and detections, and small settings.
/// The store holds plain values; the caller decides how a value is written as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::store {

using Blob = std::vector<std::uint8_t>;

/// Version of the tables this program writes. An older file is upgraded; a newer one is refused.
inline constexpr std::int64_t kSchemaVersion = 1;
/// Largest blob that is stored or returned.
inline constexpr std::size_t kMaxBlob_bytes = std::size_t{64} << 20U;
/// Largest text in one field.
inline constexpr std::size_t kMaxText_bytes = std::size_t{64} << 10U;

/// The end of a mission. Stamps are robot time in nanoseconds.
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

/// The state file `seeker.db` in a folder. One program at a time, one thread at a time. Every call that returns
/// without an error is on the disk: a kill or a power cut afterwards does not undo it, and never leaves half of it.
///
/// Errors of all calls: kIo (full disk, no permission), kCorrupt, kTooLarge, kBusy (another program has it open),
/// kInvalidArgument (empty id).
class Store {
 public:
  /// Opens or creates the store; makes the folder. A damaged file is moved aside and an empty one made: lost() says so.
  /// kUnsupportedVersion: written by a newer program, left as it is. kCorrupt: damaged, and it cannot be moved.
  [[nodiscard]] static Result<Store> open(const std::filesystem::path& folder);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  /// A sentence about the damaged file that was found in place of this one, and where it is now; empty: there was none.
  [[nodiscard]] const std::string& lost() const;

  /// Does several of the calls below as one write to the disk: a kill leaves all of them or none. A call that fails
  /// undoes only itself; an error that `work` returns undoes all.
  [[nodiscard]] Status together(const std::function<Status()>& work);

  /// Records a mission as running. A known id replaces its request, start and end. If that mission had no end, it
  /// is continued and keeps its events; if it had one, this is another mission and they are deleted.
  [[nodiscard]] Status begin_mission(const MissionRecord& mission);
  /// Records the end of a mission. kNotFound: no such mission.
  [[nodiscard]] Status end_mission(const std::string& id, const MissionEndRecord& end);
  /// The newest mission without an end: the program ended while it ran.
  [[nodiscard]] Result<std::optional<MissionRecord>> unfinished_mission() const;
  [[nodiscard]] Result<std::optional<MissionRecord>> mission(const std::string& id) const;
  /// The newest `limit` missions, newest first.
  [[nodiscard]] Result<std::vector<MissionRecord>> missions(std::size_t limit) const;

  [[nodiscard]] Status record_event(const EventRecord& event);
  /// Records all events or none, in one write to the disk.
  [[nodiscard]] Status record_events(std::span<const EventRecord> events);
  /// Events of a mission by rising sequence.
  [[nodiscard]] Result<std::vector<EventRecord>> events(const std::string& mission) const;
  /// Highest sequence among the events of a mission, 0 when there are none; a resumed mission counts from there.
  [[nodiscard]] Result<std::uint64_t> highest_event(const std::string& mission) const;

  [[nodiscard]] Status save_detection(const DetectionRecord& detection);
  /// Detections of a mission by rising id.
  [[nodiscard]] Result<std::vector<DetectionRecord>> detections(const std::string& mission) const;
  /// Highest id ever saved, 0 when there is none: the next detection gets a higher one.
  [[nodiscard]] Result<std::uint64_t> highest_detection_id() const;

  [[nodiscard]] Status put(const std::string& key, const Blob& value);
  /// Reads a setting; std::nullopt for a key that was never put.
  [[nodiscard]] Result<std::optional<Blob>> get(const std::string& key) const;

 private:
  struct Body;
  explicit Store(std::unique_ptr<Body> body);
  std::unique_ptr<Body> body_;
};

}  // namespace seeker::store
