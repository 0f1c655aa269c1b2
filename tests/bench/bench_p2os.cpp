// Throughput of the P2OS codec: what a Pioneer base sends, to the fields of its packets.
#include <benchmark/benchmark.h>

#include "server/protocols/p2os/gyro_packet.hpp"
#include "server/protocols/p2os/packet_reader.hpp"
#include "server/protocols/p2os/sip.hpp"
#include "tests/bench/device_stream.hpp"

namespace {

using namespace seeker;         // NOLINT: a benchmark is one small program
using namespace seeker::bench;  // NOLINT

constexpr double kFastestBaud = 115200.0;
constexpr unsigned kCycles = 256;
constexpr unsigned kSonarsEach = 3;

/// A base that drives on an arc, with all fields of the newest firmware.
p2os::Sip information(unsigned cycle) {
  p2os::Sip sip;
  sip.moving = true;
  sip.x = static_cast<std::uint16_t>(30U * cycle % p2os::kPositionModulus);
  sip.y = static_cast<std::uint16_t>(7U * cycle % p2os::kPositionModulus);
  sip.theta = static_cast<std::int16_t>(11 * static_cast<int>(cycle));
  sip.left_velocity = 290;
  sip.right_velocity = 310;
  sip.battery_dv = 126;
  sip.flags = p2os::flag::kMotorsOn | p2os::flag::kFrontSonar;
  sip.sonars.reserve(kSonarsEach);
  for (unsigned k = 0; k < kSonarsEach; ++k) {
    sip.sonars.push_back(
        {static_cast<std::uint8_t>((kSonarsEach * cycle + k) % 16U), static_cast<std::uint16_t>(900U + cycle)});
  }
  sip.ports = sip.fault_flags = 0;
  sip.analog = sip.digital_in = sip.digital_out = sip.charge_state = 0;
  sip.battery_x10 = 126;
  sip.rotational_velocity = 35;
  sip.lateral_velocity = 0;
  sip.temperature_c = std::int8_t{25};
  sip.charge_percent = std::uint8_t{80};
  sip.controller_time_us = 100000U * cycle;
  sip.flags3 = 0;
  return sip;
}

/// Information and gyroscope readings of each cycle of 100 ms.
Bytes stream() {
  Bytes all;
  for (unsigned cycle = 0; cycle < kCycles; ++cycle) {
    const p2os::Packet gyro = p2os::write_gyro({{511, 40}, {509, 40}, {510, 40}, {512, 40}});
    for (const p2os::Packet& packet : {p2os::write_sip(information(cycle)), gyro}) {
      const Bytes bytes = p2os::encode(packet);
      all.insert(all.end(), bytes.begin(), bytes.end());
    }
  }
  return all;
}

/// Number of packets whose fields were read.
unsigned decode(p2os::PacketReader& reader, std::span<const std::uint8_t> portion) {
  unsigned read = 0;
  reader.feed(portion);
  while (const auto packet = reader.next()) {
    if (p2os::is_sip(*packet)) {
      const auto sip = p2os::read_sip(*packet);
      benchmark::DoNotOptimize(sip->x);
      read += sip ? 1U : 0U;
    } else if (packet->is(p2os::PacketId::kGyro)) {
      const auto gyro = p2os::read_gyro(*packet);
      benchmark::DoNotOptimize(gyro->data());
      read += gyro ? 1U : 0U;
    }
  }
  return read;
}

void run(benchmark::State& state, const Bytes& bytes, unsigned least, double goal = kGoalTimesLine) {
  p2os::PacketReader reader;
  for (auto _ : state) {
    unsigned read = 0;
    for_each_portion(bytes, state.range(0), [&](auto portion) { read += decode(reader, portion); });
    if (read < least) {
      state.SkipWithError("packets are missing");
    }
  }
  report_throughput(state, bytes.size(), kFastestBaud, goal);
}

void p2os_stream(benchmark::State& state) { run(state, stream(), 2 * kCycles); }
BENCHMARK(p2os_stream)->Arg(kBufferBytes)->Arg(kUsbPacketBytes)->Arg(kSingleByte);

void p2os_damaged(benchmark::State& state) { run(state, damaged(stream()), kCycles); }
BENCHMARK(p2os_damaged)->Arg(kUsbPacketBytes);

/// Headers of the longest packet, none of which is one.
void p2os_headers(benchmark::State& state) {
  const Bytes header{p2os::kHeader0, p2os::kHeader1, static_cast<std::uint8_t>(p2os::kMaxCount)};
  run(state, repeated(header, 64 * kCycles), 0, kGoalTimesLineAtWorst);
}
BENCHMARK(p2os_headers)->Arg(kUsbPacketBytes);

}  // namespace

BENCHMARK_MAIN();
