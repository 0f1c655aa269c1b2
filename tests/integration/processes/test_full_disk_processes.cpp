// A robot whose disk is full, and then has space again; and one whose journal is damaged.

#include <csignal>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/integration/processes/small_disk.hpp"
#include "tests/integration/processes/told_ledger.hpp"
#include "tests/integration/processes/watcher.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;

constexpr const char* kDiskFault = "journal-failed";

/// Slow enough that the mission outlives what is done to its disk.
const std::vector<std::string> kSlowSimulation{"--set", "sim.speed=15", "--set", "loop.map.checkpoint_period_s=2"};

/// Hears what the robot tells and puts it into the ledger.
class Listener {
 public:
  Listener(const Daemon& daemon, ToldLedger& ledger) : client_(connect(daemon, "listener")) {
    auto subscription = client_->subscribe(
        {{.topic = api::Topic::kMission}, {.topic = api::Topic::kEvent}, {.topic = api::Topic::kDetection}},
        [this, &ledger](const api::UpdatePtr& update) {
          ledger.take(update);
          if (const auto* event = std::get_if<api::Event>(&update->payload)) {
            const std::scoped_lock lock(mutex_);
            heard_.insert(event->kind + " " + event->text.substr(0, event->text.find(':')));
            changed_.notify_all();
          }
        });
    EXPECT_TRUE(subscription);
    subscription_ = std::move(*subscription);
  }
  /// Forgets what it has heard: a disk that is full takes a little now and then.
  void forget() {
    const std::lock_guard lock(mutex_);
    heard_.clear();
  }
  /// Waits for an event of that kind about that fault.
  [[nodiscard]] bool hears(const std::string& kind, const std::string& fault) {
    constexpr seconds kPatience{60};
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return heard_.contains(kind + " " + fault); });
  }

 private:
  std::shared_ptr<rpc::RobotClient> client_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<std::string> heard_;
  std::unique_ptr<api::Subscription> subscription_;
};

std::optional<api::Fault> fault_of(const api::RobotStatus& status, const std::string& id) {
  const auto found =
      std::find_if(status.faults.begin(), status.faults.end(), [&](const api::Fault& f) { return f.id == id; });
  return found == status.faults.end() ? std::nullopt : std::optional(*found);
}

class FullDisk : public ::testing::Test {
 protected:
  static constexpr std::size_t kDisk_bytes = std::size_t{8} << 20U;

  void SetUp() override {
    if (!disk.mounted()) {
      GTEST_SKIP() << "no disk of its own can be mounted (" << disk.why_not() << "); run it as root";
    }
  }
  /// A mission that runs, and a disk that has taken its beginning and takes no more.
  void explore_until_full(const Daemon& daemon, Listener& listener) {
    Watcher watcher(daemon);
    ASSERT_EQ(seeker(daemon, {"explore", "--strategy", "frontier", "--detach", "--id", "round"}), 0);
    static_cast<void>(watcher.until([](const api::MissionStatus& m) { return m.path_length_m > 0.3; }));
    disk.fill();
    ASSERT_TRUE(listener.hears("fault", kDiskFault));
    const double here_m = watcher.status().mission->path_length_m;
    const api::RobotStatus later =
        watcher.until([&](const api::MissionStatus& m) { return m.end || m.path_length_m > here_m + 0.3; });
    EXPECT_FALSE(later.mission->end) << "a mission that runs goes on: " << later.mission->end->cause;
    const auto fault = fault_of(later, kDiskFault);
    ASSERT_TRUE(fault);
    EXPECT_THAT(fault->message, HasSubstr((folder / "state").string()));
    EXPECT_THAT(fault->remedy, HasSubstr("free space"));
  }

  const fs::path folder = fresh_folder("full_disk");
  const SmallDisk disk{folder / "state", kDisk_bytes};
  std::string output;
};

