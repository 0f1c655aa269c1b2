// Missions over a link that breaks again and again, in every way there is. SEEKER_FAULTS says how often (default 30).

#include <atomic>
#include <future>
#include <iostream>

#include "common/files/files.hpp"
#include "server/store/map_file.hpp"
#include "tests/integration/link/follower.hpp"
#include "tests/integration/link/linked_robot.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/net/chaos_proxy.hpp"
#include "tests/support/process.hpp"
#include "tests/system/simulated_robot.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeed = 20;
constexpr double kSpeed = 20.0;

int faults() { return number_from_environment("SEEKER_FAULTS", 30); }

/// A silent side is given up soon, so that many faults fit into a test.
server_net::ServerParams impatient() {
  server_net::ServerParams params = on_port(0);
  params.heartbeat = milliseconds(100);
  params.lost_after = milliseconds(600);
  params.session.hello_timeout = milliseconds(600);
  return params;
}

class LinkFaults : public ::testing::Test {
 protected:
  LinkFaults() {
    std::cout << "seed " << kSeed << ", " << faults() << " faults\n";
    EXPECT_TRUE(reference_.connected() && reference_.settle());
    EXPECT_TRUE(impaired_.connected() && impaired_.settle());
    ledger_.begin();
  }

  [[nodiscard]] rpc::ClientParams params(const std::string& name) {
    rpc::ClientParams p;
    p.client_name = name;
    p.heartbeat = milliseconds(100);
    p.connect_timeout = kPatience;
    p.call_timeout = milliseconds(500);
    p.reconnect.first_delay = milliseconds(5);
    p.reconnect.max_delay = milliseconds(50);
    p.on_link = [this, name](const rpc::LinkEvent& event) {
      lost_ += name == "operator" && event.state == rpc::LinkState::kLost ? 1 : 0;
    };
    return p;
  }

  /// The calls are on their way when the fault comes, or come into it.
  void one_fault(int k) {
    const Trouble trouble = kTroubles.at(rng_.below(kTroubles.size()));
    SCOPED_TRACE("fault " + std::to_string(k) + ", " + std::string(to_string(trouble)));
    proxy_.impair(random_impairment(trouble, rng_));
    auto start = ask_for_mission();
    auto upload = rng_.below(3) == 0 ? ask_for_upload("map-" + std::to_string(k)) : std::nullopt;
    // Half of those that only new connections feel meet one that has to be made anew.
    if (rng_.below(2) == 0) {
      proxy_.cut();
    }
    robot_.set_room(rng_.uniform(4.0, 12.0));
    constexpr std::uint64_t kMostItems = 20;
    EXPECT_TRUE(ledger_.wait_items(1 + rng_.below(kMostItems)));
    proxy_.impair({});
    note_mission(start);
    note_upload(upload, "map-" + std::to_string(k));
    EXPECT_TRUE(impaired_.settle());
    EXPECT_TRUE(ledger_.wait_level()) << "the link is whole, the stream is not";
  }

  template <class T>
  using Pending = std::optional<std::future<Result<T>>>;
  /// Begins a call; the client answers it in any case.
  template <class T, class Call>
  [[nodiscard]] static Pending<T> begin(Call&& call) {
    auto promise = std::make_shared<std::promise<Result<T>>>();
    Pending<T> pending = promise->get_future();
    call([promise](Result<T> result) { promise->set_value(std::move(result)); });
    return pending;
  }

  /// One mission after the other; the same again until the robot has said that it knows it.
  [[nodiscard]] Pending<api::MissionAccepted> ask_for_mission() {
    if (!asked_ && ledger_.running()) {
      return std::nullopt;
    }
    if (!asked_) {
      const api::MissionId id = "m-" + std::to_string(++missions_);
      constexpr int kEveryWhichSearches = 4;
      asked_ = missions_ % kEveryWhichSearches == 0 ? search_for("cross") : to_and_fro(id, 1);
      asked_->id = id;
      asked_->link_policy = api::LinkPolicy::kContinue;
      asked_->time_limit = seconds(rng_.uniform(2.0, 15.0));
    }
    return begin<api::MissionAccepted>(
        [&](auto reply) { impaired_.client().start_mission(*asked_, std::move(reply)); });
  }
  void note_mission(Pending<api::MissionAccepted>& pending) {
    if (!pending) {
      return;
    }
    const Result<api::MissionAccepted> answer = pending->get();
    if (!answer && unknown(answer.error())) {
      return;
    }
    const bool was_known = !answer && answer.error().message.find("was used before") != std::string::npos;
    EXPECT_TRUE(answer || was_known) << answer.error().message;
    EXPECT_TRUE(ledger_.wait_begun(asked_->id));
    acknowledged_.push_back(asked_->id);
    asked_.reset();
  }
  [[nodiscard]] Pending<api::MapSummary> ask_for_upload(const std::string& name) {
    store::MapFile file;
    file.origin.name = name;
    file.map = random_map(rng_, {.nodes = 4, .segments = rng_.below(400), .keyframes = rng_.below(60), .beams = 181});
    uploads_[name] = store::encode_map_file(file).value();
    return begin<api::MapSummary>(
        [&](auto reply) { impaired_.client().upload_map({.name = name, .bytes = uploads_[name]}, std::move(reply)); });
  }
  void note_upload(Pending<api::MapSummary>& pending, const std::string& name) {
    if (!pending) {
      return;
    }
    const Result<api::MapSummary> answer = pending->get();
    EXPECT_TRUE(answer || unknown(answer.error())) << answer.error().message;
    if (answer) {
      kept_.insert(name);
    }
  }

