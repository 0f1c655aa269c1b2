/// \file
/// What the host sends to the LMS200 (protocols 2.3), as values.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "common/core/result.hpp"
#include "server/protocols/lms200/config_block.hpp"
#include "server/protocols/lms200/measuring.hpp"

namespace seeker::lms200 {

/// Parameters of the command 0x20 that change what the device does; those of rates are in baud_rate.hpp.
namespace operating_mode {
inline constexpr std::uint8_t kInstallation = 0x00;
inline constexpr std::uint8_t kContinuous = 0x24;          ///< all values of every scan that the line has time for
inline constexpr std::uint8_t kRequest = 0x25;             ///< scans on request only
inline constexpr std::uint8_t kContinuousSubRange = 0x27;  ///< two words follow: first and last value, from 1
}  // namespace operating_mode

inline constexpr std::string_view kPassword = "SICK_LMS";

/// Starts the device again, as after power on.
struct Reset {
  friend bool operator==(const Reset&, const Reset&) = default;
};
/// Changes the operating mode or the rate.
struct SetMode {
  std::uint8_t mode = operating_mode::kRequest;
  std::vector<std::uint8_t> parameters;

  friend bool operator==(const SetMode&, const SetMode&) = default;
};
/// Asks for values once; 1 is all values of a scan.
struct RequestValues {
  std::uint8_t kind = 1;

  friend bool operator==(const RequestValues&, const RequestValues&) = default;
};
struct RequestStatus {
  friend bool operator==(const RequestStatus&, const RequestStatus&) = default;
};
struct RequestErrors {
  friend bool operator==(const RequestErrors&, const RequestErrors&) = default;
};
struct RequestType {
  friend bool operator==(const RequestType&, const RequestType&) = default;
};
struct SetVariant {
  Variant variant;

  friend bool operator==(const SetVariant&, const SetVariant&) = default;
};
struct RequestConfig {
  friend bool operator==(const RequestConfig&, const RequestConfig&) = default;
};
/// Writes the first bytes of the configuration block: at least one, at most ConfigBlock::kBytes.
struct SetConfig {
  std::vector<std::uint8_t> leading;

  friend bool operator==(const SetConfig&, const SetConfig&) = default;
};

using Command = std::variant<Reset, SetMode, RequestValues, RequestStatus, RequestErrors, RequestType, SetVariant,
                             RequestConfig, SetConfig>;

/// Which values of a scan are sent, counted from 1, both included.
struct SubRange {
  std::uint16_t first = 1;
  std::uint16_t last = 1;

  friend bool operator==(const SubRange&, const SubRange&) = default;
};

[[nodiscard]] SetMode enter_installation();
[[nodiscard]] SetMode continuous_sub_range(const SubRange& range);
/// The sub-range of a SetMode of kContinuousSubRange. kParse: its parameters are not two words.
[[nodiscard]] Result<SubRange> sub_range_of(const SetMode& command);

/// The payload of the command's telegram.
[[nodiscard]] std::vector<std::uint8_t> encode(const Command& command);
/// Reads a telegram's payload of at least one byte. kParse: no such command, or of another length.
[[nodiscard]] Result<Command> decode_command(std::span<const std::uint8_t> payload);

}  // namespace seeker::lms200
