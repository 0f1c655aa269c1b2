// Throughput of the LMS200 codec: what the scanner sends, to ranges in metres.
#include <benchmark/benchmark.h>

#include "server/protocols/lms200/scan_telegram.hpp"
#include "server/protocols/lms200/telegram_reader.hpp"
#include "tests/bench/device_stream.hpp"

namespace {

using namespace seeker;         // NOLINT: a benchmark is one small program
using namespace seeker::bench;  // NOLINT

constexpr double kFastestBaud = 500000.0;
constexpr unsigned kScans = 64;
constexpr unsigned kBeams = 361;  // 180 degrees in steps of half a degree
constexpr auto kMode = lms200::MeasuringMode::k8mFieldsAbDazzle;

/// Scans of a room, whose walls come nearer from scan to scan.
Bytes stream() {
  Bytes all;
  for (unsigned number = 0; number < kScans; ++number) {
    lms200::ScanTelegram scan;
    scan.unit = lms200::Unit::kMillimetre;
    scan.words.reserve(kBeams);
    for (unsigned beam = 0; beam < kBeams; ++beam) {
      scan.words.push_back(static_cast<std::uint16_t>(1000U + 37U * beam % 5000U + number));
    }
    scan.telegram_index = static_cast<std::uint8_t>(number);
    const Bytes bytes =
        lms200::encode_telegram(lms200::Sender::kDevice, lms200::encode(scan, lms200::StatusByte::kGood));
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  return all;
}

/// Number of scans whose ranges were read.
unsigned decode(lms200::TelegramReader& reader, std::span<const std::uint8_t> portion, std::vector<float>& ranges_m) {
  unsigned read = 0;
  reader.feed(portion);
  while (const auto received = reader.next()) {
    if (received->kind != lms200::Received::Kind::kTelegram) {
      continue;
    }
    const auto scan = lms200::decode_scan(received->payload, false);
    if (!scan) {
      continue;
    }
    ranges_m.resize(scan->words.size());
    std::transform(scan->words.begin(), scan->words.end(), ranges_m.begin(),
                   [&](std::uint16_t word) { return lms200::range_of(word, kMode, scan->unit); });
    benchmark::DoNotOptimize(ranges_m.data());
    ++read;
  }
  return read;
}

void run(benchmark::State& state, const Bytes& bytes, unsigned least, double goal = kGoalTimesLine) {
  lms200::TelegramReader reader(lms200::Sender::kDevice);
  std::vector<float> ranges_m;
  for (auto _ : state) {
    unsigned read = 0;
    for_each_portion(bytes, state.range(0), [&](auto portion) { read += decode(reader, portion, ranges_m); });
    if (read < least) {
      state.SkipWithError("scans are missing");
    }
  }
  report_throughput(state, bytes.size(), kFastestBaud, goal);
}

void lms200_stream(benchmark::State& state) { run(state, stream(), kScans); }
BENCHMARK(lms200_stream)->Arg(kBufferBytes)->Arg(kUsbPacketBytes)->Arg(kSingleByte);

void lms200_damaged(benchmark::State& state) { run(state, damaged(stream()), kScans / 4); }
BENCHMARK(lms200_damaged)->Arg(kUsbPacketBytes);

/// Headers of the longest telegram, none of which is one.
void lms200_headers(benchmark::State& state) {
  const Bytes header{lms200::kStx, lms200::kDeviceAddress, lms200::kMaxPayloadBytes & 0xFFU,
                     lms200::kMaxPayloadBytes >> 8U};
  run(state, repeated(header, 128 * kScans), 0, kGoalTimesLineAtWorst);
}
BENCHMARK(lms200_headers)->Arg(kUsbPacketBytes);

}  // namespace

BENCHMARK_MAIN();
