#include "server/store/store.hpp"

#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include "common/core/rng.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

constexpr std::int64_t kLate_ns = std::numeric_limits<std::int64_t>::max();

MissionRecord mission_named(const std::string& id) { return {id, "search", Blob{0, 1, 255}, 42, std::nullopt}; }

EventRecord event_of(const std::string& mission, std::uint64_t sequence) {
  return {mission, sequence, 1000, 10, "INFO", "cell-searched", "cell (1, 2) searched"};
}

/// Opens; a failure fails the test with its sentence.
Store open_or_die(const std::filesystem::path& folder) {
  Result<Store> store = Store::open(folder);
  if (!store) {
    ADD_FAILURE() << store.error().message;
    std::abort();
  }
  return std::move(*store);
}

/// Runs SQL on the file behind the store's back.
void tamper(const std::filesystem::path& folder, const char* sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "seeker.db").c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
  sqlite3_close(database);
}

TEST(Store, EverythingIsThereAfterReopening) {
  const TemporaryFolder folder;
  MissionRecord ended = mission_named("first");
  const EventRecord outside{"", 7, -5, std::nullopt, "WARNING", "link-lost", "no client; \"stop\" ''"};
  const DetectionRecord detection{9, "first", "cross", kLate_ns, Blob(1000, 3)};
  {
    Store store = open_or_die(folder.path() / "deep" / "er");
    ASSERT_TRUE(store.begin_mission(ended));
    ended.end = MissionEndRecord{77, "TARGET_FOUND", "the cross was seen", ""};
    ASSERT_TRUE(store.end_mission("first", *ended.end));
    ASSERT_TRUE(store.begin_mission(mission_named("second")));
    ASSERT_TRUE(store.record_event(outside));
    ASSERT_TRUE(store.record_event(event_of("first", 2)));
    ASSERT_TRUE(store.record_event(event_of("first", 1)));
    ASSERT_TRUE(store.save_detection(detection));
    ASSERT_TRUE(store.put("map_epoch", Blob{4}));
    ASSERT_TRUE(store.put("empty", Blob{}));
  }
  const Store store = open_or_die(folder.path() / "deep" / "er");
  EXPECT_EQ(store.mission("first").value(), ended);
  EXPECT_EQ(store.mission("third").value(), std::nullopt);
  EXPECT_EQ(store.missions(10).value(), (std::vector{mission_named("second"), ended}));
  EXPECT_EQ(store.missions(1).value(), (std::vector{mission_named("second")}));
  EXPECT_EQ(store.unfinished_mission().value(), mission_named("second"));
  EXPECT_EQ(store.events("first").value(), (std::vector{event_of("first", 1), event_of("first", 2)}));
  EXPECT_EQ(store.events("").value(), std::vector{outside});
  EXPECT_EQ(store.detections("first").value(), std::vector{detection});
  EXPECT_EQ(store.highest_detection_id().value(), 9U);
  EXPECT_EQ(store.get("map_epoch").value(), Blob{4});
  EXPECT_EQ(store.get("empty").value(), Blob{});
  EXPECT_EQ(store.get("never").value(), std::nullopt);
}

TEST(Store, EndingAMissionLeavesNothingUnfinished) {
  const TemporaryFolder folder;
  Store store = open_or_die(folder.path());
  EXPECT_EQ(store.unfinished_mission().value(), std::nullopt);
  ASSERT_TRUE(store.begin_mission(mission_named("a")));
  ASSERT_TRUE(store.end_mission("a", {2, "OPERATOR", "stopped", ""}));
  EXPECT_EQ(store.unfinished_mission().value(), std::nullopt);
  ASSERT_TRUE(store.begin_mission(mission_named("a")));
  EXPECT_EQ(store.unfinished_mission().value(), mission_named("a"));
}

TEST(Store, AMissionThatGoesOnKeepsItsEventsAndAnotherOfItsNameHasNone) {
  const TemporaryFolder folder;
  Store store = open_or_die(folder.path());
  ASSERT_TRUE(store.begin_mission(mission_named("a")));
  EXPECT_EQ(store.highest_event("a").value(), 0U);
  ASSERT_TRUE(store.record_event(event_of("a", 1)));
  ASSERT_TRUE(store.record_event(event_of("a", 2)));
  ASSERT_TRUE(store.begin_mission(mission_named("a")));
  EXPECT_EQ(store.highest_event("a").value(), 2U);
  ASSERT_TRUE(store.end_mission("a", {2, "OPERATOR", "stopped", ""}));
  ASSERT_TRUE(store.begin_mission(mission_named("a")));
  EXPECT_TRUE(store.events("a").value().empty());
}

