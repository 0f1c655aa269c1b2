/// \file
/// Any bytes as a PNG, PGM or JPEG: a picture within the bounds or a typed error; what was read can be written again.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "common/image/jpeg.hpp"
#include "common/image/pgm.hpp"
#include "common/image/png.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  for (const auto& image :
       {seeker::image::decode_png(bytes), seeker::image::decode_pgm(bytes), seeker::image::decode_jpeg(bytes)}) {
    constexpr std::size_t kSmall_bytes = 65536;
    if (image && image->data().size() < kSmall_bytes) {
      const auto again = seeker::image::encode_png(*image);
      if (!again || seeker::image::decode_png(*again) != image) {
        std::abort();
      }
    }
  }
  return 0;
}
