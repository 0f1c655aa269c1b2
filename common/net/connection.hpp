/// \file
/// Frames over a transport.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <boost/asio/buffer.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/core/result.hpp"
#include "common/net/transport.hpp"
#include "common/wire/frame.hpp"

namespace seeker::net {

struct ConnectionParams {
  std::size_t max_frame_bytes = wire::kMaxFrameBytes;  ///< largest payload of a received frame
  Duration write_timeout = std::chrono::seconds(10);   ///< wall time for one frame to leave
};

/// Reads frames and pulls frames to write, until either side closes. It holds no queue: at most one frame is being
/// written, the next one is asked for when that has left, so that what is newest is decided as late as possible.
/// All methods and handlers run on the io_context's single thread.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  struct Handlers {
    std::function<void(std::string_view payload)> on_frame;
    /// Returns the next frame to write; std::nullopt when there is none now (then call wake() later).
    std::function<std::optional<wire::OutFrame>()> next_frame;
    std::function<void(std::size_t bytes)> on_sent;
    /// Called exactly once, unless close() was called before. An orderly end by the peer is kLinkLost, too; kRefused:
    /// it does not believe our certificate. An oversized frame is kTooLarge and leaves the writing side open: call
    /// finish() or close().
    std::function<void(const Error&)> on_end;
  };

  Connection(Transport transport, ConnectionParams params);

  void start(Handlers handlers);
  /// Tries to write again, after next_frame() has returned no frame.
  void wake();
  /// Takes no more frames, writes what next_frame() still gives, waits for the other side to close, and closes; all of
  /// it within `linger` of wall time. No handler but next_frame is called afterwards.
  void finish(Duration linger);
  /// Closes at once; no handler is called afterwards.
  void close();
  [[nodiscard]] bool closed() const { return closed_; }

 private:
  void read();
  void on_read_ended(const boost::system::error_code& error);
  void on_read(std::size_t bytes);
  [[nodiscard]] Error not_a_frame(const Error& error) const;
  void write();
  void send_writing();
  /// A frame of several records, in few system calls.
  void send_gathered(TlsStream& tls, const std::array<boost::asio::const_buffer, 3>& buffers);
  void on_written(const boost::system::error_code& error, std::size_t bytes);
  void say_end();
  void end(const Error& error);

  static constexpr std::size_t kReadBytes = 64UL * 1024;

  Transport transport_;
  ConnectionParams params_;
  Handlers handlers_;
  boost::asio::steady_timer write_deadline_;
  boost::asio::steady_timer linger_;
  wire::FrameDecoder decoder_;
  std::array<char, kReadBytes> chunk_{};
  wire::OutFrame writing_;
  std::string record_;  ///< with TLS: a small frame in one piece, so that it travels as one record
  bool frame_came_ = false;
  bool write_busy_ = false;
  bool read_ended_ = false;
  bool finishing_ = false;
  bool ended_ = false;
  bool closed_ = false;
};

}  // namespace seeker::net
