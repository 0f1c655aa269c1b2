/// \file
/// One connection through the chaos proxy.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/core/rng.hpp"
#include "tests/support/net/impairment.hpp"

namespace seeker::testing {

/// Two sockets, and the bytes on their way between them. Runs on the io_context's single thread.
class ChaosPair : public std::enable_shared_from_this<ChaosPair> {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  /// `rules` and `rng` are the proxy's and outlive the pair; `number` counts its connections from 1.
  ChaosPair(Socket client, boost::asio::io_context& io, const Impairment& rules, Rng& rng, std::size_t number);

  /// Connects to the server's port of 127.0.0.1. `on_heard` is called once, when the server has been given the first
  /// bytes; `on_end` once, when both sides are closed.
  void start(std::uint16_t server_port, std::function<void()> on_heard, std::function<void()> on_end);
  /// Breaks the connection now; what is on its way is lost.
  void close();
  /// The rules have changed.
  void obey();

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Piece {
    Time due;
    std::vector<char> bytes;
  };
  /// One way.
  struct Lane {
    explicit Lane(boost::asio::io_context& io) : timer(io) {}
    boost::asio::steady_timer timer;
    std::vector<char> buffer;
    std::deque<Piece> on_the_way;
    std::size_t queued = 0;  ///< bytes on the way
    Time last_due;
    Time line_free;  ///< when the bandwidth lets the next byte in
    bool reading = false;
    bool writing = false;
    bool ended = false;  ///< its sender is gone
  };

  static constexpr std::size_t kToServer = 0;
  static constexpr std::size_t kToClient = 1;

  [[nodiscard]] Socket& from(std::size_t way) { return way == kToServer ? client_ : server_; }
  [[nodiscard]] Socket& to(std::size_t way) { return way == kToServer ? server_ : client_; }
  [[nodiscard]] bool stalls() const { return rules_.stalled || rules_.stalled_alone == number_; }
  [[nodiscard]] std::size_t most_at_once() const;
  [[nodiscard]] Time due_after_now(Lane& lane, std::size_t bytes);
  /// Bytes that still pass before the connection breaks; nothing: it does not.
  [[nodiscard]] std::optional<std::size_t> budget() const;

  void read(std::size_t way);
  void on_read(std::size_t way, std::size_t bytes);
  void write(std::size_t way);
  void write_front(std::size_t way);
  void on_written(std::size_t way, std::size_t bytes);
  void finish_if_drained(std::size_t way);
  void break_now();
  void become_half_open();

  Socket client_;
  Socket server_;
  std::size_t number_;
  const Impairment& rules_;
  Rng& rng_;
  std::function<void()> on_heard_;
  std::function<void()> on_end_;
  std::array<Lane, 2> lanes_;
  std::size_t passed_ = 0;  ///< bytes since the rules began
  bool started_ = false;
  std::optional<std::size_t> lives_on_;  ///< half-open: the way whose sender is there and is not told
};

}  // namespace seeker::testing
