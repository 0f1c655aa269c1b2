// Files in pieces over real sockets that are cut, to a robot in memory.

#include <algorithm>

#include "common/core/rng.hpp"
#include "common/digest/sha256.hpp"
#include "common/rpc/file_transfer.hpp"
#include "tests/integration/net/fixture.hpp"
#include "tests/support/random_bytes.hpp"

namespace seeker::testing {
namespace {

constexpr std::size_t kPiece_bytes = 32UL * 1024;

rpc::FileTransfer::Source source_of(const std::vector<std::uint8_t>& bytes) {
  return [&bytes](std::uint64_t offset, std::size_t most) {
    const std::size_t from = static_cast<std::size_t>(offset);
    const std::size_t count = std::min(most, bytes.size() - from);
    return Result<std::vector<std::uint8_t>>(std::vector<std::uint8_t>(
        bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.begin() + static_cast<std::ptrdiff_t>(from + count)));
  };
}

class TransferTest : public NetTest {
 protected:
  static rpc::TransferParams transfer_params() {
    rpc::TransferParams params;
    params.piece_bytes = kPiece_bytes;
    return params;
  }
  api::FileOffer offer_of(const std::vector<std::uint8_t>& bytes) const {
    return {api::FileKind::kMap, digest::sha256_of(bytes), bytes.size()};
  }
};

TEST_F(TransferTest, ValuesComeBackAsTheRobotHasThem) {
  robot_.edit([](FakeRobotValues& v) { v.map_files["office"] = random_bytes(1, 100'000); });
  start();
  const auto client = connect("tester");
  const std::vector<std::uint8_t> bytes = random_bytes(2, 200'000);
  rpc::FileTransfer transfer(client, transfer_params());
  const Status sent = transfer.send(offer_of(bytes), source_of(bytes));
  ASSERT_TRUE(sent) << sent.error().message;
  const auto taken = transfer.finish({api::FileKind::kMap, digest::sha256_of(bytes), "copy", true, false});
  ASSERT_TRUE(taken) << taken.error().message;
  EXPECT_EQ(taken->map->file_bytes, bytes.size());
  EXPECT_EQ(robot_.values().uploads, (std::vector<api::MapUpload>{{"copy", bytes, true, false}}));
  EXPECT_EQ(robot_.values().piece_bytes, bytes.size());

  const auto about = transfer.look(api::FileKind::kMap, "office");
  ASSERT_TRUE(about) << about.error().message;
  std::vector<std::uint8_t> fetched;
  const Status received = transfer.receive({api::FileKind::kMap, "office", 0, 0, std::nullopt}, *about,
                                           [&](std::uint64_t offset, std::span<const std::uint8_t> piece) {
                                             EXPECT_EQ(offset, fetched.size());
                                             fetched.insert(fetched.end(), piece.begin(), piece.end());
                                             return Status();
                                           });
  ASSERT_TRUE(received) << received.error().message;
  EXPECT_EQ(fetched, robot_.values().map_files["office"]);
}

TEST_F(TransferTest, RefusalsKeepTheirCodeAndEndTheTransferAtOnce) {
  start();
  const auto client = connect("tester");
  const std::vector<std::uint8_t> bytes = random_bytes(3, 1000);
  for (const Errc code : {Errc::kIo, Errc::kTooLarge, Errc::kNotReady, Errc::kInvalidArgument, Errc::kCorrupt}) {
    robot_.edit([&](FakeRobotValues& v) { v.failure = Error{code, "the cause; the remedy"}; });
    rpc::FileTransfer transfer(client, transfer_params());
    EXPECT_EQ(transfer.send(offer_of(bytes), source_of(bytes)).error(), (Error{code, "the cause; the remedy"}));
    EXPECT_EQ(transfer.look(api::FileKind::kMap, "office").error(), (Error{code, "the cause; the remedy"}));
  }
  robot_.edit([](FakeRobotValues& v) { v.failure.reset(); });
  const std::size_t calls = robot_.values().calls.size();
  const auto wrong = ask<api::FilePiece>([&](auto r) {
    client->read_file({api::FileKind::kMap, "../etc", 0, 1, std::nullopt}, r);
  });
  EXPECT_EQ(wrong.error().code, Errc::kInvalidArgument);
  const auto nameless = ask<api::UploadedFile>([&](auto r) {
    client->finish_upload({api::FileKind::kMap, {}, "Not A Name", false, false}, r);
  });
  EXPECT_EQ(nameless.error().code, Errc::kInvalidArgument);
  const std::vector<std::uint8_t> large(api::kMaxFilePiece_bytes + 1);
  EXPECT_EQ(ask<std::uint64_t>([&](auto r) { client->upload_piece({{}, 0, large}, r); }).error().code, Errc::kTooLarge);
  EXPECT_EQ(robot_.values().calls.size(), calls) << "none of them reached the robot";
}

TEST_F(TransferTest, ObserverFetchesButSendsNothing) {
  params_.max_role = api::Role::kObserver;
  robot_.edit([](FakeRobotValues& v) { v.map_files["office"] = {1, 2, 3}; });
  start();
  const auto client = connect("watcher");
  const std::vector<std::uint8_t> bytes = random_bytes(4, 1000);
  rpc::FileTransfer transfer(client, transfer_params());
  EXPECT_EQ(transfer.look(api::FileKind::kMap, "office")->size_bytes, 3U);
  EXPECT_EQ(transfer.send(offer_of(bytes), source_of(bytes)).error().code, Errc::kRefused);
  EXPECT_EQ(transfer.finish({api::FileKind::kMap, {}, "a", false, false}).error().code, Errc::kRefused);
  EXPECT_EQ(ask<std::uint64_t>([&](auto r) { client->upload_piece({{}, 0, {1}}, r); }).error().code, Errc::kRefused);
  EXPECT_TRUE(robot_.values().incoming.empty());
}

TEST_F(TransferTest, UploadThatIsCutAgainAndAgainIsWholeInTheEndAndSendsLittleTwice) {
  constexpr std::uint64_t kSeed = 20'240'611;
  constexpr std::size_t kCuts = 60;
  constexpr std::size_t kHello_bytes = 2000;  // a session that never gets beyond its hello sends no piece
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  start();
  ChaosProxy proxy(port_);
  const auto client = connect("tester", proxy.port());
  const std::vector<std::uint8_t> bytes = random_bytes(kSeed, 2'000'000);
  Rng rng(kSeed);
  std::size_t cuts = 0;
  std::size_t sent_bytes = 0;
  const auto whole = source_of(bytes);
  // With each piece that is sent the moment of the next cut is drawn: in the piece, in its answer, in a hello after it.
  const auto source = [&](std::uint64_t offset, std::size_t most) {
    proxy.impair(cuts < kCuts ? Impairment{.cut_at = kHello_bytes + rng.below(2 * kPiece_bytes)} : Impairment{});
    ++cuts;
    auto piece = whole(offset, most);
    sent_bytes += piece->size();
    return piece;
  };
  rpc::FileTransfer transfer(client, transfer_params());
  const Status sent = transfer.send(offer_of(bytes), source);
  ASSERT_TRUE(sent) << sent.error().message;
  EXPECT_GT(cuts, kCuts) << "the file was too small for this test";
  EXPECT_GT(proxy.connections(), kCuts / 3);
  EXPECT_EQ(robot_.values().incoming[digest::sha256_of(bytes)].bytes, bytes);
  EXPECT_LE(sent_bytes, bytes.size() + proxy.connections() * kPiece_bytes) << "a cut costs at most one piece";
}

TEST_F(TransferTest, DownloadThatIsCutGoesOn) {
  robot_.edit([](FakeRobotValues& v) { v.map_files["office"] = random_bytes(5, 500'000); });
  start();
  ChaosProxy proxy(port_);
  const auto client = connect("tester", proxy.port());
  rpc::FileTransfer transfer(client, transfer_params());
  const auto about = transfer.look(api::FileKind::kMap, "office");
  ASSERT_TRUE(about);
  std::vector<std::uint8_t> fetched;
  int pieces = 0;
  const Status received = transfer.receive({api::FileKind::kMap, "office", 0, 0, std::nullopt}, *about,
                                           [&](std::uint64_t /*offset*/, std::span<const std::uint8_t> piece) {
                                             fetched.insert(fetched.end(), piece.begin(), piece.end());
                                             if (++pieces % 4 == 0) {
                                               proxy.cut();
                                             }
                                             return Status();
                                           });
  ASSERT_TRUE(received) << received.error().message;
  EXPECT_EQ(fetched, robot_.values().map_files["office"]);
  EXPECT_GT(proxy.connections(), 3U);
}

TEST_F(TransferTest, DownloadOfAFileThatChangesMeanwhileIsTold) {
  robot_.edit([](FakeRobotValues& v) { v.map_files["office"] = random_bytes(6, 100'000); });
  start();
  const auto client = connect("tester");
  rpc::FileTransfer transfer(client, transfer_params());
  const auto about = transfer.look(api::FileKind::kMap, "office");
  ASSERT_TRUE(about);
  const Status received =
      transfer.receive({api::FileKind::kMap, "office", 0, 0, std::nullopt}, *about, [&](auto, auto) {
        robot_.edit([](FakeRobotValues& v) { v.map_files["office"].back() ^= 1U; });
        return Status();
      });
  ASSERT_FALSE(received);
  EXPECT_EQ(received.error().code, Errc::kRefused);
}

TEST_F(TransferTest, LinkThatStaysDownIsGivenUp) {
  start();
  ChaosProxy proxy(port_);
  const auto client = connect("tester", proxy.port());
  proxy.impair({.drop = 1.0});
  proxy.cut();
  rpc::TransferParams params = transfer_params();
  params.stall_limit = milliseconds(300);
  const std::vector<std::uint8_t> bytes = random_bytes(7, 1000);
  rpc::FileTransfer transfer(client, params);
  const Status sent = transfer.send(offer_of(bytes), source_of(bytes));
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, Errc::kLinkLost);
  EXPECT_NE(sent.error().message.find("no byte has arrived"), std::string::npos) << sent.error().message;

  rpc::TransferParams interrupted = transfer_params();
  interrupted.broken = [] { return Error{Errc::kCancelled, "interrupted"}; };
  rpc::FileTransfer other(client, interrupted);
  EXPECT_EQ(other.send(offer_of(bytes), source_of(bytes)).error().code, Errc::kCancelled);
}

TEST_F(TransferTest, RobotThatHasForgottenWhatItHadGetsItAgainButNotForEver) {
  start();
  const auto client = connect("tester");
  const std::vector<std::uint8_t> bytes = random_bytes(8, 4 * kPiece_bytes);
  int forgotten = 0;
  const auto forget = [&](int times) {
    return [&, times, source = source_of(bytes)](std::uint64_t offset, std::size_t most) {
      if (offset == 2 * kPiece_bytes && forgotten < times) {
        ++forgotten;
        robot_.edit([](FakeRobotValues& v) { v.incoming.clear(); });
      }
      return source(offset, most);
    };
  };
  rpc::FileTransfer transfer(client, transfer_params());
  EXPECT_TRUE(transfer.send(offer_of(bytes), forget(2)));
  EXPECT_EQ(forgotten, 2);
  robot_.edit([](FakeRobotValues& v) { v.incoming.clear(); });
  forgotten = 0;
  EXPECT_EQ(transfer.send(offer_of(bytes), forget(100)).error().code, Errc::kInternal);
  EXPECT_LT(forgotten, 10);
}

}  // namespace
}  // namespace seeker::testing
