// A robot's program that is killed at any moment, again and again: what it has acknowledged is there, and it comes up
// disarmed. SEEKER_KILLS is the number of kills: a few in `./run test`, 500 in `./run soak kills`.

#include <algorithm>

#include "tests/integration/processes/busy_operator.hpp"
#include "tests/integration/processes/watcher.hpp"
#include "tests/support/environment.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeed = 20261130;
constexpr int kKills = 8;

/// Checkpoints so often that a kill comes while one is written.
const std::vector<std::string> kBusy{"--set", "loop.map.checkpoint_period_s=2", "--set", "loop.map.place_period_s=0.5"};

/// Files below the state folder that nobody would ever look at again.
std::vector<std::string> left_over(const fs::path& state) {
  std::vector<std::string> left;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(state)) {
    const std::string name = entry.path().filename();
    if (name.find(".tmp-") != std::string::npos || name.find(".damaged") != std::string::npos) {
      left.push_back(entry.path());
    }
  }
  return left;
}

/// Anywhere after something was told: so many more things, and then so many turns of a busy wait.
void let_work(ToldLedger& ledger, Rng& rng) {
  constexpr std::uint64_t kMostTold = 80;
  constexpr std::uint64_t kMostTurns = 20'000'000;
  constexpr seconds kSilence{60};
  constexpr seconds kSlow{5};  // a busy machine: it is killed anyway
  EXPECT_TRUE(ledger.wait_for(1, kSilence)) << "the robot tells nothing";
  static_cast<void>(ledger.wait_for(rng.below(kMostTold), kSlow));
  const std::uint64_t turns = rng.below(kMostTurns);
  volatile std::uint64_t turn = 0;
  while (turn < turns) {
    turn = turn + 1;
  }
}

/// What a robot says of itself that was started after a kill.
void expect_safe(const Daemon& daemon, ToldLedger& ledger, const std::optional<std::string>& open) {
  const api::RobotStatus status = Watcher(daemon).status();
  EXPECT_FALSE(status.motors_armed);
  EXPECT_EQ(status.cut_off ? status.cut_off->id : "", open.value_or(""));
  if (const Known estop = ledger.estop(); estop != Known::kInDoubt) {
    EXPECT_EQ(status.estop, estop == Known::kYes);
  }
  ledger.settle(status.estop);
  for (const api::Fault& fault : status.faults) {
    EXPECT_EQ(fault.id.find("journal"), std::string::npos) << fault.message;
  }
  EXPECT_EQ(left_over(daemon.folder() / "state"), std::vector<std::string>());
}

TEST(KillProcesses, WhatWasAcknowledgedIsThereAfterAKillAtAnyMoment) {
  const fs::path folder = fresh_folder("kills");
  const fs::path copy = folder / "copy";
  Rng rng(kSeed);
  RecordProperty("seed", std::to_string(kSeed));
  ToldLedger ledger;
  std::optional<std::string> open;
  const int count = number_from_environment("SEEKER_KILLS", kKills);
  for (int round = 0; round <= count && !::testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE("round " + std::to_string(round) + ", seed " + std::to_string(kSeed));
    Daemon daemon(kBusy, folder);
    expect_safe(daemon, ledger, open);
    if (round == count) {
      break;
    }
    {
      BusyOperator someone(daemon, kSeed + static_cast<std::uint64_t>(round), ledger);
      let_work(ledger, rng);
      daemon.kill();
    }
    // A copy: the next robot opens what the kill has left, not what this look at it has tidied.
    fs::remove_all(copy);
    fs::copy(folder / "state", copy, fs::copy_options::recursive);
    open = ledger.expect_kept(copy, "sim-1");
  }
  std::cout << count << " kills, seed " << kSeed << ": " << ledger.told() << " things told and kept\n";
}

}  // namespace
}  // namespace seeker::testing