TEST(Store, UnknownMissionAndEmptyIdAreRefused) {
  const TemporaryFolder folder;
  Store store = open_or_die(folder.path());
  EXPECT_EQ(store.end_mission("ghost", {}).error().code, Errc::kNotFound);
  EXPECT_EQ(store.begin_mission(mission_named("")).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(store.put("", {}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(store.put("big", Blob(kMaxBlob_bytes + 1)).error().code, Errc::kTooLarge);
}

TEST(Store, BatchWithOneBadEventWritesNone) {
  const TemporaryFolder folder;
  Store store = open_or_die(folder.path());
  std::vector<EventRecord> events{event_of("m", 1), event_of("m", 2)};
  events[1].text.assign(kMaxText_bytes + 1, 'x');
  EXPECT_EQ(store.record_events(events).error().code, Errc::kTooLarge);
  EXPECT_TRUE(store.events("m").value().empty());
  events[1].text = "short";
  ASSERT_TRUE(store.record_events(events));
  EXPECT_EQ(store.events("m").value(), events);
}

TEST(Store, NewerVersionIsRefusedWithBothVersionsAndLeftAlone) {
  const TemporaryFolder folder;
  { const Store store = open_or_die(folder.path()); }
  tamper(folder.path(), "PRAGMA user_version = 12");
  const Result<Store> refused = Store::open(folder.path());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kUnsupportedVersion);
  EXPECT_THAT(refused.error().message, HasSubstr("version 12"));
  EXPECT_THAT(refused.error().message, HasSubstr("up to 1;"));
  tamper(folder.path(), "PRAGMA user_version = 1");
  EXPECT_TRUE(Store::open(folder.path()));
}

TEST(Store, DatabaseOfAnotherProgramIsRefused) {
  const TemporaryFolder folder;
  tamper(folder.path(), "CREATE TABLE recipes (id INTEGER)");
  const Result<Store> refused = Store::open(folder.path());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kInvalidArgument);
}

TEST(Store, DamagedFileIsKeptAsideAndAnEmptyOneBegunWhichIsTold) {
  const TemporaryFolder folder;
  const std::string garbage(8192, 'g');
  for (int round = 1; round <= 2; ++round) {
    std::ofstream(folder.path() / "seeker.db", std::ios::binary) << garbage;
    const Store store = open_or_die(folder.path());
    const std::filesystem::path kept = folder.path() / ("seeker.db.damaged-" + std::to_string(round));
    EXPECT_THAT(store.lost(), HasSubstr(kept.string()));
    EXPECT_TRUE(store.missions(1).value().empty());
    std::ifstream in(kept, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), garbage);
  }
}

TEST(Store, DamageInsideATableIsFoundAtOpening) {
  const TemporaryFolder folder;
  {
    Store store = open_or_die(folder.path());
    for (std::uint64_t i = 0; i < 500; ++i) {
      ASSERT_TRUE(store.record_event(event_of("m", i)));
    }
  }
  const std::filesystem::path file = folder.path() / "seeker.db";
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(file));
  {
    std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
    out.seekp(size / 2 / 4096 * 4096);
    out << std::string(4096, '\xa5');
  }
  {
    const Store store = open_or_die(folder.path());
    EXPECT_THAT(store.lost(), HasSubstr("was damaged"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "seeker.db.damaged-1"));
  }
  EXPECT_EQ(open_or_die(folder.path()).lost(), "") << "it is told once";
}

TEST(Store, FileThatWasEmptiedIsTold) {
  const TemporaryFolder folder;
  { ASSERT_TRUE(open_or_die(folder.path()).begin_mission(mission_named("a"))); }
  std::filesystem::resize_file(folder.path() / "seeker.db", 0);
  EXPECT_THAT(open_or_die(folder.path()).lost(), HasSubstr("was found empty"));
}

