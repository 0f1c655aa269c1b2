#include "common/image/png.hpp"

#include <memory>
#include <string>

#include <png.h>

#include "common/files/files.hpp"
#include "common/image/png_chunks.hpp"

namespace seeker::image {
namespace {

/// libpng's simplified interface: it keeps its longjmp inside, so that no C++ object is ever jumped over.
struct PngImage {
  png_image raw{};

  PngImage() { raw.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&raw); }

  [[nodiscard]] std::string message() const { return static_cast<const char*>(raw.message); }
};

Status check_size(unsigned width_px, unsigned height_px) {
  if (width_px > static_cast<unsigned>(kMaxImageSide_px) || height_px > static_cast<unsigned>(kMaxImageSide_px)) {
    return fail(Errc::kTooLarge, "the picture has " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                                     " pixels; give one of at most " + std::to_string(kMaxImageSide_px) + " a side");
  }
  return {};
}

/// Deflate shrinks at most 1032 times and a pixel has at least one bit: a header that promises more is a lie, and
/// memory is not reserved for it.
bool is_plausible(unsigned width_px, unsigned height_px, std::size_t file_size_bytes) {
  constexpr std::size_t kDeflateLimit = 1032;
  constexpr std::size_t kBitsPerByte = 8;
  return static_cast<std::size_t>(width_px) * height_px / kBitsPerByte / kDeflateLimit <= file_size_bytes;
}

}  // namespace

Result<Image> decode_png(std::span<const std::uint8_t> bytes) {
  PngImage png;
  if (png_image_begin_read_from_memory(&png.raw, bytes.data(), bytes.size()) == 0) {
    return fail(Errc::kCorrupt, "not a readable PNG (" + png.message() + ")");
  }
  if (const Status ok = check_size(png.raw.width, png.raw.height); !ok) {
    return tl::unexpected(ok.error());
  }
  if (!is_plausible(png.raw.width, png.raw.height, bytes.size())) {
    return fail(Errc::kCorrupt, "a damaged PNG (it promises more pixels than its bytes can hold)");
  }
  // Without the flag libpng takes 16-bit samples for linear light and brightens them.
  png.raw.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  const bool colour = (png.raw.format & PNG_FORMAT_FLAG_COLOR) != 0;
  png.raw.format = colour ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
  Image image(static_cast<int>(png.raw.width), static_cast<int>(png.raw.height), colour ? 3 : 1);
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&png.raw, &white, image.data().data(), 0, nullptr) == 0) {
    return fail(Errc::kCorrupt, "a damaged PNG (" + png.message() + ")");
  }
  return image;
}

Result<Image> read_png(const std::filesystem::path& path) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path);
  if (!bytes) {
    return tl::unexpected(bytes.error());
  }
  Result<Image> image = decode_png(*bytes);
  if (!image) {
    return fail_with_context(path.string(), image.error());
  }
  return image;
}

Result<std::vector<std::uint8_t>> encode_png(const Image& image, std::string_view software) {
  if (image.empty()) {
    return fail(Errc::kInvalidArgument, "an image without pixels cannot be written as PNG");
  }
  PngImage png;
  png.raw.width = static_cast<png_uint_32>(image.width_px());
  png.raw.height = static_cast<png_uint_32>(image.height_px());
  png.raw.format = image.channels() == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
  if (const Status ok = check_size(png.raw.width, png.raw.height); !ok) {
    return tl::unexpected(ok.error());
  }
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.raw);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&png.raw, bytes.data(), &size, 0, image.data().data(), 0, nullptr) == 0) {
    return fail(Errc::kInternal, "libpng cannot encode the image (" + png.message() + ")");
  }
  bytes.resize(size);
  if (!software.empty()) {
    insert_png_software(bytes, software);
  }
  return bytes;
}

Status write_png(const std::filesystem::path& path, const Image& image, std::string_view software) {
  const Result<std::vector<std::uint8_t>> bytes = encode_png(image, software);
  if (!bytes) {
    return fail_with_context(path.string(), bytes.error());
  }
  return files::write_file(path, *bytes);
}

}  // namespace seeker::image
