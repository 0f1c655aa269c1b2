#include "server/protocols/lms200/commands.hpp"

#include <string>

#include "common/core/assert.hpp"
#include "server/protocols/lms200/little_endian.hpp"
#include "server/protocols/lms200/responses.hpp"

namespace seeker::lms200 {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes payload_of(const Reset&) { return {command_code::kReset}; }
Bytes payload_of(const RequestValues& command) { return {command_code::kValues, command.kind}; }
Bytes payload_of(const RequestStatus&) { return {command_code::kStatus}; }
Bytes payload_of(const RequestErrors&) { return {command_code::kErrors}; }
Bytes payload_of(const RequestType&) { return {command_code::kType}; }
Bytes payload_of(const RequestConfig&) { return {command_code::kGetConfig}; }

Bytes payload_of(const SetMode& command) {
  Bytes bytes{command_code::kMode, command.mode};
  bytes.insert(bytes.end(), command.parameters.begin(), command.parameters.end());
  return bytes;
}

Bytes payload_of(const SetVariant& command) {
  Bytes bytes{command_code::kVariant};
  append_u16(bytes, command.variant.angle_deg);
  append_u16(bytes, command.variant.resolution_cdeg);
  return bytes;
}

Bytes payload_of(const SetConfig& command) {
  Bytes bytes{command_code::kSetConfig};
  bytes.insert(bytes.end(), command.leading.begin(), command.leading.end());
  return bytes;
}

tl::unexpected<Error> wrong_command_length(std::span<const std::uint8_t> payload) {
  return fail(Errc::kParse, "command " + std::to_string(payload[0]) + " has " + std::to_string(payload.size()) +
                                " bytes, which it never has");
}

/// A command that consists of its code.
template <class T>
Result<Command> lone(std::span<const std::uint8_t> payload) {
  if (payload.size() != 1) {
    return wrong_command_length(payload);
  }
  return Command(T{});
}

Result<Command> mode_in(std::span<const std::uint8_t> payload) {
  if (payload.size() < 2) {
    return wrong_command_length(payload);
  }
  const std::span<const std::uint8_t> parameters = payload.subspan(2);
  return Command(SetMode{payload[1], {parameters.begin(), parameters.end()}});
}

Result<Command> values_in(std::span<const std::uint8_t> payload) {
  if (payload.size() != 2) {
    return wrong_command_length(payload);
  }
  return Command(RequestValues{payload[1]});
}

Result<Command> variant_in(std::span<const std::uint8_t> payload) {
  constexpr std::size_t kBytes = 5;
  if (payload.size() != kBytes) {
    return wrong_command_length(payload);
  }
  return Command(SetVariant{{u16_at(payload, 1), u16_at(payload, 3)}});
}

Result<Command> config_in(std::span<const std::uint8_t> payload) {
  if (payload.size() < 2 || payload.size() > 1 + ConfigBlock::kBytes) {
    return wrong_command_length(payload);
  }
  const std::span<const std::uint8_t> leading = payload.subspan(1);
  return Command(SetConfig{{leading.begin(), leading.end()}});
}

}  // namespace

SetMode enter_installation() { return {operating_mode::kInstallation, {kPassword.begin(), kPassword.end()}}; }

SetMode continuous_sub_range(const SubRange& range) {
  SetMode command{operating_mode::kContinuousSubRange, {}};
  append_u16(command.parameters, range.first);
  append_u16(command.parameters, range.last);
  return command;
}

Result<SubRange> sub_range_of(const SetMode& command) {
  if (command.parameters.size() != 2 * sizeof(std::uint16_t)) {
    return fail(Errc::kParse, "output of a sub-range needs its first and last value as two words");
  }
  return SubRange{u16_at(command.parameters, 0), u16_at(command.parameters, 2)};
}

std::vector<std::uint8_t> encode(const Command& command) {
  return std::visit([](const auto& c) { return payload_of(c); }, command);
}

Result<Command> decode_command(std::span<const std::uint8_t> payload) {
  SEEKER_ASSERT(!payload.empty());
  switch (payload[0]) {
    case command_code::kReset: return lone<Reset>(payload);
    case command_code::kMode: return mode_in(payload);
    case command_code::kValues: return values_in(payload);
    case command_code::kStatus: return lone<RequestStatus>(payload);
    case command_code::kErrors: return lone<RequestErrors>(payload);
    case command_code::kType: return lone<RequestType>(payload);
    case command_code::kVariant: return variant_in(payload);
    case command_code::kGetConfig: return lone<RequestConfig>(payload);
    case command_code::kSetConfig: return config_in(payload);
    default: break;
  }
  return fail(Errc::kParse, "the LMS200 has no command " + std::to_string(payload[0]));
}

}  // namespace seeker::lms200
