// The frame codec: any bytes in any chunks. The first byte chooses the chunk size.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/core/assert.hpp"
#include "common/wire/frame.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::size_t chunk = std::size_t{data[0]} + 1;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr std::size_t kLimit = 1000;
  seeker::wire::FrameDecoder decoder(kLimit);
  std::size_t out = 0;
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    const bool fed = decoder.feed(bytes.substr(at, chunk)).has_value();
    while (const auto payload = decoder.next()) {
      SEEKER_ASSERT(payload->size() <= kLimit);
      out += payload->size() + seeker::wire::kFrameHeaderBytes;
    }
    if (!fed) {
      break;
    }
  }
  SEEKER_ASSERT(out <= bytes.size());
  return 0;
}
