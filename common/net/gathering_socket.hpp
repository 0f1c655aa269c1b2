/// \file
/// A TCP socket under TLS that sends several records in one system call. Included in .cpp files only.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

namespace seeker::net {

/// Between gather() and flush() what is written is kept, up to a limit, instead of sent: a large frame takes many
/// records of 16 KiB, and a system call for each costs more than its encryption. Used on one thread; every handler must
/// keep this alive.
class GatheringSocket : public boost::asio::ip::tcp::socket {
 public:
  using Base = boost::asio::ip::tcp::socket;
  explicit GatheringSocket(Base socket) : Base(std::move(socket)) {}

  /// Keeps what is written from now on.
  void gather() { gathering_ = true; }

  /// Sends what was kept; `done(error)` is called when it has left. One flush() at a time.
  template <class Done>
  void flush(Done done) {
    gathering_ = false;
    send_kept(std::move(done));
  }

  /// Of AsyncWriteStream. Called by the stream of TLS, one write at a time.
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    if (!gathering_ && leaving_.empty()) {
      Base::async_write_some(buffers, std::forward<Handler>(handler));
      return;
    }
    const std::size_t before = kept_.size();
    const std::size_t bytes = boost::asio::buffer_size(buffers);
    kept_.resize(before + bytes);
    boost::asio::buffer_copy(boost::asio::buffer(kept_) + before, buffers);
    if (leaving_.empty() && kept_.size() >= kMostKeptBytes) {
      send_kept([handler = std::forward<Handler>(handler), bytes](boost::system::error_code error) mutable {
        std::move(handler)(error, error ? 0 : bytes);
      });
      return;
    }
    boost::asio::post(get_executor(), [handler = std::forward<Handler>(handler), bytes]() mutable {
      std::move(handler)(boost::system::error_code(), bytes);
    });
  }

 private:
  template <class Done>
  void send_kept(Done done) {
    leaving_.swap(kept_);
    boost::asio::async_write(static_cast<Base&>(*this), boost::asio::buffer(leaving_),
                             [this, done = std::move(done)](boost::system::error_code error, std::size_t) mutable {
                               leaving_ = {};  // idle connections keep no buffers
                               if (!error && !gathering_ && !kept_.empty()) {
                                 send_kept(std::move(done));
                               } else {
                                 std::move(done)(error);
                               }
                             });
  }

  static constexpr std::size_t kMostKeptBytes = 128UL * 1024;

  std::string kept_;     ///< waits for flush()
  std::string leaving_;  ///< is being sent
  bool gathering_ = false;
};

}  // namespace seeker::net
