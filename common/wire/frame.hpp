/// \file
/// Frames: a big-endian length of four bytes, followed by a payload of that many bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/core/result.hpp"
#include "common/wire/limits.hpp"

namespace seeker::wire {

[[nodiscard]] std::array<char, kFrameHeaderBytes> frame_header(std::size_t payload_bytes);

/// A frame ready to be written, in up to three pieces, so that the large middle one is shared by all receivers.
struct OutFrame {
  std::string head;                         ///< length prefix and what comes before the body
  std::shared_ptr<const std::string> body;  ///< may be null
  std::string tail;

  [[nodiscard]] std::size_t size() const { return head.size() + (body ? body->size() : 0) + tail.size(); }
};

/// A frame around one payload; the payload is at most kMaxFrameBytes.
[[nodiscard]] OutFrame make_frame(std::string payload);

/// Cuts a byte stream into payloads. The length is checked as soon as it is known, before memory is spent on it.
class FrameDecoder {
 public:
  explicit FrameDecoder(std::size_t max_payload_bytes = kMaxFrameBytes) : max_payload_bytes_(max_payload_bytes) {}

  /// Takes received bytes, in any portions. kTooLarge: the peer has announced too large a frame; the connection cannot
  /// be used any more.
  [[nodiscard]] Status feed(std::string_view bytes);
  /// The next complete payload, which stays valid until the next feed(); std::nullopt when more bytes are needed.
  [[nodiscard]] std::optional<std::string_view> next();
  /// Number of bytes that were fed and not returned by next() yet.
  [[nodiscard]] std::size_t pending_bytes() const { return buffer_.size() - begin_; }

 private:
  [[nodiscard]] std::optional<std::size_t> announced(std::size_t at) const;
  [[nodiscard]] Status check_lengths();

  std::size_t max_payload_bytes_;
  std::string buffer_;
  std::size_t begin_ = 0;    ///< of the first payload not handed out, with its header
  std::size_t checked_ = 0;  ///< header positions before this were checked
  bool broken_ = false;
};

}  // namespace seeker::wire
