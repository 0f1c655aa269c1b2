/// \file
/// Messages in files with a checksum: what is read of them is trusted as little as what a peer sends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/wire/envelope.hpp"
#include "server/store/sealed_file.hpp"

namespace seeker::app {

/// Errors of store::read_sealed_file() and wire::parse_within_limits().
template <class Message>
[[nodiscard]] Result<Message> read_kept_message(const std::filesystem::path& path, const std::string& kind,
                                                std::size_t limit_bytes) {
  const Result<std::vector<std::uint8_t>> bytes = store::read_sealed_file(path, kind, limit_bytes);
  if (!bytes) {
    return tl::unexpected<Error>(bytes.error());
  }
  Message message;
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (const Status parsed = wire::parse_within_limits(text, message); !parsed) {
    return tl::unexpected<Error>(parsed.error());
  }
  return message;
}

}  // namespace seeker::app
