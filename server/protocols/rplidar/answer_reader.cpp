#include "server/protocols/rplidar/answer_reader.hpp"

#include <utility>

#include "server/protocols/rplidar/stream_cut.hpp"

namespace seeker::rplidar {
namespace {

bool is_stream(AnswerType type) { return type == AnswerType::kLegacyScan || type == AnswerType::kExpressScan; }

/// Whether the descriptor announces an answer of its type as it must be.
bool possible(const Descriptor& descriptor) {
  const auto is = [&](std::size_t length) { return descriptor.length == length; };
  if (descriptor.stream != is_stream(descriptor.type)) {
    return false;
  }
  switch (descriptor.type) {
    case AnswerType::kInfo: return is(kInfoBytes);
    case AnswerType::kHealth: return is(kHealthBytes);
    case AnswerType::kSampleRate: return is(kSampleRateBytes);
    case AnswerType::kConf: return descriptor.length >= kConfTypeBytes && descriptor.length <= kMaxConfBytes;
    case AnswerType::kLegacyScan: return is(kLegacyBytes);
    case AnswerType::kExpressScan: return is(kCapsuleBytes);
    case AnswerType::kAccBoard: return is(kAccBoardBytes);
  }
  return false;
}

template <class T>
std::optional<AnswerValue> as_value(std::optional<T> decoded) {
  return decoded ? std::optional<AnswerValue>(std::move(*decoded)) : std::nullopt;
}

std::optional<AnswerValue> decode(AnswerType type, std::span<const std::uint8_t> payload) {
  switch (type) {
    case AnswerType::kInfo: return as_value(decode_info(payload));
    case AnswerType::kHealth: return as_value(decode_health(payload));
    case AnswerType::kSampleRate: return as_value(decode_sample_rate(payload));
    case AnswerType::kConf: return as_value(decode_conf(payload));
    case AnswerType::kAccBoard: return as_value(decode_acc_board(payload));
    case AnswerType::kLegacyScan: return as_value(decode_legacy(payload));
    case AnswerType::kExpressScan: return as_value(decode_capsule(payload));
  }
  return std::nullopt;
}

}  // namespace

void AnswerReader::expect(AnswerType type) {
  expected_ = type;
  stage_ = Stage::kDescriptor;
  buffer_.clear();
  at_ = 0;
  last_.reset();
}

std::vector<Answer> AnswerReader::read(std::span<const std::uint8_t> bytes) {
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  std::vector<Answer> answers;
  if (stage_ == Stage::kStream) {
    answers.reserve(bytes.size() / length_);
  }
  bool more = true;
  while (more) {
    switch (stage_) {
      case Stage::kDescriptor: more = find_descriptor(); break;
      case Stage::kPayload: more = read_payload(answers); break;
      case Stage::kStream: more = read_record(answers); break;
    }
  }
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(at_));
  at_ = 0;
  return answers;
}

bool AnswerReader::find_descriptor() {
  while (rest().size() >= kDescriptorBytes) {
    const std::optional<Descriptor> descriptor = decode_descriptor(rest());
    if (!descriptor || descriptor->type != expected_ || !possible(*descriptor)) {
      skip(1);
      continue;
    }
    at_ += kDescriptorBytes;
    length_ = descriptor->length;
    stage_ = descriptor->stream ? Stage::kStream : Stage::kPayload;
    aligned_ = true;
    gap_ = false;
    return true;
  }
  return false;
}

bool AnswerReader::read_payload(std::vector<Answer>& answers) {
  if (rest().size() < length_) {
    return false;
  }
  stage_ = Stage::kDescriptor;
  std::optional<AnswerValue> value = decode(expected_, rest().first(length_));
  if (!value) {
    ++counts_.damaged;  // its bytes may hold the next descriptor
    return true;
  }
  at_ += length_;
  ++counts_.whole;
  answers.push_back({std::move(*value), rest().size(), false});
  return true;
}

bool AnswerReader::read_record(std::vector<Answer>& answers) {
  const bool legacy = expected_ == AnswerType::kLegacyScan;
  const std::optional<StreamCut> cut = legacy ? cut_legacy(rest(), last_) : cut_capsule(rest(), aligned_);
  if (!cut) {
    return false;
  }
  skip(cut->skip);
  aligned_ = cut->record;
  if (cut->skip > 0 && !gap_) {
    gap_ = true;
    ++counts_.damaged;
  }
  if (!cut->record) {
    return true;
  }
  const std::size_t length = legacy ? kLegacyBytes : kCapsuleBytes;
  std::optional<AnswerValue> value = decode(expected_, rest().first(length));
  if (!value) {
    skip(1);
    return true;
  }
  if (legacy) {
    last_ = std::get<LegacySample>(*value);
  }
  at_ += length;
  ++counts_.whole;
  answers.push_back({std::move(*value), rest().size(), std::exchange(gap_, false)});
  return true;
}

void AnswerReader::skip(std::size_t bytes) {
  at_ += bytes;
  counts_.skipped += bytes;
}

}  // namespace seeker::rplidar
