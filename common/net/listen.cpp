#include "common/net/listen.hpp"

namespace seeker::net {
namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

Result<std::uint16_t> listen_on(tcp::acceptor& acceptor, const std::string& address, std::uint16_t port) {
  error_code error;
  const auto interface = asio::ip::make_address(address, error);
  if (error) {
    return fail(Errc::kInvalidArgument, "'" + address + "' is not an IP address of this machine");
  }
  const tcp::endpoint endpoint(interface, port);
  acceptor.open(endpoint.protocol(), error);
  if (!error) {
    acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  }
  if (!error) {
    acceptor.bind(endpoint, error);
  }
  if (!error) {
    acceptor.listen(asio::socket_base::max_listen_connections, error);
  }
  if (error) {
    return fail(Errc::kIo, "cannot listen on " + address + " port " + std::to_string(port) + ": " + error.message() +
                               "; stop what listens there or choose another port");
  }
  return acceptor.local_endpoint().port();
}

}  // namespace seeker::net