  /// The link is whole: what was asked for and not answered is asked again, and the last mission runs to its end.
  void finish() {
    if (asked_) {
      auto again = ask_for_mission();
      note_mission(again);
    }
    EXPECT_FALSE(asked_);
    ASSERT_FALSE(acknowledged_.empty());
    EXPECT_TRUE(ledger_.wait_ended(acknowledged_.back()));
    EXPECT_TRUE(ledger_.wait_level());
  }
  void expect_every_mission_once() {
    const auto begun = ledger_.begun();
    const auto ended = ledger_.ended();
    EXPECT_EQ(begun.size(), acknowledged_.size());
    for (const api::MissionId& id : acknowledged_) {
      EXPECT_TRUE(begun.count(id) > 0 && begun.at(id) == 1) << id;
      EXPECT_TRUE(ended.count(id) > 0 && ended.at(id) == 1) << id;
    }
    EXPECT_EQ(std::set<api::MissionId>(acknowledged_.begin(), acknowledged_.end()).size(), acknowledged_.size());
  }
  void expect_uploads_whole_or_absent() {
    std::set<std::string> there;
    for (const auto& entry : fs::directory_iterator(maps_)) {
      ASSERT_EQ(entry.path().extension(), store::kMapFileEnding) << "half a file: " << entry.path();
      const std::string name = entry.path().stem();
      ASSERT_EQ(uploads_.count(name), 1U) << name;
      constexpr std::size_t kMostBytes = 16UL << 20U;
      EXPECT_EQ(files::read_file(entry.path(), kMostBytes).value(), uploads_[name]) << name;
      there.insert(name);
    }
    for (const std::string& name : kept_) {
      EXPECT_EQ(there.count(name), 1U) << name << " was acknowledged and is not there";
    }
  }

  log::ScopedSink quiet_{[](const log::Line&) {}};
  Rng rng_{kSeed};
  fs::path maps_ = fresh_folder("link-faults");
  LinkedRobot robot_{kSpeed, maps_, impatient()};
  ChaosProxy proxy_{robot_.port(), kSeed};
  Ledger ledger_;
  std::atomic<int> lost_{0};
  Follower reference_{robot_.port(), params("reference"), ledger_, Ledger::kReference};
  Follower impaired_{proxy_.port(),
                     params("operator"),
                     ledger_,
                     Ledger::kImpaired,
                     {{api::Topic::kStatus}, {api::Topic::kScan}, {api::Topic::kTiles}}};
  int missions_ = 0;
  std::optional<api::MissionRequest> asked_;  ///< and not yet known to be accepted
  std::vector<api::MissionId> acknowledged_;
  std::map<std::string, std::vector<std::uint8_t>> uploads_;
  std::set<std::string> kept_;  ///< acknowledged uploads
};

TEST_F(LinkFaults, NoItemNoUploadAndNoMissionIsLostWhateverHappensToTheLink) {
  RecordProperty("seed", static_cast<int>(kSeed));
  for (int k = 0; k < faults() && !HasFailure(); ++k) {
    one_fault(k);
    ASSERT_NE(impaired_.client().link(), rpc::LinkState::kClosed) << "the client has given up";
  }
  finish();
  EXPECT_THAT(ledger_.problems(), ::testing::IsEmpty());
  expect_every_mission_once();
  expect_uploads_whole_or_absent();
  EXPECT_GT(lost_, faults() / 4) << "the faults must break something";
  std::cout << lost_ << " connections lost, " << ledger_.items() << " RELIABLE items, " << acknowledged_.size()
            << " missions, " << kept_.size() << " of " << uploads_.size() << " uploads acknowledged\n";
}

}  // namespace
}  // namespace seeker::testing
