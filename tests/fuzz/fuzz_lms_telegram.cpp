// The telegrams of the LMS200 in both directions: any bytes in any chunks. The first byte chooses the chunk size and
// the sender.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/assert.hpp"
#include "server/protocols/lms200/commands.hpp"
#include "server/protocols/lms200/responses.hpp"
#include "server/protocols/lms200/scan_telegram.hpp"
#include "server/protocols/lms200/status_block.hpp"
#include "server/protocols/lms200/telegram_reader.hpp"

namespace {

using seeker::lms200::Received;
using seeker::lms200::Sender;
using Bytes = std::vector<std::uint8_t>;

/// What is accepted is written back as the same bytes, where every byte has a meaning.
void check_command(const Bytes& payload) {
  if (const auto command = seeker::lms200::decode_command(payload)) {
    SEEKER_ASSERT(seeker::lms200::encode(*command) == payload);
  }
}

void check_response(const Bytes& payload) {
  namespace lms = seeker::lms200;
  const std::uint8_t status = payload.back();
  if (const auto errors = lms::decode_errors(payload); errors && payload[0] == lms::response_code::kErrors) {
    SEEKER_ASSERT(lms::encode(*errors, status) == payload);
  }
  if (const auto config = lms::decode_config_reply(payload); config && payload[0] == lms::response_code::kConfig) {
    SEEKER_ASSERT(lms::encode_config(*config, status) == payload);
  }
  if (const auto text = lms::decode_text(payload)) {
    SEEKER_ASSERT(text->size() + 2 == payload.size());
  }
  if (const auto block = lms::decode_status_block(payload)) {
    SEEKER_ASSERT(lms::decode_status_block(lms::encode(*block, status)).value() == *block);
  }
  for (const bool real_time : {false, true}) {
    if (const auto scan = lms::decode_scan(payload, real_time)) {
      SEEKER_ASSERT(scan->words.size() <= lms::ScanTelegram::kMaxValues);
      SEEKER_ASSERT(lms::decode_scan(lms::encode(*scan, status), real_time).value() == *scan);
    }
  }
  (void)lms::decode_mode_result(payload);
  (void)lms::decode_variant(payload);
  (void)lms::decode_config_written(payload);
}

void check(const Received& received, Sender sender, std::uint64_t& end) {
  SEEKER_ASSERT(received.first_byte >= end && received.end_byte > received.first_byte);
  end = received.end_byte;
  if (received.kind != Received::Kind::kTelegram) {
    return;
  }
  SEEKER_ASSERT(received.end_byte - received.first_byte ==
                received.payload.size() + seeker::lms200::kHeaderBytes + seeker::lms200::kCrcBytes);
  sender == Sender::kHost ? check_command(received.payload) : check_response(received.payload);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const Sender sender = data[0] % 2 == 0 ? Sender::kHost : Sender::kDevice;
  const std::size_t chunk = std::size_t{data[0]} / 2 + 1;
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  if (!bytes.empty() && bytes.size() <= seeker::lms200::kMaxPayloadBytes) {
    const Bytes payload(bytes.begin(), bytes.end());
    sender == Sender::kHost ? check_command(payload) : check_response(payload);
  }
  seeker::lms200::TelegramReader reader(sender);
  std::uint64_t end = 0;
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    reader.feed(bytes.subspan(at, std::min(chunk, bytes.size() - at)));
    while (const auto received = reader.next()) {
      check(*received, sender, end);
    }
  }
  while (reader.partial()) {
    reader.abandon_partial();
    while (const auto received = reader.next()) {
      check(*received, sender, end);
    }
  }
  SEEKER_ASSERT(reader.bytes_in() == bytes.size());
  SEEKER_ASSERT(end <= bytes.size());
  return 0;
}
