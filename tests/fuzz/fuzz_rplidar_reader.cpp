/// \file
/// Any bytes as those of an RPLIDAR and as those of its host. The first byte chooses the answer that is expected and
/// the size of the pieces.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/protocols/rplidar/answer_reader.hpp"
#include "server/protocols/rplidar/capsule_chain.hpp"
#include "server/protocols/rplidar/request_reader.hpp"
#include "server/protocols/rplidar/stream_cut.hpp"

namespace {

using namespace seeker::rplidar;

constexpr std::array kTypes{AnswerType::kInfo,    AnswerType::kHealth,     AnswerType::kSampleRate,
                            AnswerType::kConf,    AnswerType::kLegacyScan, AnswerType::kExpressScan,
                            AnswerType::kAccBoard};

void check(const PolarSample& sample) {
  SEEKER_ASSERT(sample.angle_cw_rad >= 0.0 && sample.angle_cw_rad < seeker::kTwoPi);
  SEEKER_ASSERT(sample.range_m > 0.0F && (std::isfinite(sample.range_m) || sample.quality == 0));
}

/// Returns the bytes of the answer, without its descriptor.
std::size_t check(const Answer& answer, CapsuleChain& chain) {
  if (const auto* capsule = std::get_if<ExpressCapsule>(&answer.value)) {
    SEEKER_ASSERT(decode_capsule(encode(*capsule)) == *capsule);
    if (const auto samples = chain.add(*capsule, answer.after_gap)) {
      for (const PolarSample& sample : *samples) {
        check(sample);
      }
    }
    return kCapsuleBytes;
  }
  if (const auto* sample = std::get_if<LegacySample>(&answer.value)) {
    SEEKER_ASSERT(decode_legacy(encode(*sample)) == *sample);
    check(to_polar(*sample));
    return kLegacyBytes;
  }
  if (const auto* conf = std::get_if<ConfAnswer>(&answer.value)) {
    SEEKER_ASSERT(conf->data.size() + kConfTypeBytes <= kMaxConfBytes);
    return conf->data.size() + kConfTypeBytes;
  }
  return 0;
}

void read_as_host(AnswerType type, std::span<const std::uint8_t> bytes, std::size_t piece) {
  AnswerReader reader;
  reader.expect(type);
  CapsuleChain chain;
  std::size_t taken = 0;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    for (const Answer& answer : reader.read(bytes.subspan(at, std::min(piece, bytes.size() - at)))) {
      SEEKER_ASSERT(answer.bytes_behind < bytes.size());
      taken += check(answer, chain);
    }
  }
  SEEKER_ASSERT(taken + reader.counts().skipped <= bytes.size());
  if (reader.streaming()) {
    SEEKER_ASSERT(taken + reader.counts().skipped + kDescriptorBytes + kMaxStreamLook > bytes.size());
  }
}

void read_as_device(std::span<const std::uint8_t> bytes, std::size_t piece) {
  RequestReader reader;
  std::size_t taken = 0;
  const auto count = [&](const std::vector<Request>& requests) {
    for (const Request& request : requests) {
      taken += encode(request).size();
    }
  };
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    count(reader.read(bytes.subspan(at, std::min(piece, bytes.size() - at))));
  }
  count(reader.give_up());
  SEEKER_ASSERT(!reader.waits() && taken <= bytes.size());
}

}  // namespace

// NOLINTNEXTLINE: the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::span bytes(data + 1, size - 1);
  const std::size_t piece = 1 + data[0] / kTypes.size();
  read_as_host(kTypes[data[0] % kTypes.size()], bytes, piece);
  read_as_device(bytes, piece);
  return 0;
}
