#include "common/net/connect.hpp"

#include <utility>

#include <boost/asio/connect.hpp>
#include <boost/asio/steady_timer.hpp>

namespace seeker::net {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

class Attempt : public std::enable_shared_from_this<Attempt> {
 public:
  Attempt(asio::io_context& io, std::string host, std::uint16_t port, Duration timeout,
          std::function<void(Result<Transport>)> done)
      : host_(std::move(host)),
        port_(port),
        timeout_(timeout),
        done_(std::move(done)),
        resolver_(io),
        socket_(io),
        timer_(io) {}

  void start() {
    timer_.expires_after(timeout_);
    timer_.async_wait([self = shared_from_this()](error_code error) {
      if (!error) {
        self->finish(fail(Errc::kTimeout, "no connection to " + self->name() + " in " +
                                              std::to_string(to_seconds(self->timeout_)) +
                                              " s; check address and network"));
      }
    });
    resolver_.async_resolve(host_, std::to_string(port_), tcp::resolver::numeric_service,
                            [self = shared_from_this()](error_code error, const tcp::resolver::results_type& found) {
                              self->on_resolved(error, found);
                            });
  }

 private:
  [[nodiscard]] std::string name() const { return host_ + " port " + std::to_string(port_); }

  void on_resolved(error_code error, const tcp::resolver::results_type& found) {
    if (!done_) {
      return;
    }
    if (error) {
      finish(fail(Errc::kLinkLost, "the address of '" + host_ + "' cannot be found: " + error.message()));
      return;
    }
    asio::async_connect(socket_, found, [self = shared_from_this()](error_code failed, const tcp::endpoint&) {
      if (failed) {
        self->finish(fail(Errc::kLinkLost, "no robot answers at " + self->name() + " (" + failed.message() +
                                               "); check that seekerd runs there"));
      } else {
        self->finish(std::move(self->socket_));
      }
    });
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
    }
    done(std::move(result));
  }

  std::string host_;
  std::uint16_t port_;
  Duration timeout_;
  std::function<void(Result<Transport>)> done_;
  tcp::resolver resolver_;
  Transport socket_;
  asio::steady_timer timer_;
};

}  // namespace

void async_connect(asio::io_context& io, const std::string& host, std::uint16_t port, Duration timeout,
                   std::function<void(Result<Transport>)> done) {
  std::make_shared<Attempt>(io, host, port, timeout, std::move(done))->start();
}

}  // namespace seeker::net