TEST_F(FullDisk, MissionGoesOnNoNewOneBeginsAndAllIsKeptWhenThereIsSpaceAgain) {
  ToldLedger ledger;
  {
    Daemon daemon(kSlowSimulation, folder);
    Listener listener(daemon, ledger);
    ASSERT_NO_FATAL_FAILURE(explore_until_full(daemon, listener));
    EXPECT_EQ(seeker(daemon, {"map", "save", "now"}, &output), 1) << output;
    EXPECT_THAT(output, HasSubstr("free space"));
    EXPECT_EQ(seeker(daemon, {"stop"}), 0) << "a robot stops with any disk";
    EXPECT_EQ(seeker(daemon, {"goto", "0.5,0"}, &output), 3) << output;
    EXPECT_THAT(output, HasSubstr("free space"));
    EXPECT_NE(seeker(daemon, {"estop"}, &output), 0) << output;
    EXPECT_THAT(output, HasSubstr("latched, but a restart of the robot's program would release it"));
    EXPECT_TRUE(Watcher(daemon).status().estop);
    const bool unrecorded = fault_of(Watcher(daemon).status(), "audit-failed").has_value();
    listener.forget();
    disk.free();
    ASSERT_TRUE(listener.hears("fault-cleared", kDiskFault));
    EXPECT_FALSE(fault_of(Watcher(daemon).status(), kDiskFault));
    ASSERT_EQ(seeker(daemon, {"estop", "--release"}, &output), 0) << output;
    EXPECT_EQ(seeker(daemon, {"goto", "0.5,0", "--detach", "--id", "after"}, &output), 0) << output;
    EXPECT_TRUE(!unrecorded || listener.hears("fault-cleared", "audit-failed"));
    ledger.started("round");
    ledger.started("after");
    daemon.kill();
  }
  EXPECT_EQ(ledger.expect_kept(folder / "state", "sim-1"), "after") << "with all that happened meanwhile";
}

/// A journal that begins its log again has room in the log's file, however full the disk is: uses that up.
void use_up_the_log(const Daemon& daemon) {
  constexpr int kMostWrites = 20'000;
  const auto client = connect(daemon, "writer");
  const auto kept = [&](bool engaged) {
    return rpc::wait<void>([&](auto reply) { client->set_estop(engaged, std::move(reply)); }, seconds(20)).has_value();
  };
  int writes = 0;
  while (kept(writes % 2 == 0) && writes < kMostWrites) {
    ++writes;
  }
  EXPECT_LT(writes, kMostWrites) << "the disk is not full";
  EXPECT_FALSE(kept(false)) << "released, but not kept";
}

TEST_F(FullDisk, ProgramThatStartsOnOneOffersTheMissionAndRefusesOthersUntilThereIsSpace) {
  {
    ToldLedger ledger;
    Daemon daemon(kSlowSimulation, folder);
    Listener listener(daemon, ledger);
    ASSERT_NO_FATAL_FAILURE(explore_until_full(daemon, listener));
    daemon.kill();
  }
  disk.fill();
  const Daemon again(kSlowSimulation, folder);
  ToldLedger ledger;
  Listener listener(again, ledger);
  const api::RobotStatus status = Watcher(again).status();
  EXPECT_FALSE(status.motors_armed);
  ASSERT_TRUE(status.cut_off);
  EXPECT_EQ(status.cut_off->id, "round");
  use_up_the_log(again);
  EXPECT_EQ(seeker(again, {"goto", "0.5,0"}, &output), 3) << output;
  EXPECT_THAT(output, HasSubstr("free space"));
  EXPECT_FALSE(Watcher(again).status().motors_armed) << "the mission that could not be kept has ended";
  listener.forget();
  disk.free();
  ASSERT_TRUE(listener.hears("fault-cleared", kDiskFault));
  EXPECT_EQ(seeker(again, {"goto", "0.5,0"}, &output), 0) << output;
}

TEST(DamagedJournal, RobotComesUpStoppedAndSaysWhatItLost) {
  const fs::path folder = fresh_folder("damaged");
  const fs::path journal = folder / "state" / "sim-1" / "seeker.db";
  {
    Daemon daemon({}, folder);
    ASSERT_EQ(seeker(daemon, {"goto", "0.5,0"}), 0);
    daemon.process->send(SIGTERM);
    ASSERT_EQ(daemon.process->wait(seconds(20)), 0);
  }
  fs::resize_file(journal, fs::file_size(journal) / 2);
  const Daemon again({}, folder);
  EXPECT_THAT(again.process->output(), HasSubstr("seeker.db.damaged-1"));
  const api::RobotStatus status = Watcher(again).status();
  const auto fault = fault_of(status, "journal-lost");
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->message, HasSubstr("seeker.db.damaged-1"));
  EXPECT_TRUE(status.estop) << "nobody knows whether it was latched";
  EXPECT_FALSE(status.motors_armed);
  EXPECT_EQ(seeker(again, {"estop", "--release"}), 0);
  EXPECT_EQ(seeker(again, {"goto", "0.5,0"}), 0);
}

}  // namespace
}  // namespace seeker::testing
