#include "common/net/listen.hpp"

#include <utility>

#include "common/core/time.hpp"
#include "common/log/log.hpp"

namespace seeker::net {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr Duration kAcceptPause = std::chrono::milliseconds(100);  ///< after one that failed

}  // namespace

Listener::Listener(asio::io_context& io, std::string_view part, std::function<void(tcp::socket)> on_socket)
    : part_(part), on_socket_(std::move(on_socket)), acceptor_(io), pause_(io) {}

Result<std::uint16_t> Listener::open(const std::string& address, std::uint16_t port) {
  error_code error;
  const auto interface = asio::ip::make_address(address, error);
  if (error) {
    return fail(Errc::kInvalidArgument, "'" + address + "' is not an IP address of this machine");
  }
  const tcp::endpoint endpoint(interface, port);
  acceptor_.open(endpoint.protocol(), error);
  if (!error) {
    acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  }
  if (!error) {
    acceptor_.bind(endpoint, error);
  }
  if (!error) {
    acceptor_.listen(asio::socket_base::max_listen_connections, error);
  }
  if (error) {
    return fail(Errc::kIo, "cannot listen on " + address + " port " + std::to_string(port) + ": " + error.message() +
                               "; stop what listens there or choose another port");
  }
  return acceptor_.local_endpoint().port();
}

void Listener::accept() {
  acceptor_.async_accept([this](error_code error, tcp::socket socket) {
    if (closed_) {
      return;
    }
    if (!error) {
      on_socket_(std::move(socket));
      accept();
      return;
    }
    log::warning(part_, "a connection could not be accepted: " + error.message());
    pause_.expires_after(kAcceptPause);
    pause_.async_wait([this](error_code ended) {
      if (!ended) {
        accept();
      }
    });
  });
}

void Listener::close() {
  closed_ = true;
  error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
}

}  // namespace seeker::net
