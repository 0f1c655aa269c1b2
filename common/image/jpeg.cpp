#include "common/image/jpeg.hpp"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <jpeglib.h>

#include "common/core/assert.hpp"
#include "common/files/files.hpp"
#include "common/image/png.hpp"

namespace seeker::image {
namespace {

/// libjpeg reports an error by a jump. Every function below that may be jumped out of owns nothing.
struct Decoder {
  jpeg_decompress_struct raw{};
  jpeg_error_mgr errors{};
  std::jmp_buf on_error{};
  std::array<char, JMSG_LENGTH_MAX> message{};

  Decoder() {
    raw.err = jpeg_std_error(&errors);
    raw.client_data = this;
    errors.error_exit = [](j_common_ptr common) {
      auto* decoder = static_cast<Decoder*>(common->client_data);
      common->err->format_message(common, decoder->message.data());
      std::longjmp(decoder->on_error, 1);
    };
    // A warning means bytes that are damaged or missing: part of the picture would be made up.
    errors.emit_message = [](j_common_ptr common, int level) {
      if (level < 0) {
        common->err->error_exit(common);
      }
    };
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { jpeg_destroy_decompress(&raw); }
};

bool read_header(Decoder& decoder, std::span<const std::uint8_t> bytes) {
  if (setjmp(decoder.on_error) != 0) {
    return false;
  }
  jpeg_create_decompress(&decoder.raw);
  jpeg_mem_src(&decoder.raw, bytes.data(), static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&decoder.raw, TRUE);
  decoder.raw.out_color_space = decoder.raw.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  return true;
}

bool read_pixels(Decoder& decoder, Image& image) {
  if (setjmp(decoder.on_error) != 0) {
    return false;
  }
  jpeg_start_decompress(&decoder.raw);
  while (decoder.raw.output_scanline < decoder.raw.output_height) {
    JSAMPROW row = image.at(0, static_cast<int>(decoder.raw.output_scanline));
    jpeg_read_scanlines(&decoder.raw, &row, 1);
  }
  jpeg_finish_decompress(&decoder.raw);
  return true;
}

/// libjpeg's own error exit ends the program, which only a bug can reach: everything that it is given is valid.
struct Encoder {
  jpeg_compress_struct raw{};
  jpeg_error_mgr errors{};
  unsigned char* bytes = nullptr;
  unsigned long size = 0;

  Encoder() {
    raw.err = jpeg_std_error(&errors);
    jpeg_create_compress(&raw);
    jpeg_mem_dest(&raw, &bytes, &size);
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() {
    jpeg_destroy_compress(&raw);
    std::free(bytes);  // NOLINT: libjpeg allocates by malloc
  }
};

tl::unexpected<Error> corrupt(const Decoder& decoder) {
  return fail(Errc::kCorrupt, "not a readable JPEG (" + std::string(decoder.message.data()) + ")");
}

}  // namespace

Result<Image> decode_jpeg(std::span<const std::uint8_t> bytes) {
  Decoder decoder;
  if (!read_header(decoder, bytes)) {
    return corrupt(decoder);
  }
  if (std::max(decoder.raw.image_width, decoder.raw.image_height) > static_cast<unsigned>(kMaxImageSide_px)) {
    return fail(Errc::kTooLarge, "the picture has " + std::to_string(decoder.raw.image_width) + "x" +
                                     std::to_string(decoder.raw.image_height) + " pixels; give one of at most " +
                                     std::to_string(kMaxImageSide_px) + " a side");
  }
  Image image(static_cast<int>(decoder.raw.image_width), static_cast<int>(decoder.raw.image_height),
              decoder.raw.num_components == 1 ? 1 : 3);
  if (!read_pixels(decoder, image)) {
    return corrupt(decoder);
  }
  return image;
}

std::vector<std::uint8_t> encode_jpeg(const Image& image, int quality) {
  constexpr int kBest = 100;
  SEEKER_ASSERT(!image.empty() && quality >= 1 && quality <= kBest);
  Encoder encoder;
  encoder.raw.image_width = static_cast<JDIMENSION>(image.width_px());
  encoder.raw.image_height = static_cast<JDIMENSION>(image.height_px());
  encoder.raw.input_components = image.channels();
  encoder.raw.in_color_space = image.channels() == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&encoder.raw);
  jpeg_set_quality(&encoder.raw, quality, TRUE);
  jpeg_start_compress(&encoder.raw, TRUE);
  while (encoder.raw.next_scanline < encoder.raw.image_height) {
    // libjpeg takes rows as writable and does not write to them.
    JSAMPROW row = const_cast<JSAMPROW>(image.at(0, static_cast<int>(encoder.raw.next_scanline)));
    jpeg_write_scanlines(&encoder.raw, &row, 1);
  }
  jpeg_finish_compress(&encoder.raw);
  return {encoder.bytes, encoder.bytes + encoder.size};
}

Result<Image> read_picture(const std::filesystem::path& path) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path);
  if (!bytes) {
    return tl::unexpected(bytes.error());
  }
  constexpr std::array<std::uint8_t, 2> kJpegStart = {0xFF, 0xD8};
  const bool jpeg =
      bytes->size() >= kJpegStart.size() && std::equal(kJpegStart.begin(), kJpegStart.end(), bytes->begin());
  Result<Image> image = jpeg ? decode_jpeg(*bytes) : decode_png(*bytes);
  if (!image) {
    return fail_with_context(path.string(), image.error());
  }
  return image;
}

}  // namespace seeker::image
