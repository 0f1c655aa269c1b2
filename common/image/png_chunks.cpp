#include "common/image/png_chunks.hpp"

#include <zlib.h>

#include "common/core/assert.hpp"

namespace seeker::image {
namespace {

/// Signature and the chunk IHDR, which is always the first one and always as long.
constexpr std::size_t kHeader_bytes = 8 + 25;
constexpr std::size_t kType_bytes = 4;

void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift & 0xFFU));
  }
}

}  // namespace

std::string png_software_text(std::string_view software) {
  using namespace std::string_literals;
  return "tEXtSoftware\0"s + std::string(software);
}

void insert_png_software(std::vector<std::uint8_t>& png, std::string_view software) {
  SEEKER_ASSERT(png.size() > kHeader_bytes);
  const std::string text = png_software_text(software);
  std::vector<std::uint8_t> chunk;
  append_big_endian(chunk, static_cast<std::uint32_t>(text.size() - kType_bytes));
  chunk.insert(chunk.end(), text.begin(), text.end());
  append_big_endian(chunk, static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(text.data()),
                                                              static_cast<uInt>(text.size()))));
  png.insert(png.begin() + static_cast<std::ptrdiff_t>(kHeader_bytes), chunk.begin(), chunk.end());
}

}  // namespace seeker::image
