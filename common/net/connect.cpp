#include "common/net/connect.hpp"

#include <utility>

#include <boost/asio/connect.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/tls_context.hpp"
#include "common/net/tls_error.hpp"
#include "common/net/tls_stream.hpp"

namespace seeker::net {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

class Attempt : public std::enable_shared_from_this<Attempt> {
 public:
  Attempt(asio::io_context& io, Target target, std::function<void(Result<Transport>)> done)
      : target_(std::move(target)), done_(std::move(done)), resolver_(io), socket_(io), timer_(io) {}

  void start() {
    if (target_.tls) {
      Result<std::shared_ptr<const TlsContext>> context = TlsContext::make(*target_.tls, TlsSide::kClient);
      if (!context) {
        asio::post(socket_.get_executor(), [self = shared_from_this(), error = context.error()] {
          self->finish(tl::unexpected<Error>(error));
        });
        return;
      }
      context_ = std::move(*context);
    }
    timer_.expires_after(target_.timeout);
    timer_.async_wait([self = shared_from_this()](error_code error) {
      if (!error) {
        self->finish(fail(Errc::kTimeout, "no connection to " + self->name() + " in " +
                                              std::to_string(to_seconds(self->target_.timeout)) +
                                              " s; check address and network"));
      }
    });
    resolver_.async_resolve(target_.host, std::to_string(target_.port), tcp::resolver::numeric_service,
                            [self = shared_from_this()](error_code error, const tcp::resolver::results_type& found) {
                              self->on_resolved(error, found);
                            });
  }
  void give_up() {
    if (!tls_) {
      finish(fail(Errc::kCancelled, "the attempt to connect was given up"));
    }
  }

 private:
  [[nodiscard]] std::string name() const { return target_.host + " port " + std::to_string(target_.port); }

  void on_resolved(error_code error, const tcp::resolver::results_type& found) {
    if (!done_) {
      return;
    }
    if (error) {
      finish(fail(Errc::kLinkLost, "the address of '" + target_.host + "' cannot be found: " + error.message()));
      return;
    }
    asio::async_connect(socket_, found, [self = shared_from_this()](error_code failed, const tcp::endpoint&) {
      if (failed) {
        self->finish(fail(Errc::kLinkLost, "no robot answers at " + self->name() + " (" + failed.message() +
                                               "); check that seekerd runs there"));
      } else {
        self->on_connected();
      }
    });
  }

  void on_connected() {
    if (!done_) {
      return;
    }
    if (!context_) {
      finish(Transport(std::move(socket_)));
      return;
    }
    SSL* session = context_->new_session();
    if (session == nullptr) {
      finish(fail(Errc::kInternal, "out of memory"));
      return;
    }
    tls_ = std::make_unique<TlsStream>(std::move(socket_), session);
    if (!expect_host(session, target_.host)) {
      finish(fail(Errc::kInvalidArgument, "'" + target_.host + "' is no name that a certificate could have"));
      return;
    }
    tls_->stream.async_handshake(asio::ssl::stream_base::client,
                                 [self = shared_from_this()](error_code error) { self->on_handshake(error); });
  }

  void on_handshake(const error_code& error) {
    if (!done_) {
      return;
    }
    SSL* session = tls_->stream.native_handle();
    X509* shown = error ? nullptr : SSL_get1_peer_certificate(session);
    if (shown == nullptr) {
      finish(tl::unexpected<Error>(failed_handshake(error, SSL_get_verify_result(session), name())));
      return;
    }
    pki::Certificate peer(shown);
    finish(Transport(std::move(tls_), std::move(peer)));
  }

  void finish(Result<Transport> result) {
    const auto done = std::exchange(done_, nullptr);
    if (!done) {
      return;
    }
    timer_.cancel();
    resolver_.cancel();
    if (!result) {
      error_code ignored;
      socket_.close(ignored);
      if (tls_) {
        tls_->stream.next_layer().close(ignored);
      }
    }
    done(std::move(result));
  }

  Target target_;
  std::shared_ptr<const TlsContext> context_;  ///< null: plain TCP
  std::function<void(Result<Transport>)> done_;
  tcp::resolver resolver_;
  tcp::socket socket_;
  std::unique_ptr<TlsStream> tls_;
  asio::steady_timer timer_;
};

}  // namespace

std::function<void()> async_connect(asio::io_context& io, Target target, std::function<void(Result<Transport>)> done) {
  const auto attempt = std::make_shared<Attempt>(io, std::move(target), std::move(done));
  attempt->start();
  return [weak = std::weak_ptr<Attempt>(attempt)] {
    if (const auto self = weak.lock()) {
      self->give_up();
    }
  };
}

}  // namespace seeker::net
