#include "client/doctor/way.hpp"

#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <memory>

#include "common/net/exchange.hpp"

namespace seeker::doctor {

Result<std::vector<std::string>> addresses_of(const std::string& host) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  if (const int code = ::getaddrinfo(host.c_str(), nullptr, &hints, &list); code != 0) {
    return fail(Errc::kNotFound, "the name '" + host + "' stands for no address (" + ::gai_strerror(code) +
                                     "); check how it is written, or give the robot's IP address");
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owned(list, &::freeaddrinfo);
  std::vector<std::string> addresses;
  for (const addrinfo* one = list; one != nullptr; one = one->ai_next) {
    std::array<char, NI_MAXHOST> text{};
    const bool written =
        ::getnameinfo(one->ai_addr, one->ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) == 0;
    if (written && std::find(addresses.begin(), addresses.end(), text.data()) == addresses.end()) {
      addresses.emplace_back(text.data());
    }
  }
  return addresses;
}

Status try_port(const std::string& host, std::uint16_t port, Duration limit) {
  const auto connected = net::Exchange::connect({.host = host, .port = port, .timeout = limit, .tls = std::nullopt});
  return connected ? Status() : Status(tl::unexpected<Error>(connected.error()));
}

}  // namespace seeker::doctor
