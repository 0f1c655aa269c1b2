#include "server/emulator/device_spec.hpp"

#include <algorithm>
#include <charconv>

namespace seeker::emulator {
namespace {

constexpr std::string_view kTcp = "tcp://";

tl::unexpected<Error> malformed(std::string_view text, const std::string& what) {
  std::string kinds;
  for (const DeviceKind kind : kDeviceKinds) {
    kinds += (kinds.empty() ? "" : ", ") + std::string(to_string(kind));
  }
  return fail(Errc::kInvalidArgument, "'" + std::string(text) + "' is no device (" + what +
                                          "); write KIND@LINE[#ROBOT], such as p2os@/tmp/base or " +
                                          "lms200@tcp://127.0.0.1:8102; the kinds are " + kinds);
}

template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string_view to_string(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::kP2os: return "p2os";
    case DeviceKind::kLms200: return "lms200";
    case DeviceKind::kRplidarA1: return "rplidar-a1";
    case DeviceKind::kRplidarA2: return "rplidar-a2";
    case DeviceKind::kCamera: return "camera";
  }
  return "unknown";
}

Result<DeviceSpec> parse_device_spec(std::string_view text) {
  const std::size_t at = text.find('@');
  const auto* const kind = std::find_if(kDeviceKinds.begin(), kDeviceKinds.end(),
                                        [&](DeviceKind one) { return to_string(one) == text.substr(0, at); });
  if (at == std::string_view::npos || kind == kDeviceKinds.end()) {
    return malformed(text, "no kind before an @");
  }
  DeviceSpec spec;
  spec.kind = *kind;
  std::string_view line = text.substr(at + 1);
  if (const std::size_t hash = line.rfind('#'); hash != std::string_view::npos) {
    if (!read_number(line.substr(hash + 1), spec.robot)) {
      return malformed(text, "no number of a robot after the #");
    }
    line = line.substr(0, hash);
  }
  if (!line.starts_with(kTcp)) {
    spec.path = line;
    return line.empty() || spec.kind == DeviceKind::kCamera ? malformed(text, "no line that it can have")
                                                            : Result<DeviceSpec>(spec);
  }
  line.remove_prefix(kTcp.size());
  const std::size_t colon = line.rfind(':');
  spec.host = line.substr(0, colon);
  const bool valid =
      colon != std::string_view::npos && !spec.host.empty() && read_number(line.substr(colon + 1), spec.port);
  return valid ? Result<DeviceSpec>(spec) : malformed(text, "no host and port after tcp://");
}

}  // namespace seeker::emulator
