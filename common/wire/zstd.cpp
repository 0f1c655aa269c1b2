#include "common/wire/zstd.hpp"

#include <zstd.h>

#include "common/core/assert.hpp"

namespace seeker::wire {
namespace {
/// The fastest of the ordinary levels: tiles and masks are mostly constant.
constexpr int kLevel = 1;
}  // namespace

std::string compress(std::span<const std::uint8_t> bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  SEEKER_ASSERT(ZSTD_isError(size) == 0U);
  out.resize(size);
  return out;
}

Status decompress(const std::string& frame, std::span<std::uint8_t> out) {
  // The destination has the size we allow: zstd never writes beyond it, even if the frame claims more.
  const std::size_t size = ZSTD_decompress(out.data(), out.size(), frame.data(), frame.size());
  if (ZSTD_isError(size) != 0U || size != out.size()) {
    return fail(Errc::kCorrupt, "is no zstd frame of exactly " + std::to_string(out.size()) + " bytes");
  }
  return {};
}

}  // namespace seeker::wire
