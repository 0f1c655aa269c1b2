#include "common/net/connection.hpp"

#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>

namespace seeker::net {
namespace asio = boost::asio;
using boost::system::error_code;

Connection::Connection(Transport transport, ConnectionParams params)
    : transport_(std::move(transport)),
      params_(params),
      write_deadline_(transport_.get_executor()),
      linger_(transport_.get_executor()),
      decoder_(params.max_frame_bytes) {
  error_code ignored;
  // Small frames (drive, stop) must not wait for larger ones to fill a packet.
  transport_.set_option(asio::ip::tcp::no_delay(true), ignored);
}

void Connection::start(Handlers handlers) {
  handlers_ = std::move(handlers);
  read();
  write();
}

void Connection::read() {
  transport_.async_read_some(asio::buffer(chunk_), [self = shared_from_this()](error_code error, std::size_t bytes) {
    if (self->closed_) {
      return;
    }
    if (error) {
      self->read_ended_ = true;
      if (self->finishing_ && self->write_busy_ && error == asio::error::eof) {
        return;  // the other side may still read: the last frame closes
      }
      self->end({Errc::kLinkLost, error == asio::error::eof ? "the other side closed the connection"
                                                            : "the connection broke: " + error.message()});
      return;
    }
    self->on_read(bytes);
  });
}

void Connection::on_read(std::size_t bytes) {
  if (!finishing_) {
    const Status fed = decoder_.feed(std::string_view(chunk_.data(), bytes));
    while (!closed_ && !finishing_) {
      const auto payload = decoder_.next();
      if (!payload) {
        break;
      }
      handlers_.on_frame(*payload);
    }
    if (!fed && !closed_ && !finishing_) {
      end(fed.error());
    }
  }
  // Once finishing, what comes is thrown away: closing with unread bytes would reset the connection, and the last frame
  // might never be seen.
  if (!closed_) {
    read();
  }
}

void Connection::wake() { write(); }

void Connection::write() {
  if (closed_ || write_busy_ || !handlers_.next_frame) {
    return;
  }
  std::optional<wire::OutFrame> frame = handlers_.next_frame();
  if (closed_) {
    return;
  }
  if (!frame) {
    if (finishing_) {
      say_end();
    }
    return;
  }
  writing_ = std::move(*frame);
  write_busy_ = true;
  const std::string_view body = writing_.body ? std::string_view(*writing_.body) : std::string_view();
  const std::array<asio::const_buffer, 3> buffers{asio::buffer(writing_.head), asio::buffer(body),
                                                  asio::buffer(writing_.tail)};
  write_deadline_.expires_after(params_.write_timeout);
  write_deadline_.async_wait([self = shared_from_this()](error_code error) {
    if (!error && self->write_busy_ && !self->closed_ && self->write_deadline_.expiry() <= wall_now()) {
      self->end({Errc::kTimeout, "the other side does not read"});
    }
  });
  asio::async_write(transport_, buffers, [self = shared_from_this()](error_code error, std::size_t bytes) {
    self->write_busy_ = false;
    self->write_deadline_.cancel();
    if (self->closed_) {
      return;
    }
    if (error) {
      self->end({Errc::kLinkLost, "the connection broke: " + error.message()});
      return;
    }
    if (self->handlers_.on_sent && !self->ended_) {
      self->handlers_.on_sent(bytes);
    }
    self->write();
  });
}

void Connection::say_end() {
  if (read_ended_) {
    close();
    return;
  }
  error_code ignored;
  transport_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
}

void Connection::end(const Error& error) {
  if (finishing_) {
    close();
    return;
  }
  if (std::exchange(ended_, true)) {
    return;
  }
  // The handler may drop the last reference to this connection's owner.
  const auto self = shared_from_this();
  const auto on_end = handlers_.on_end;
  on_end(error);
}

void Connection::finish(Duration linger) {
  if (closed_ || std::exchange(finishing_, true)) {
    return;
  }
  ended_ = true;
  linger_.expires_after(linger);
  linger_.async_wait([self = shared_from_this()](error_code error) {
    if (!error) {
      self->close();
    }
  });
  write();
}

void Connection::close() {
  if (std::exchange(closed_, true)) {
    return;
  }
  error_code ignored;
  transport_.shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
  transport_.close(ignored);
  write_deadline_.cancel();
  linger_.cancel();
  // Handlers hold their owner, the owner holds this: break the circle, but not under a handler that is running.
  asio::post(transport_.get_executor(), [self = shared_from_this()] { self->handlers_ = {}; });
}

}  // namespace seeker::net
