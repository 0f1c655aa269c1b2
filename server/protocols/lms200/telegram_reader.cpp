#include "server/protocols/lms200/telegram_reader.hpp"

#include <algorithm>

#include "server/protocols/lms200/crc.hpp"
#include "server/protocols/lms200/little_endian.hpp"

namespace seeker::lms200 {
namespace {

constexpr std::size_t kLengthAt = 2;

/// Size of the whole telegram whose header is in front.
std::size_t announced_size(std::span<const std::uint8_t> header) {
  return kHeaderBytes + u16_at(header, kLengthAt) + kCrcBytes;
}

}  // namespace

void TelegramReader::feed(std::span<const std::uint8_t> bytes) {
  origin_ += at_;
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(at_));
  at_ = 0;
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

bool TelegramReader::header_may_begin(std::span<const std::uint8_t> rest) const {
  if (rest[0] != kStx) {
    return false;
  }
  if (rest.size() > 1) {
    const bool addressed =
        sender_ == Sender::kHost ? rest[1] == kHostAddress : rest[1] >= kDeviceAddress && rest[1] <= kLastDeviceAddress;
    if (!addressed) {
      return false;
    }
  }
  if (rest.size() < kHeaderBytes) {
    return true;
  }
  const std::size_t length = u16_at(rest, kLengthAt);
  return length >= 1 && length <= kMaxPayloadBytes;
}

TelegramReader::Candidate TelegramReader::judge(std::span<const std::uint8_t> rest) const {
  if (!header_may_begin(rest)) {
    return Candidate::kNone;
  }
  if (rest.size() < kHeaderBytes || rest.size() < announced_size(rest)) {
    return Candidate::kIncomplete;
  }
  const std::size_t checked = announced_size(rest) - kCrcBytes;
  return crc16(rest.first(checked)) == u16_at(rest, checked) ? Candidate::kGood : Candidate::kWrongCrc;
}

bool TelegramReader::is_acknowledgement() const {
  const std::uint8_t byte = buffer_[at_];
  return sender_ == Sender::kDevice && (byte == kAckByte || byte == kNakByte) && origin_ + at_ >= suspect_until_;
}

Received TelegramReader::take(Received::Kind kind, std::size_t size) {
  Received received;
  received.kind = kind;
  received.first_byte = origin_ + at_;
  received.end_byte = received.first_byte + size;
  if (kind == Received::Kind::kTelegram) {
    const auto first = buffer_.begin() + static_cast<std::ptrdiff_t>(at_);
    received.payload.assign(first + kHeaderBytes, first + static_cast<std::ptrdiff_t>(size - kCrcBytes));
    ++telegrams_;
    suspect_until_ = received.end_byte;  // the end that a damaged length announced before is not believed any more
  }
  at_ += size;
  return received;
}

void TelegramReader::skip_byte() {
  ++at_;
  ++bytes_skipped_;
}

void TelegramReader::give_up_candidate() {
  const std::span<const std::uint8_t> rest = std::span(buffer_).subspan(at_);
  const std::size_t size = rest.size() < kHeaderBytes ? rest.size() : std::min(rest.size(), announced_size(rest));
  suspect_until_ = std::max(suspect_until_, origin_ + at_ + size);
  ++damaged_;
  skip_byte();
}

std::optional<Received> TelegramReader::next() {
  while (at_ < buffer_.size()) {
    const std::span<const std::uint8_t> rest = std::span<const std::uint8_t>(buffer_).subspan(at_);
    switch (judge(rest)) {
      case Candidate::kGood: return take(Received::Kind::kTelegram, announced_size(rest));
      case Candidate::kIncomplete: return std::nullopt;
      case Candidate::kWrongCrc: give_up_candidate(); break;
      case Candidate::kNone:
        if (is_acknowledgement()) {
          return take(rest[0] == kAckByte ? Received::Kind::kAck : Received::Kind::kNak, 1);
        }
        skip_byte();
        break;
    }
  }
  return std::nullopt;
}

void TelegramReader::abandon_partial() {
  if (partial()) {
    give_up_candidate();
  }
}

void TelegramReader::clear() {
  origin_ += buffer_.size();
  bytes_skipped_ += buffer_.size() - at_;
  buffer_.clear();
  at_ = 0;
}

}  // namespace seeker::lms200