/// How a flipped bit or a cut reaches a file: at a random place.
void damage(const std::filesystem::path& file, Rng& rng) {
  const std::uint64_t at = rng.below(std::filesystem::file_size(file));
  if (rng.below(4) == 0) {
    std::filesystem::resize_file(file, at);
    return;
  }
  std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
  bytes.seekg(static_cast<std::streamoff>(at));
  const int byte = bytes.get();
  bytes.seekp(static_cast<std::streamoff>(at));
  bytes.put(static_cast<char>(static_cast<std::uint64_t>(byte) ^ (std::uint64_t{1} << rng.below(8))));
}

TEST(Store, FileThatIsDamagedAnywhereOpensOrSaysWhatItLost) {
  constexpr std::uint64_t kDamageSeed = 20261129;
  constexpr int kRounds = 300;
  constexpr std::uint64_t kMissions = 40;
  Rng rng(kDamageSeed);
  const TemporaryFolder whole;
  {
    Store store = open_or_die(whole.path());
    for (std::uint64_t k = 0; k < kMissions; ++k) {
      ASSERT_TRUE(store.begin_mission(mission_named("m" + std::to_string(k))));
      ASSERT_TRUE(store.record_event(event_of("m" + std::to_string(k), 1)));
    }
  }
  int told = 0;
  for (int round = 0; round < kRounds; ++round) {
    const TemporaryFolder folder;
    std::filesystem::copy(whole.path() / "seeker.db", folder.path() / "seeker.db");
    damage(folder.path() / "seeker.db", rng);
    const Result<Store> store = Store::open(folder.path());
    if (!store) {
      EXPECT_THAT(store.error().message, HasSubstr("seeker.db")) << "round " << round;
      EXPECT_THAT(store.error().message, HasSubstr(";")) << "round " << round << ": a remedy";
      continue;
    }
    const auto missions = store->missions(2 * kMissions);
    const bool all = missions && missions->size() == kMissions;
    EXPECT_TRUE(all || !store->lost().empty() || !missions) << "round " << round << ", seed " << kDamageSeed;
    static_cast<void>(store->unfinished_mission());
    told += store->lost().empty() ? 0 : 1;
  }
  EXPECT_GT(told, kRounds / 10);
}

TEST(Store, SecondProgramOnTheSameFolderIsRefused) {
  const TemporaryFolder folder;
  const Store store = open_or_die(folder.path());
  const Result<Store> second = Store::open(folder.path());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kBusy);
}

TEST(Store, FolderThatCannotBeMadeIsRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "in the way";
  for (const char* place : {"file", "file/below"}) {
    const Result<Store> refused = Store::open(folder.path() / place);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Errc::kIo);
    EXPECT_THAT(refused.error().message, HasSubstr("--state"));
  }
}

/// Lets files of this process grow to `bytes` only, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    EXPECT_EQ(getrlimit(RLIMIT_FSIZE, &before_), 0);
    const rlimit limit{bytes, before_.rlim_max};
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    static_cast<void>(std::signal(SIGXFSZ, handler_));
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Store, WhatIsWrittenTogetherIsThereOrNotAndACallThatFailsUndoesOnlyItself) {
  const TemporaryFolder folder;
  Store store = open_or_die(folder.path());
  EXPECT_TRUE(store.together([&]() -> Status {
    EXPECT_TRUE(store.begin_mission(mission_named("a")));
    EXPECT_FALSE(store.end_mission("unknown", {}));
    return store.record_event(event_of("a", 1));
  }));
  EXPECT_EQ(store.events("a").value().size(), 1U);
  EXPECT_FALSE(store.together([&]() -> Status {
    EXPECT_TRUE(store.record_event(event_of("a", 2)));
    return fail(Errc::kIo, "the disk");
  }));
  EXPECT_EQ(store.events("a").value().size(), 1U);
}

TEST(Store, FullDiskIsATypedErrorAndKeepsWhatWasWritten) {
  const TemporaryFolder folder;
  Store store = open_or_die(folder.path());
  ASSERT_TRUE(store.put("small", Blob{1}));
  {
    const FileSizeLimit limit(rlim_t{256} << 10U);
    const Status status = store.put("large", Blob(std::size_t{1} << 20U, 5));
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, Errc::kIo);
  }
  EXPECT_EQ(store.get("small").value(), Blob{1});
  EXPECT_EQ(store.get("large").value(), std::nullopt);
  EXPECT_TRUE(store.put("large", Blob(std::size_t{1} << 20U, 5)));
}

}  // namespace
}  // namespace seeker::store
