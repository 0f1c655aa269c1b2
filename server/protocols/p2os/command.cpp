#include "server/protocols/p2os/command.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "common/core/assert.hpp"

namespace seeker::p2os {
namespace {

constexpr std::uint8_t kNonNegative = 0x3B;
constexpr std::uint8_t kNegative = 0x1B;
constexpr std::uint8_t kText = 0x2B;
/// Bytes of an integer argument: its type and 16 bits.
constexpr std::size_t kIntegerBytes = 3;
/// Bytes before a text: its type and its length.
constexpr std::size_t kTextPrefixBytes = 2;

/// Rates in the order of their codes.
constexpr std::array<std::uint32_t, 5> kBauds{9600, 19200, 38400, 57600, 115200};

std::vector<std::uint8_t> data_of(int argument) {
  SEEKER_ASSERT(std::abs(argument) <= kMaxArgument);
  const auto magnitude = static_cast<std::uint32_t>(std::abs(argument));
  return {argument < 0 ? kNegative : kNonNegative, static_cast<std::uint8_t>(magnitude & 0xFFU),
          static_cast<std::uint8_t>(magnitude >> 8U)};
}

std::vector<std::uint8_t> data_of(const std::string& text) {
  SEEKER_ASSERT(text.size() + kTextPrefixBytes <= kMaxDataBytes);
  std::vector<std::uint8_t> data{kText, static_cast<std::uint8_t>(text.size())};
  data.insert(data.end(), text.begin(), text.end());
  return data;
}

std::vector<std::uint8_t> data_of(std::monostate /*none*/) { return {}; }

Result<Command> parse_text(const Packet& packet) {
  if (packet.data.size() < kTextPrefixBytes) {
    return Command{packet.id, {}};
  }
  const std::size_t stated = packet.data[1];
  if (packet.data.size() < kTextPrefixBytes + stated) {
    return fail(Errc::kParse, "the text of command " + std::to_string(packet.id) + " is cut off");
  }
  const auto first = packet.data.begin() + kTextPrefixBytes;
  return Command{packet.id, std::string(first, first + static_cast<std::ptrdiff_t>(stated))};
}

}  // namespace

std::optional<int> Command::integer() const {
  const int* value = std::get_if<int>(&argument);
  return value != nullptr ? std::optional(*value) : std::nullopt;
}

std::vector<std::uint8_t> encode_command(CommandId id) { return encode({static_cast<std::uint8_t>(id), {}}); }

std::vector<std::uint8_t> encode_command(CommandId id, int argument) {
  return encode({static_cast<std::uint8_t>(id), data_of(argument)});
}

std::vector<std::uint8_t> encode_command(const Command& command) {
  return encode({command.number, std::visit([](const auto& value) { return data_of(value); }, command.argument)});
}

Result<Command> parse_command(const Packet& packet) {
  if (packet.data.empty()) {
    return Command{packet.id, {}};
  }
  const std::uint8_t type = packet.data[0];
  if (type == kText) {
    return parse_text(packet);
  }
  if (type != kNonNegative && type != kNegative) {
    return fail(Errc::kParse, "command " + std::to_string(packet.id) + " has an argument of the unknown type " +
                                  std::to_string(type));
  }
  if (packet.data.size() < kIntegerBytes) {
    return Command{packet.id, {}};
  }
  const int magnitude = packet.data[1] | (packet.data[2] << 8);
  return Command{packet.id, type == kNegative ? -magnitude : magnitude};
}

int vel2_argument(const WheelSpeeds& speeds) {
  const auto bits = static_cast<std::uint16_t>((static_cast<std::uint8_t>(speeds.left) << 8U) |
                                               static_cast<std::uint8_t>(speeds.right));
  return static_cast<std::int16_t>(bits);
}

WheelSpeeds vel2_speeds(int argument) {
  const auto bits = static_cast<std::uint16_t>(argument);
  return {static_cast<std::int8_t>(bits >> 8U), static_cast<std::int8_t>(bits & 0xFFU)};
}

std::optional<int> baud_code(std::uint32_t baud) {
  const auto found = std::find(kBauds.begin(), kBauds.end(), baud);
  return found == kBauds.end() ? std::nullopt : std::optional(static_cast<int>(found - kBauds.begin()));
}

std::optional<std::uint32_t> baud_of_code(int code) {
  return code >= 0 && code < static_cast<int>(kBauds.size()) ? std::optional(kBauds[static_cast<std::size_t>(code)])
                                                             : std::nullopt;
}

}  // namespace seeker::p2os
