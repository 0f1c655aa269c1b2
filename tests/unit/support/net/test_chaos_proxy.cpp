// The proxy itself: what it promises to do to connections, and that it does nothing else.

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include "tests/support/net/await.hpp"
#include "tests/support/net/chaos_proxy.hpp"
#include "tests/support/random_bytes.hpp"

namespace seeker::testing {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using std::chrono::milliseconds;

/// Both ends of a connection through the proxy, in the hands of the test. Blocking.
class ChaosProxyTest : public ::testing::Test {
 protected:
  [[nodiscard]] tcp::socket connect() {
    tcp::socket socket(io_);
    socket.connect({asio::ip::address_v4::loopback(), proxy_.port()});
    return socket;
  }
  [[nodiscard]] tcp::socket accept() { return acceptor_.accept(); }
  static void send(tcp::socket& socket, const std::string& text) {
    boost::system::error_code ignored;
    asio::write(socket, asio::buffer(text), ignored);
  }
  /// What comes until there are so many bytes or the other side is gone.
  static std::string receive(tcp::socket& socket, std::size_t bytes) {
    std::string text(bytes, '\0');
    boost::system::error_code ended;
    text.resize(asio::read(socket, asio::buffer(text), ended));
    return text;
  }
  static bool has_ended(tcp::socket& socket) { return receive(socket, 1).empty(); }
  template <class Work>
  static Duration time_of(Work&& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::steady_clock::now() - begin;
  }
  [[nodiscard]] static std::string text_of(std::size_t bytes) {
    const std::vector<std::uint8_t> all = random_bytes(3, bytes);
    return {all.begin(), all.end()};
  }

