/// \file
/// Bytes of telegrams for tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "server/protocols/lms200/telegram.hpp"
#include "server/protocols/lms200/telegram_reader.hpp"

namespace seeker::lms200 {

using Bytes = std::vector<std::uint8_t>;

/// "02 00 0A" -> its three bytes.
inline Bytes bytes_of(const std::string& hex) {
  std::istringstream in(hex);
  Bytes bytes;
  for (unsigned byte = 0; in >> std::hex >> byte;) {
    bytes.push_back(static_cast<std::uint8_t>(byte));
  }
  return bytes;
}

inline void append(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

/// Everything the reader finds in these bytes, given `chunk` at a time.
inline std::vector<Received> all_received(TelegramReader& reader, const Bytes& bytes, std::size_t chunk) {
  std::vector<Received> all;
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    reader.feed(std::span(bytes).subspan(at, std::min(chunk, bytes.size() - at)));
    while (const auto received = reader.next()) {
      all.push_back(*received);
    }
  }
  return all;
}

/// The payloads of the telegrams among them.
inline std::vector<Bytes> payloads_of(const std::vector<Received>& all) {
  std::vector<Bytes> payloads;
  for (const Received& received : all) {
    if (received.kind == Received::Kind::kTelegram) {
      payloads.push_back(received.payload);
    }
  }
  return payloads;
}

}  // namespace seeker::lms200
