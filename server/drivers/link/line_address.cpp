#include "server/drivers/link/line_address.hpp"

#include <charconv>
#include <string_view>

namespace seeker::drivers {
namespace {

constexpr std::string_view kTcp = "tcp://";

tl::unexpected<Error> malformed(const std::string& text) {
  return fail(Errc::kInvalidArgument, "'" + text + "' is no line; name a serial port by its path, such as " +
                                          "/dev/ttyUSB0, or a TCP port as tcp://HOST:PORT");
}

}  // namespace

Result<LineAddress> parse_line_address(const std::string& text, std::uint16_t default_port) {
  if (!text.starts_with(kTcp)) {
    return text.starts_with('/') ? Result<LineAddress>(LineAddress{text, {}, 0}) : malformed(text);
  }
  const std::string rest = text.substr(kTcp.size());
  const std::size_t colon = rest.rfind(':');
  LineAddress address{{}, rest.substr(0, colon), default_port};
  if (colon != std::string::npos) {
    const char* const end = rest.data() + rest.size();
    const auto [last, error] = std::from_chars(rest.data() + colon + 1, end, address.port);
    if (error != std::errc() || last != end) {
      return malformed(text);
    }
  }
  return address.host.empty() || address.port == 0 ? malformed(text) : Result<LineAddress>(address);
}

std::string to_string(const LineAddress& address) {
  return address.serial() ? address.path : std::string(kTcp) + address.host + ":" + std::to_string(address.port);
}

}  // namespace seeker::drivers
