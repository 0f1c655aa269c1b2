#include "server/protocols/p2os/sip.hpp"

#include <string>

#include "common/core/assert.hpp"
#include "server/protocols/p2os/field_io.hpp"

namespace seeker::p2os {
namespace {

/// Bytes before the sonar readings.
constexpr std::size_t kFixedBytes = 19;
constexpr std::size_t kSonarBytes = 3;
constexpr std::uint16_t kPositionMask = kPositionModulus - 1;

/// Calls `visit` for each field that may be missing, in the order of the wire.
template <class S, class Visit>
void for_each_tail_field(S& sip, Visit&& visit) {
  visit(sip.ports);
  visit(sip.analog);
  visit(sip.digital_in);
  visit(sip.digital_out);
  visit(sip.battery_x10);
  visit(sip.charge_state);
  visit(sip.rotational_velocity);
  visit(sip.fault_flags);
  visit(sip.lateral_velocity);
  visit(sip.temperature_c);
  visit(sip.charge_percent);
  visit(sip.controller_time_us);
  visit(sip.flags3);
}

/// Reads the fields before the sonar readings, which are there; returns the number of readings.
std::size_t read_fixed(FieldReader& in, Sip& sip) {
  sip.x = in.u16().value() & kPositionMask;
  sip.y = in.u16().value() & kPositionMask;
  sip.theta = static_cast<std::int16_t>(in.u16().value());
  sip.left_velocity = static_cast<std::int16_t>(in.u16().value());
  sip.right_velocity = static_cast<std::int16_t>(in.u16().value());
  sip.battery_dv = in.u8().value();
  sip.stall_left_rear = in.u8().value();
  sip.stall_right_front = in.u8().value();
  sip.control = static_cast<std::int16_t>(in.u16().value());
  sip.flags = in.u16().value();
  sip.compass = in.u8().value();
  return in.u8().value();
}

void write_fixed(FieldWriter& out, const Sip& sip) {
  out.u16(sip.x & kPositionMask);
  out.u16(sip.y & kPositionMask);
  write_field(out, sip.theta);
  write_field(out, sip.left_velocity);
  write_field(out, sip.right_velocity);
  out.u8(sip.battery_dv);
  out.u8(sip.stall_left_rear);
  out.u8(sip.stall_right_front);
  write_field(out, sip.control);
  out.u16(sip.flags);
  out.u8(sip.compass);
  out.u8(static_cast<std::uint8_t>(sip.sonars.size()));
}

}  // namespace

bool is_sip(const Packet& packet) { return packet.is(PacketId::kSipStopped) || packet.is(PacketId::kSipMoving); }

Result<Sip> read_sip(const Packet& packet) {
  SEEKER_ASSERT(is_sip(packet));
  if (packet.data.size() < kFixedBytes) {
    return fail(Errc::kCorrupt, "an information packet of the base has " + std::to_string(packet.data.size()) +
                                    " bytes of data, and at least " + std::to_string(kFixedBytes) + " are needed");
  }
  Sip sip;
  sip.moving = packet.is(PacketId::kSipMoving);
  FieldReader in(packet.data);
  const std::size_t sonars = read_fixed(in, sip);
  if (in.left_bytes() < sonars * kSonarBytes) {
    return fail(Errc::kCorrupt, "an information packet of the base announces " + std::to_string(sonars) +
                                    " sonar readings and ends before the last");
  }
  sip.sonars.reserve(sonars);
  for (std::size_t k = 0; k < sonars; ++k) {
    const std::uint8_t number = in.u8().value();
    sip.sonars.push_back({number, in.u16().value()});
  }
  for_each_tail_field(sip, [&]<class T>(std::optional<T>& field) { field = read_field<T>(in); });
  return sip;
}

Packet write_sip(const Sip& sip) {
  SEEKER_ASSERT(sip.sonars.size() <= kMaxSipSonars);
  FieldWriter out;
  write_fixed(out, sip);
  for (const SipSonar& sonar : sip.sonars) {
    out.u8(sonar.number);
    out.u16(sonar.range);
  }
  bool complete = true;
  for_each_tail_field(sip, [&](const auto& field) {
    complete = complete && field.has_value();
    if (complete) {
      write_field(out, *field);
    }
  });
  return {static_cast<std::uint8_t>(sip.moving ? PacketId::kSipMoving : PacketId::kSipStopped), out.take()};
}

}  // namespace seeker::p2os
