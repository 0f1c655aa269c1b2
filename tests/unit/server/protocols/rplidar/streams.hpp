/// \file
/// Bytes of scans as a scanner that turns sends them, and what lines do to them.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/rng.hpp"
#include "server/protocols/rplidar/answer_reader.hpp"

namespace seeker::rplidar::testing {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& to, const auto& bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

/// Samples of a scanner that turns about a degree from one to the next.
inline std::vector<LegacySample> turning_samples(std::size_t count, Rng& rng) {
  std::vector<LegacySample> samples;
  samples.reserve(count);
  double angle_q6 = static_cast<double>(rng.below(kRevolutionQ6));
  for (std::size_t k = 0; k < count; ++k) {
    angle_q6 += rng.uniform(30.0, 100.0);
    const bool begins = angle_q6 >= kRevolutionQ6;
    angle_q6 -= begins ? kRevolutionQ6 : 0;
    const auto distance_q2 = static_cast<std::uint16_t>(rng.below(5) == 0 ? 0 : rng.below(48'000));
    samples.push_back({begins, static_cast<std::uint8_t>(distance_q2 == 0 ? 0 : rng.below(64)),
                       static_cast<std::uint16_t>(angle_q6), distance_q2});
  }
  return samples;
}

/// Capsules of a scanner that turns about 20 degrees from one to the next.
inline std::vector<ExpressCapsule> turning_capsules(std::size_t count, Rng& rng) {
  std::vector<ExpressCapsule> capsules(count);
  double angle_q6 = static_cast<double>(rng.below(kRevolutionQ6));
  for (ExpressCapsule& capsule : capsules) {
    capsule.first = &capsule == &capsules.front();
    capsule.start_angle_q6 = static_cast<std::uint16_t>(angle_q6);
    angle_q6 += rng.uniform(1200.0, 1300.0);
    angle_q6 -= angle_q6 >= kRevolutionQ6 ? kRevolutionQ6 : 0;
    for (CapsuleSample& sample : capsule.samples) {
      sample.distance_mm = static_cast<std::uint16_t>(rng.below(kMaxCapsuleDistance_mm + 1U));
      sample.compensation_q3 = static_cast<std::uint8_t>(rng.below(32));
    }
  }
  return capsules;
}

inline Descriptor descriptor_of(const LegacySample& /*sample*/) {
  return {kLegacyBytes, true, AnswerType::kLegacyScan};
}
inline Descriptor descriptor_of(const ExpressCapsule& /*capsule*/) {
  return {kCapsuleBytes, true, AnswerType::kExpressScan};
}

/// Gives the bytes to the reader in pieces of up to `longest` bytes and returns the values of type T that come out.
template <class T>
std::vector<T> read_in_pieces(AnswerReader& reader, const Bytes& bytes, std::size_t longest, Rng& rng) {
  std::vector<T> values;
  std::size_t at = 0;
  while (at < bytes.size()) {
    const std::size_t piece = std::min<std::size_t>(1 + rng.below(longest), bytes.size() - at);
    for (const Answer& answer : reader.read(std::span(bytes).subspan(at, piece))) {
      values.push_back(std::get<T>(answer.value));
    }
    at += piece;
  }
  return values;
}

}  // namespace seeker::rplidar::testing
