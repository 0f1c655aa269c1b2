// Throughput of the RPLIDAR codec: what the scanner sends, to samples in SI units, in capsules and sample by sample.
#include <benchmark/benchmark.h>

#include "server/protocols/rplidar/answer_reader.hpp"
#include "server/protocols/rplidar/capsule_chain.hpp"
#include "tests/bench/device_stream.hpp"

namespace {

using namespace seeker;         // NOLINT: a benchmark is one small program
using namespace seeker::bench;  // NOLINT
using rplidar::AnswerType;

constexpr double kFastestBaud = 256000.0;
constexpr unsigned kCapsules = 400;
constexpr unsigned kSamples = 8000;
/// Turn from sample to sample at 10 Hz and 4000 samples a second, in 1/64 degree.
constexpr unsigned kStepQ6 = 58;

void append(const auto& bytes, Bytes& all) { all.insert(all.end(), bytes.begin(), bytes.end()); }

constexpr unsigned angle_q6(unsigned sample) {
  return kStepQ6 * sample % static_cast<unsigned>(rplidar::kRevolutionQ6);
}

Bytes capsules() {
  Bytes all;
  append(encode(rplidar::Descriptor{rplidar::kCapsuleBytes, true, AnswerType::kExpressScan}), all);
  for (unsigned number = 0; number < kCapsules; ++number) {
    rplidar::ExpressCapsule capsule;
    capsule.first = number == 0;
    capsule.start_angle_q6 = static_cast<std::uint16_t>(angle_q6(rplidar::kCapsuleSamples * number));
    for (unsigned k = 0; k < rplidar::kCapsuleSamples; ++k) {
      capsule.samples[k] = {static_cast<std::uint16_t>(500U + 23U * (number + k) % 6000U), std::uint8_t{3}};
    }
    append(encode(capsule), all);
  }
  return all;
}

Bytes samples() {
  Bytes all;
  append(encode(rplidar::Descriptor{rplidar::kLegacyBytes, true, AnswerType::kLegacyScan}), all);
  for (unsigned number = 0; number < kSamples; ++number) {
    rplidar::LegacySample sample;
    sample.begins_revolution = angle_q6(number) < kStepQ6;
    sample.quality = rplidar::kCapsuleQuality;
    sample.angle_q6 = static_cast<std::uint16_t>(angle_q6(number));
    sample.distance_q2 = static_cast<std::uint16_t>(4U * (500U + 23U * number % 6000U));
    append(encode(sample), all);
  }
  return all;
}

/// From bytes to samples, of either kind.
struct Decoder {
  explicit Decoder(AnswerType type) { reader.expect(type); }

  /// Number of samples that were read.
  std::size_t decode(std::span<const std::uint8_t> portion) {
    std::size_t read = 0;
    for (const rplidar::Answer& answer : reader.read(portion)) {
      if (const auto* capsule = std::get_if<rplidar::ExpressCapsule>(&answer.value)) {
        const auto polar = chain.add(*capsule, answer.after_gap);
        benchmark::DoNotOptimize(polar->data());
        read += polar ? polar->size() : 0;
      } else if (const auto* sample = std::get_if<rplidar::LegacySample>(&answer.value)) {
        const rplidar::PolarSample polar = rplidar::to_polar(*sample);
        benchmark::DoNotOptimize(polar.angle_cw_rad);
        ++read;
      }
    }
    return read;
  }

  rplidar::AnswerReader reader;
  rplidar::CapsuleChain chain;
};

void run(benchmark::State& state, AnswerType type, const Bytes& bytes, std::size_t least,
         double goal = kGoalTimesLine) {
  for (auto _ : state) {
    Decoder decoder(type);
    std::size_t read = 0;
    for_each_portion(bytes, state.range(0), [&](auto portion) { read += decoder.decode(portion); });
    if (read < least) {
      state.SkipWithError("samples are missing");
    }
  }
  report_throughput(state, bytes.size(), kFastestBaud, goal);
}

/// The last capsule waits for its successor, and its successor's predecessor for its angles.
constexpr std::size_t kWholeCapsules = (kCapsules - 2) * rplidar::kCapsuleSamples;
/// Some samples wait for those that confirm them.
constexpr std::size_t kWholeSamples = kSamples * 99 / 100;

void rplidar_capsules(benchmark::State& state) { run(state, AnswerType::kExpressScan, capsules(), kWholeCapsules); }
BENCHMARK(rplidar_capsules)->Arg(kBufferBytes)->Arg(kUsbPacketBytes)->Arg(kSingleByte);

void rplidar_samples(benchmark::State& state) { run(state, AnswerType::kLegacyScan, samples(), kWholeSamples); }
BENCHMARK(rplidar_samples)->Arg(kBufferBytes)->Arg(kUsbPacketBytes)->Arg(kSingleByte);

void rplidar_capsules_damaged(benchmark::State& state) {
  run(state, AnswerType::kExpressScan, damaged(capsules()), kWholeCapsules / 2);
}
BENCHMARK(rplidar_capsules_damaged)->Arg(kUsbPacketBytes);

void rplidar_samples_damaged(benchmark::State& state) {
  run(state, AnswerType::kLegacyScan, damaged(samples()), kWholeSamples / 2);
}
BENCHMARK(rplidar_samples_damaged)->Arg(kUsbPacketBytes);

/// A stream that was announced, and then any bytes.
Bytes announced_noise(std::size_t record_bytes, AnswerType type) {
  Bytes all;
  append(encode(rplidar::Descriptor{static_cast<std::uint32_t>(record_bytes), true, type}), all);
  constexpr std::size_t kNoiseBytes = kCapsules * rplidar::kCapsuleBytes;
  all.reserve(all.size() + kNoiseBytes);
  Rng rng(1);
  for (std::size_t k = 0; k < kNoiseBytes; ++k) {
    all.push_back(static_cast<std::uint8_t>(rng.bits()));
  }
  return all;
}

void rplidar_capsules_noise(benchmark::State& state) {
  run(state, AnswerType::kExpressScan, announced_noise(rplidar::kCapsuleBytes, AnswerType::kExpressScan), 0,
      kGoalTimesLineAtWorst);
}
BENCHMARK(rplidar_capsules_noise)->Arg(kUsbPacketBytes);

void rplidar_samples_noise(benchmark::State& state) {
  run(state, AnswerType::kLegacyScan, announced_noise(rplidar::kLegacyBytes, AnswerType::kLegacyScan), 0,
      kGoalTimesLineAtWorst);
}
BENCHMARK(rplidar_samples_noise)->Arg(kUsbPacketBytes);

}  // namespace

BENCHMARK_MAIN();
