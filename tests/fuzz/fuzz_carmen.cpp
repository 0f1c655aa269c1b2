/// \file
/// Any text through the line parsers of logs, and what it accepts on to a scan.
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>

#include "common/core/assert.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/drivers/replay/scan_csv.hpp"

// NOLINTNEXTLINE: the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const auto record = seeker::drivers::parse_log_line(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (!record || !*record) {
      continue;
    }
    if (const auto* scan = std::get_if<seeker::drivers::CarmenScan>(&**record)) {
      SEEKER_ASSERT(seeker::validate(seeker::drivers::to_laser_scan(*scan, {}, {})).has_value());
    } else {
      SEEKER_ASSERT(seeker::is_finite(std::get<seeker::drivers::CarmenOdometry>(**record).odom_T_base));
    }
  }
  return 0;
}
