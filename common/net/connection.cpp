#include "common/net/connection.hpp"

#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>

#include "common/net/tls_error.hpp"
#include "common/net/tls_stream.hpp"

namespace seeker::net {
namespace asio = boost::asio;
using boost::system::error_code;

namespace {

/// The payload of one record of TLS.
constexpr std::size_t kRecordBytes = 16384;

/// The first bytes of an alert of TLS where a frame's length belongs: a server's answer to plain TCP.
bool is_alert(std::string_view bytes) {
  constexpr char kAlert = 0x15;
  constexpr char kMajor = 0x03;
  return bytes.size() >= 2 && bytes[0] == kAlert && bytes[1] == kMajor;
}

}  // namespace

Connection::Connection(Transport transport, ConnectionParams params)
    : transport_(std::move(transport)),
      params_(params),
      write_deadline_(transport_.get_executor()),
      linger_(transport_.get_executor()),
      decoder_(params.max_frame_bytes) {
  error_code ignored;
  // Small frames (drive, stop) must not wait for larger ones to fill a packet.
  transport_.socket().set_option(asio::ip::tcp::no_delay(true), ignored);
}

void Connection::start(Handlers handlers) {
  handlers_ = std::move(handlers);
  read();
  write();
}

void Connection::read() {
  with_stream(transport_, [this](auto& stream) {
    stream.async_read_some(asio::buffer(chunk_), [self = shared_from_this()](error_code error, std::size_t bytes) {
      if (self->closed_) {
        return;
      }
      if (error) {
        self->on_read_ended(error);
      } else {
        self->on_read(bytes);
      }
    });
  });
}

void Connection::on_read_ended(const error_code& error) {
  read_ended_ = true;
  if (finishing_ && write_busy_ && is_end(error)) {
    return;  // the other side may still read: the last frame closes
  }
  end(broken_link(error));
}

Error Connection::not_a_frame(const Error& error) const {
  if (frame_came_ || transport_.peer() || !is_alert(std::string_view(chunk_.data(), chunk_.size()))) {
    return error;
  }
  return {Errc::kRefused,
          "the other side speaks TLS; name a bundle of certificates with --tls ('seeker pki issue' "
          "makes one)"};
}

void Connection::on_read(std::size_t bytes) {
  if (!finishing_) {
    const Status fed = decoder_.feed(std::string_view(chunk_.data(), bytes));
    while (!closed_ && !finishing_) {
      const auto payload = decoder_.next();
      if (!payload) {
        break;
      }
      frame_came_ = true;
      handlers_.on_frame(*payload);
    }
    if (!fed && !closed_ && !finishing_) {
      end(not_a_frame(fed.error()));
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
  write_deadline_.expires_after(params_.write_timeout);
  write_deadline_.async_wait([self = shared_from_this()](error_code error) {
    if (!error && self->write_busy_ && !self->closed_ && self->write_deadline_.expiry() <= wall_now()) {
      self->end({Errc::kTimeout, "the other side does not read"});
    }
  });
  send_writing();
}

void Connection::send_writing() {
  const std::string_view body = writing_.body ? std::string_view(*writing_.body) : std::string_view();
  std::array<asio::const_buffer, 3> buffers{asio::buffer(writing_.head), asio::buffer(body),
                                            asio::buffer(writing_.tail)};
  if (transport_.tls() != nullptr && asio::buffer_size(buffers) <= kRecordBytes) {
    record_.assign(writing_.head);
    record_.append(body).append(writing_.tail);
    buffers = {asio::buffer(record_), asio::const_buffer(), asio::const_buffer()};
  } else if (TlsStream* tls = transport_.tls()) {
    send_gathered(*tls, buffers);
    return;
  }
  with_stream(transport_, [this, &buffers](auto& stream) {
    asio::async_write(stream, buffers, [self = shared_from_this()](error_code error, std::size_t bytes) {
      self->on_written(error, bytes);
    });
  });
}

void Connection::send_gathered(TlsStream& tls, const std::array<asio::const_buffer, 3>& buffers) {
  tls.stream.next_layer().gather();
  asio::async_write(tls.stream, buffers, [self = shared_from_this(), &tls](error_code error, std::size_t bytes) {
    if (error) {
      self->on_written(error, bytes);
      return;
    }
    tls.stream.next_layer().flush([self, bytes](error_code failed) { self->on_written(failed, bytes); });
  });
}

void Connection::on_written(const error_code& error, std::size_t bytes) {
  write_busy_ = false;
  write_deadline_.cancel();
  if (closed_) {
    return;
  }
  if (error) {
    end(broken_link(error));
    return;
  }
  if (handlers_.on_sent && !ended_) {
    handlers_.on_sent(bytes);
  }
  write();
}

void Connection::say_end() {
  if (read_ended_) {
    close();
    return;
  }
  if (TlsStream* tls = transport_.tls()) {
    // Says that nothing follows; the wait for the same word of the other side ends with the connection.
    tls->stream.async_shutdown([self = shared_from_this()](error_code) {});
    return;
  }
  error_code ignored;
  transport_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
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
  transport_.socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
  transport_.socket().close(ignored);
  write_deadline_.cancel();
  linger_.cancel();
  // Handlers hold their owner, the owner holds this: break the circle, but not under a handler that is running.
  asio::post(transport_.get_executor(), [self = shared_from_this()] { self->handlers_ = {}; });
}

}  // namespace seeker::net