  asio::io_context io_;
  tcp::acceptor acceptor_{io_, {asio::ip::address_v4::loopback(), 0}};
  ChaosProxy proxy_{acceptor_.local_endpoint().port(), 7};
};

TEST_F(ChaosProxyTest, PassesEveryByteBothWaysWhenNothingIsWrong) {
  tcp::socket client = connect();
  tcp::socket server = accept();
  const std::string text = text_of(300'000);
  std::thread sender([&] { send(client, text); });
  EXPECT_EQ(receive(server, text.size()), text);
  sender.join();
  send(server, "answer");
  EXPECT_EQ(receive(client, 6), "answer");
  EXPECT_EQ(proxy_.connections(), 1U);
  EXPECT_EQ(proxy_.open(), 1U);
  client.close();
  EXPECT_TRUE(has_ended(server));
  EXPECT_TRUE(eventually([&] { return proxy_.open() == 0; }));
}

TEST_F(ChaosProxyTest, WhatWasSentBeforeASideLeftStillArrives) {
  proxy_.impair({.delay = milliseconds(20)});
  tcp::socket client = connect();
  tcp::socket server = accept();
  send(client, "last words");
  client.close();
  EXPECT_EQ(receive(server, 100), "last words");
}

TEST_F(ChaosProxyTest, DelayAndJitterTakeTimeAndKeepTheOrder) {
  proxy_.impair({.delay = milliseconds(50), .jitter = milliseconds(20)});
  tcp::socket client = connect();
  tcp::socket server = accept();
  const Duration took = time_of([&] {
    for (const char* word : {"one ", "two ", "three"}) {
      send(client, word);
    }
    EXPECT_EQ(receive(server, 13), "one two three");
    send(server, "back");
    EXPECT_EQ(receive(client, 4), "back");
  });
  EXPECT_GE(took, milliseconds(100)) << "once each way";
}

TEST_F(ChaosProxyTest, BandwidthIsLimited) {
  constexpr double kBytes_per_s = 20'000.0;
  proxy_.impair({.bytes_per_s = kBytes_per_s});
  tcp::socket client = connect();
  tcp::socket server = accept();
  const std::string text = text_of(4000);
  const Duration took = time_of([&] {
    send(client, text);
    EXPECT_EQ(receive(server, text.size()), text);
  });
  EXPECT_GE(to_seconds(took), 4000.0 / kBytes_per_s * 0.99);
}

TEST_F(ChaosProxyTest, ByteAtATimeIsTheSameText) {
  proxy_.impair({.piece = 1});
  tcp::socket client = connect();
  tcp::socket server = accept();
  send(client, "slowly");
  EXPECT_EQ(receive(server, 6), "slowly");
}

TEST_F(ChaosProxyTest, TheConnectionBreaksAtTheByte) {
  proxy_.impair({.cut_at = 10});
  tcp::socket client = connect();
  tcp::socket server = accept();
  send(server, "1234");
  EXPECT_EQ(receive(client, 4), "1234");
  send(client, "567890 and more");
  EXPECT_EQ(receive(server, 100), "567890");
  EXPECT_TRUE(has_ended(client));
}

TEST_F(ChaosProxyTest, AnOpenConnectionBreaksAtTheByteCountedFromNow) {
  tcp::socket client = connect();
  tcp::socket server = accept();
  send(client, "before");
  EXPECT_EQ(receive(server, 6), "before");
  proxy_.impair({.cut_at = 3});
  // The rule is on its way to the proxy's thread: a connection made later is served after it.
  tcp::socket later = connect();
  tcp::socket unused = accept();
  send(client, "after");
  EXPECT_EQ(receive(server, 100), "aft");
}

TEST_F(ChaosProxyTest, OneSideOfAHalfOpenConnectionIsGoneAndTheOtherIsNotTold) {
  int server_gone = 0;
  constexpr int kTimes = 12;
  proxy_.impair({.half_open_at = 4});
  for (int k = 0; k < kTimes; ++k) {
    tcp::socket client = connect();
    tcp::socket server = accept();
    send(client, "hello");
    EXPECT_EQ(receive(server, 4), "hell");
    // Whoever is told is told at once; the other one learns nothing, and nothing that it says arrives.
    client.non_blocking(true);
    server.non_blocking(true);
    std::array<char, 16> bytes{};
    const auto told = [&](tcp::socket& socket) {
      boost::system::error_code error;
      socket.read_some(asio::buffer(bytes), error);
      return error && error != asio::error::would_block;
    };
    bool client_told = false;
    bool server_told = false;
    EXPECT_TRUE(eventually([&] {
      client_told = told(client);
      server_told = told(server);
      return client_told || server_told;
    }));
    EXPECT_NE(client_told, server_told);
    server_gone += server_told ? 1 : 0;
    tcp::socket& left = client_told ? server : client;
    send(left, "is anybody there?");
    EXPECT_FALSE(told(left));
    EXPECT_EQ(proxy_.open(), 1U);
    left.close();
    EXPECT_TRUE(eventually([&] { return proxy_.open() == 0; }));
  }
  EXPECT_GT(server_gone, 0);
  EXPECT_LT(server_gone, kTimes);
}

TEST_F(ChaosProxyTest, NewConnectionsAreDroppedAndOpenOnesStay) {
  tcp::socket open = connect();
  tcp::socket server = accept();
  proxy_.impair({.drop = 1.0});
  tcp::socket refused = connect();
  EXPECT_TRUE(has_ended(refused));
  send(open, "still here");
  EXPECT_EQ(receive(server, 10), "still here");
  proxy_.impair({});
  tcp::socket again = connect();
  tcp::socket served = accept();
  send(again, "in");
  EXPECT_EQ(receive(served, 2), "in");
}

TEST_F(ChaosProxyTest, ANewConnectionIsServedBeforeAnOlderOne) {
  proxy_.impair({.reorder = 1.0, .hold = kPatience});
  tcp::socket older = connect();
  send(older, "older");
  ASSERT_TRUE(eventually([&] { return proxy_.connections() == 1; }));
  tcp::socket newer = connect();
  send(newer, "newer");
  tcp::socket first = accept();
  tcp::socket second = accept();
  EXPECT_EQ(receive(first, 5), "newer");
  EXPECT_EQ(receive(second, 5), "older");
}

TEST_F(ChaosProxyTest, AHeldConnectionIsServedWhenNoOtherComes) {
  proxy_.impair({.reorder = 1.0, .hold = milliseconds(10)});
  tcp::socket alone = connect();
  send(alone, "alone");
  tcp::socket served = accept();
  EXPECT_EQ(receive(served, 5), "alone");
}

TEST_F(ChaosProxyTest, NothingPassesWhileItIsStalled) {
  tcp::socket client = connect();
  tcp::socket server = accept();
  proxy_.impair({.stalled = true});
  tcp::socket later = connect();
  tcp::socket unused = accept();
  send(client, "waits");
  server.non_blocking(true);
  std::array<char, 16> bytes{};
  boost::system::error_code error;
  server.read_some(asio::buffer(bytes), error);
  EXPECT_EQ(error, asio::error::would_block);
  server.non_blocking(false);
  proxy_.impair({});
  EXPECT_EQ(receive(server, 5), "waits");
}

TEST_F(ChaosProxyTest, CutBreaksAllConnectionsAndServesNewOnes) {
  tcp::socket client = connect();
  tcp::socket server = accept();
  proxy_.cut();
  EXPECT_TRUE(has_ended(client));
  EXPECT_TRUE(has_ended(server));
  tcp::socket again = connect();
  tcp::socket served = accept();
  send(again, "in");
  EXPECT_EQ(receive(served, 2), "in");
}

TEST(RandomImpairment, IsOfItsKindAndTheSameForTheSameSeed) {
  for (const Trouble trouble : kTroubles) {
    Rng one(5);
    Rng same(5);
    const Impairment a = random_impairment(trouble, one);
    const Impairment b = random_impairment(trouble, same);
    EXPECT_EQ(a.delay, b.delay);
    EXPECT_EQ(a.cut_at, b.cut_at);
    EXPECT_EQ(a.delay > Duration::zero(), trouble == Trouble::kDelay);
    EXPECT_EQ(a.jitter > Duration::zero(), trouble == Trouble::kJitter);
    EXPECT_EQ(a.drop > 0.0, trouble == Trouble::kDrop);
    EXPECT_EQ(a.reorder > 0.0, trouble == Trouble::kReorder);
    EXPECT_EQ(a.cut_at.has_value(), trouble == Trouble::kCut);
    EXPECT_EQ(a.half_open_at.has_value(), trouble == Trouble::kHalfOpen);
    EXPECT_EQ(a.piece > 0, trouble == Trouble::kPieces);
    EXPECT_EQ(a.bytes_per_s > 0.0, trouble == Trouble::kBandwidth);
    EXPECT_EQ(a.stalled, trouble == Trouble::kStall);
    EXPECT_FALSE(to_string(trouble).empty());
  }
}

}  // namespace
}  // namespace seeker::testing
