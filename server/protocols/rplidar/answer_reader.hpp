/// \file
/// Answers out of the bytes that an RPLIDAR sends, as the host reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "server/protocols/rplidar/descriptor.hpp"
#include "server/protocols/rplidar/device_answers.hpp"
#include "server/protocols/rplidar/express_capsule.hpp"
#include "server/protocols/rplidar/legacy_sample.hpp"

namespace seeker::rplidar {

using AnswerValue = std::variant<DeviceInfo, Health, SampleRate, ConfAnswer, AccBoard, LegacySample, ExpressCapsule>;

struct Answer {
  AnswerValue value;
  std::size_t bytes_behind = 0;  ///< bytes that had come after its last one when it was read
  bool after_gap = false;        ///< bytes between it and the record before were lost or damaged
};

struct AnswerCounts {
  std::uint64_t whole = 0;    ///< answers, samples and capsules that were returned
  std::uint64_t damaged = 0;  ///< places in a stream, and answers, that were refused
  std::uint64_t skipped = 0;  ///< bytes of no answer
};

/// Reads one type of answer at a time from bytes cut anywhere; everything else, the text that a scanner prints when it
/// starts too, is skipped. A stream that was announced is followed through lost and damaged bytes: every whole capsule
/// is returned, and of samples all but those beside a loss. Holds less than kMaxStreamLook bytes.
class AnswerReader {
 public:
  /// From now on answers of this type count, as many as come; what was read so far is forgotten.
  void expect(AnswerType type);
  /// Takes all bytes and returns the answers that they complete. A record of a stream is returned when the bytes behind
  /// it confirm it (stream_cut.hpp).
  [[nodiscard]] std::vector<Answer> read(std::span<const std::uint8_t> bytes);
  /// Whether the stream that is expected has been announced.
  [[nodiscard]] bool streaming() const { return stage_ == Stage::kStream; }
  [[nodiscard]] const AnswerCounts& counts() const { return counts_; }

 private:
  enum class Stage : std::uint8_t { kDescriptor, kPayload, kStream };

  [[nodiscard]] bool find_descriptor();
  [[nodiscard]] bool read_payload(std::vector<Answer>& answers);
  [[nodiscard]] bool read_record(std::vector<Answer>& answers);
  [[nodiscard]] std::span<const std::uint8_t> rest() const { return std::span(buffer_).subspan(at_); }
  void skip(std::size_t bytes);

  AnswerType expected_ = AnswerType::kInfo;
  Stage stage_ = Stage::kDescriptor;
  std::size_t length_ = 0;            ///< of the payload that was announced
  std::optional<LegacySample> last_;  ///< the sample returned before
  bool aligned_ = false;              ///< at_ is directly behind a descriptor or a record
  bool gap_ = false;                  ///< bytes were skipped since the last record
  std::vector<std::uint8_t> buffer_;
  std::size_t at_ = 0;
  AnswerCounts counts_;
};

}  // namespace seeker::rplidar
