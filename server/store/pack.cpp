#include "server/store/pack.hpp"

#include <memory>
#include <string>

#include <zstd.h>

namespace seeker::store {

Result<std::vector<std::uint8_t>> pack(std::span<const std::uint8_t> bytes) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  if (context == nullptr || ZSTD_isError(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1)) != 0U) {
    return fail(Errc::kInternal, "the compressor cannot be set up; free memory");
  }
  std::vector<std::uint8_t> frame(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress2(context.get(), frame.data(), frame.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0U) {
    return fail(Errc::kInternal, std::string("cannot compress: ") + ZSTD_getErrorName(size));
  }
  frame.resize(size);
  return frame;
}

Result<std::vector<std::uint8_t>> unpack(std::span<const std::uint8_t> frame, std::size_t limit_bytes) {
  const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) {
    return fail(Errc::kCorrupt, "compressed data are damaged: no valid header");
  }
  // Checked before anything is reserved: the header comes from the disk.
  if (size > limit_bytes) {
    return fail(Errc::kTooLarge, "compressed data would unpack to " + std::to_string(size) + " bytes, the limit is " +
                                     std::to_string(limit_bytes));
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  const std::size_t got = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
  if (ZSTD_isError(got) != 0U || got != bytes.size()) {
    return fail(Errc::kCorrupt, std::string("compressed data are damaged: ") +
                                    (ZSTD_isError(got) != 0U ? ZSTD_getErrorName(got) : "wrong length"));
  }
  return bytes;
}

}  // namespace seeker::store
