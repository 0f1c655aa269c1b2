#include "common/wire/frame.hpp"

#include "common/core/assert.hpp"

namespace seeker::wire {

std::array<char, kFrameHeaderBytes> frame_header(std::size_t payload_bytes) {
  SEEKER_ASSERT(payload_bytes <= kMaxFrameBytes);
  const auto n = static_cast<std::uint32_t>(payload_bytes);
  return {static_cast<char>(n >> 24U), static_cast<char>(n >> 16U), static_cast<char>(n >> 8U), static_cast<char>(n)};
}

OutFrame make_frame(std::string payload) {
  const auto header = frame_header(payload.size());
  return {std::string(header.data(), header.size()), std::make_shared<const std::string>(std::move(payload)), {}};
}

std::optional<std::size_t> FrameDecoder::announced(std::size_t at) const {
  if (buffer_.size() - at < kFrameHeaderBytes) {
    return std::nullopt;
  }
  std::size_t length = 0;
  for (std::size_t k = 0; k < kFrameHeaderBytes; ++k) {
    length = (length << 8U) | static_cast<unsigned char>(buffer_[at + k]);
  }
  return length;
}

Status FrameDecoder::check_lengths() {
  while (checked_ <= buffer_.size()) {
    const std::optional<std::size_t> length = announced(checked_);
    if (!length) {
      return {};
    }
    if (*length > max_payload_bytes_) {
      broken_ = true;
      return fail(Errc::kTooLarge, "the peer announced a frame of " + std::to_string(*length) + " bytes; at most " +
                                       std::to_string(max_payload_bytes_) + " are allowed");
    }
    checked_ += kFrameHeaderBytes + *length;
  }
  return {};
}

Status FrameDecoder::feed(std::string_view bytes) {
  if (broken_) {
    return fail(Errc::kTooLarge, "the peer announced too large a frame before");
  }
  if (begin_ > 0) {
    // What was handed out makes room; amortised, since at most one incomplete frame is moved.
    buffer_.erase(0, begin_);
    checked_ -= begin_;
    begin_ = 0;
  }
  buffer_.append(bytes);
  return check_lengths();
}

std::optional<std::string_view> FrameDecoder::next() {
  const std::optional<std::size_t> length = announced(begin_);
  // Frames before an oversized one are still good.
  if (!length || *length > max_payload_bytes_ || buffer_.size() - begin_ - kFrameHeaderBytes < *length) {
    return std::nullopt;
  }
  const std::string_view payload = std::string_view(buffer_).substr(begin_ + kFrameHeaderBytes, *length);
  begin_ += kFrameHeaderBytes + *length;
  return payload;
}

}  // namespace seeker::wire
