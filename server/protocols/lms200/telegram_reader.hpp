/// \file
/// Telegrams out of a stream of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/protocols/lms200/telegram.hpp"

namespace seeker::lms200 {

/// What the reader found next: a telegram, or a byte that acknowledges one.
struct Received {
  enum class Kind : std::uint8_t { kTelegram, kAck, kNak };

  Kind kind = Kind::kTelegram;
  std::vector<std::uint8_t> payload;  ///< of a telegram: from the command or response byte to the status byte
  std::uint64_t first_byte = 0;       ///< index in the stream of the first byte
  std::uint64_t end_byte = 0;         ///< index in the stream of the byte behind the last

  friend bool operator==(const Received&, const Received&) = default;
};

/// Finds the telegrams of one sender in bytes that come in any pieces, between garbage and damaged telegrams. What
/// looks like a telegram and is none is given up by one byte only, so that a good telegram inside it is still found.
/// Memory is bounded by the bytes of one call and one telegram.
class TelegramReader {
 public:
  explicit TelegramReader(Sender sender) : sender_(sender) {}

  /// Adds bytes of the stream. The caller then takes everything by next().
  void feed(std::span<const std::uint8_t> bytes);
  /// The next telegram or acknowledgement. Nothing: more bytes are needed. Acknowledgements are found between telegrams
  /// of the device only, and not among the bytes of a damaged telegram.
  [[nodiscard]] std::optional<Received> next();
  /// The sender has paused for longer than inside a telegram: the rest of a telegram that began will not come. next()
  /// then finds what lies inside the bytes so far.
  void abandon_partial();
  /// Whether a telegram has begun and waits for more bytes.
  [[nodiscard]] bool partial() const { return at_ < buffer_.size(); }
  /// Forgets bytes that were not yet taken, for a line whose input was dropped.
  void clear();

  /// Number of bytes that were fed.
  [[nodiscard]] std::uint64_t bytes_in() const { return origin_ + buffer_.size(); }
  [[nodiscard]] std::uint64_t bytes_skipped() const { return bytes_skipped_; }
  [[nodiscard]] std::uint64_t telegrams() const { return telegrams_; }
  /// Number of candidates that were whole and had a wrong checksum, or that remained incomplete.
  [[nodiscard]] std::uint64_t damaged() const { return damaged_; }

 private:
  enum class Candidate : std::uint8_t { kNone, kIncomplete, kWrongCrc, kGood };

  [[nodiscard]] Candidate judge(std::span<const std::uint8_t> rest) const;
  [[nodiscard]] bool header_may_begin(std::span<const std::uint8_t> rest) const;
  [[nodiscard]] Received take(Received::Kind kind, std::size_t size);
  [[nodiscard]] bool is_acknowledgement() const;
  void give_up_candidate();
  void skip_byte();

  Sender sender_;
  std::vector<std::uint8_t> buffer_;
  std::size_t at_ = 0;               ///< index in the buffer of the first byte that is not used up
  std::uint64_t origin_ = 0;         ///< index in the stream of the buffer's first byte
  std::uint64_t suspect_until_ = 0;  ///< up to here the stream belongs to damaged telegrams
  std::uint64_t bytes_skipped_ = 0;
  std::uint64_t telegrams_ = 0;
  std::uint64_t damaged_ = 0;
};

}  // namespace seeker::lms200
