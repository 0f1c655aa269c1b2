#include "common/rpc/endpoint.hpp"

#include <algorithm>

#include "common/core/number_in.hpp"

namespace seeker::rpc {
namespace {

Result<std::uint16_t> parse_port(std::string_view text) {
  const std::optional<std::uint16_t> port = number_in<std::uint16_t>(text);
  if (port.value_or(0) == 0) {
    return fail(Errc::kInvalidArgument, "'" + std::string(text) + "' is not a port; give a number from 1 to 65535");
  }
  return *port;
}

Result<Endpoint> make(std::string_view host, std::string_view port) {
  constexpr std::size_t kMaxHost = 253;
  const bool clean = std::all_of(host.begin(), host.end(), [](char c) { return c > ' ' && c < 0x7f; });
  if (host.empty() || host.size() > kMaxHost || !clean) {
    return fail(Errc::kInvalidArgument, "the robot's address needs a host: HOST or HOST:PORT, IPv6 as [::1]:7471");
  }
  Endpoint endpoint{std::string(host), kDefaultPort};
  if (!port.empty()) {
    const Result<std::uint16_t> number = parse_port(port.substr(1));
    if (!number) {
      return tl::unexpected<Error>(number.error());
    }
    endpoint.port = *number;
  }
  return endpoint;
}

}  // namespace

Result<Endpoint> parse_endpoint(std::string_view text) {
  if (!text.empty() && text.front() == '[') {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos || (end + 1 < text.size() && text[end + 1] != ':')) {
      return fail(Errc::kInvalidArgument, "'" + std::string(text) + "' is not an address; write IPv6 as [::1]:7471");
    }
    return make(text.substr(1, end - 1), text.substr(end + 1));
  }
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos && text.find(':', colon + 1) != std::string_view::npos) {
    return fail(Errc::kInvalidArgument,
                "'" + std::string(text) + "' has more than one colon; write an IPv6 address in brackets, [::1]:7471");
  }
  return colon == std::string_view::npos ? make(text, "") : make(text.substr(0, colon), text.substr(colon));
}

std::string to_string(const Endpoint& endpoint) {
  const bool v6 = endpoint.host.find(':') != std::string::npos;
  return (v6 ? "[" + endpoint.host + "]" : endpoint.host) + ":" + std::to_string(endpoint.port);
}

bool is_this_machine(std::string_view host) { return host == "localhost" || host == "::1" || host.starts_with("127."); }

}  // namespace seeker::rpc
