/// \file
/// What a robot has told a client, and whether it is on its disk.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/api/robot_api.hpp"
#include "server/store/map_files.hpp"
#include "server/store/store.hpp"

namespace seeker::testing {

/// One thing that a client has asked for, as it is after a kill.
enum class Known : std::uint8_t {
  kYes,      ///< it was acknowledged
  kNo,       ///< that it is undone was acknowledged, or it was never asked for
  kInDoubt,  ///< it was asked for, and no answer has come
};

/// Of one robot over any number of kills. Any thread.
class ToldLedger {
 public:
  void take(const api::UpdatePtr& update) {
    const std::scoped_lock lock(mutex_);
    if (const auto* status = std::get_if<api::MissionStatus>(&update->payload)) {
      if (status->end) {
        ended_[status->id] = std::string(to_string(status->end->outcome));
      }
    } else if (const auto* event = std::get_if<api::Event>(&update->payload)) {
      if (!event->mission.empty()) {
        events_.push_back(*event);
      }
    } else if (const auto* detection = std::get_if<api::Detection>(&update->payload)) {
      detections_[detection->id] = detection->mission;
    }
    count();
  }
  void asked_to_start(const std::string& mission) { set(missions_, mission, Known::kInDoubt); }
  void started(const std::string& mission) { set(missions_, mission, Known::kYes); }
  void not_started(const std::string& mission) { set(missions_, mission, Known::kNo); }
  /// The mission that ran, or none, has ended.
  void stopped(const std::string& mission) {
    const std::scoped_lock lock(mutex_);
    ended_.try_emplace(mission, "");
    count();
  }
  void set_map(const std::string& name, Known known) { set(maps_, name, known); }
  [[nodiscard]] Known map(const std::string& name) const {
    const std::scoped_lock lock(mutex_);
    const auto found = maps_.find(name);
    return found != maps_.end() ? found->second : Known::kNo;
  }
  void set_estop(Known known) {
    const std::scoped_lock lock(mutex_);
    estop_ = known;
    count();
  }
  [[nodiscard]] Known estop() const {
    const std::scoped_lock lock(mutex_);
    return estop_;
  }
  /// After a look at the robot: what was in doubt is known.
  void settle(bool estop) { set_estop(estop ? Known::kYes : Known::kNo); }

  /// Waits until so many more things were told than before the last call; false when that takes too long.
  [[nodiscard]] bool wait_for(std::size_t more, std::chrono::seconds limit) {
    std::unique_lock lock(mutex_);
    const std::size_t wanted = waited_ + more;
    const bool came = told_.wait_for(lock, limit, [&] { return count_ >= wanted; });
    waited_ = count_;
    return came;
  }

  /// Expects all of it in the state folder of robot `robot_id`; nothing has it open. What was looked at is forgotten,
  /// but for missions and maps. The mission that could be resumed.
  std::optional<std::string> expect_kept(const std::filesystem::path& state, const std::string& robot_id) {
    const std::scoped_lock lock(mutex_);
    std::optional<std::string> open;
    const Result<store::Store> journal = store::Store::open(state / robot_id);  // checks its integrity
    EXPECT_TRUE(journal) << journal.error().message;
    if (journal) {
      EXPECT_EQ(journal->lost(), "");
      expect_missions(*journal);
      expect_events(*journal);
      const auto unfinished = journal->unfinished_mission();
      EXPECT_TRUE(unfinished) << unfinished.error().message;
      if (unfinished && *unfinished) {
        open = (*unfinished)->id;
      }
    }
    expect_maps(store::MapFiles(state / "maps"));
    events_.clear();
    detections_.clear();
    return open;
  }
  [[nodiscard]] std::size_t told() const {
    const std::scoped_lock lock(mutex_);
    return count_;
  }

 private:
  void count() {
    ++count_;
    told_.notify_all();
  }
  void set(std::map<std::string, Known>& of, const std::string& name, Known known) {
    const std::scoped_lock lock(mutex_);
    of[name] = known;
    count();
  }

  void expect_missions(const store::Store& journal) {
    for (auto& [id, known] : missions_) {
      const auto record = journal.mission(id);
      ASSERT_TRUE(record) << record.error().message;
      if (known == Known::kYes) {
        ASSERT_TRUE(record->has_value()) << "mission '" << id << "' was accepted and is lost";
      }
      known = record->has_value() ? Known::kYes : Known::kNo;
    }
    for (const auto& [id, outcome] : ended_) {
      const auto record = journal.mission(id);
      ASSERT_TRUE(record && *record && (*record)->end) << "the end of mission '" << id << "' was told and is lost";
      if (!outcome.empty()) {
        EXPECT_EQ((*record)->end->outcome, outcome) << id;
      }
    }
  }
  void expect_events(const store::Store& journal) {
    std::map<std::string, std::multiset<std::string>> kept;
    const auto line = [](std::int64_t stamp_ns, const std::string& kind, const std::string& text) {
      return std::to_string(stamp_ns) + " " + kind + " " + text;
    };
    for (const api::Event& event : events_) {
      if (!kept.contains(event.mission)) {
        const auto events = journal.events(event.mission);
        ASSERT_TRUE(events) << events.error().message;
        for (const store::EventRecord& record : *events) {
          kept[event.mission].insert(line(record.robot_time_ns, record.kind, record.text));
        }
      }
      const std::string told = line(event.stamp.time_since_epoch().count(), event.kind, event.text);
      EXPECT_TRUE(kept[event.mission].contains(told)) << "of '" << event.mission << "', told and lost: " << told;
    }
    for (const auto& [id, mission] : detections_) {
      const auto detections = journal.detections(mission);
      ASSERT_TRUE(detections) << detections.error().message;
      EXPECT_TRUE(std::any_of(detections->begin(), detections->end(), [&](const auto& one) { return one.id == id; }))
          << "detection " << id << " of '" << mission << "' was told and is lost";
    }
  }
  void expect_maps(const store::MapFiles& files) {
    for (auto& [name, known] : maps_) {
      const Result<store::MapFile> map = files.read(name);
      const bool absent = !map && map.error().code == Errc::kNotFound;
      EXPECT_TRUE(map || absent) << "map '" << name << "': " << map.error().message;
      EXPECT_FALSE(absent && known == Known::kYes) << "map '" << name << "' was kept and is lost";
      EXPECT_FALSE(!absent && known == Known::kNo) << "map '" << name << "' was deleted and is back";
      known = absent ? Known::kNo : Known::kYes;
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable told_;
  std::size_t count_ = 0;
  std::size_t waited_ = 0;
  std::map<std::string, Known> missions_;
  std::map<std::string, std::string> ended_;  ///< outcome by mission; empty: told by an answer
  std::vector<api::Event> events_;
  std::map<std::uint64_t, std::string> detections_;  ///< mission by id
  std::map<std::string, Known> maps_;
  Known estop_ = Known::kNo;
};

}  // namespace seeker::testing
