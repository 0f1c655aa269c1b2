#include "common/net/link_security.hpp"

#include <boost/asio/ip/address.hpp>

namespace seeker::net {

Status check_allowed(const std::string& address, const LinkSecurity& security) {
  boost::system::error_code no_address;
  const auto interface = boost::asio::ip::make_address(address, no_address);
  if (security.tls() || security.insecure || (!no_address && interface.is_loopback())) {
    return {};
  }
  return fail(Errc::kRefused, "everybody in the network could command the robot at " + address +
                                  ": make certificates with 'seeker pki init' and 'seeker pki issue' and name them "
                                  "(server.tls), listen on 127.0.0.1, or accept it (server.insecure: true)");
}

}  // namespace seeker::net
