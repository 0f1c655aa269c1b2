#include "common/image/pgm.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "common/files/files.hpp"
#include "common/image/png.hpp"

namespace seeker::image {
namespace {

/// Reads the header's numbers, over white space and comments.
class HeaderReader {
 public:
  explicit HeaderReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::optional<int> number() {
    skip_space();
    constexpr int kLimit = 1'000'000;
    int value = 0;
    bool any = false;
    while (position_ < bytes_.size() && std::isdigit(bytes_[position_]) != 0) {
      value = std::min(kLimit, value * 10 + (bytes_[position_] - '0'));
      ++position_;
      any = true;
    }
    return any ? std::optional<int>(value) : std::nullopt;
  }
  /// The pixels, after the single white space that ends the header.
  std::span<const std::uint8_t> rest() const {
    return position_ < bytes_.size() ? bytes_.subspan(position_ + 1) : std::span<const std::uint8_t>();
  }

 private:
  void skip_space() {
    while (position_ < bytes_.size()) {
      if (bytes_[position_] == '#') {
        while (position_ < bytes_.size() && bytes_[position_] != '\n') {
          ++position_;
        }
      } else if (std::isspace(bytes_[position_]) != 0) {
        ++position_;
      } else {
        return;
      }
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 2;  // after "P5"
};

}  // namespace

Result<Image> decode_pgm(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 2 || bytes[0] != 'P' || bytes[1] != '5') {
    return fail(Errc::kParse, "not a binary PGM (it does not begin with P5)");
  }
  HeaderReader header(bytes);
  const std::optional<int> width_px = header.number();
  const std::optional<int> height_px = header.number();
  const std::optional<int> largest = header.number();
  constexpr int kFullScale = 255;
  if (!width_px || !height_px || !largest || *width_px < 1 || *height_px < 1 || *largest < 1 || *largest > kFullScale) {
    return fail(Errc::kParse, "a PGM header needs width, height and a largest value of 1 to 255");
  }
  if (*width_px > kMaxImageSide_px || *height_px > kMaxImageSide_px) {
    return fail(Errc::kTooLarge, "the picture has more than " + std::to_string(kMaxImageSide_px) + " pixels a side");
  }
  const std::span<const std::uint8_t> pixels = header.rest();
  const std::size_t expected = static_cast<std::size_t>(*width_px) * static_cast<std::size_t>(*height_px);
  if (pixels.size() < expected) {
    return fail(Errc::kCorrupt, "the PGM is cut short: " + std::to_string(pixels.size()) + " of " +
                                    std::to_string(expected) + " pixels are there");
  }
  Image image(*width_px, *height_px, 1);
  std::transform(
      pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(expected), image.data().begin(),
      [&](std::uint8_t value) {
        return static_cast<std::uint8_t>(std::min(kFullScale, (value * kFullScale + *largest / 2) / *largest));
      });
  return image;
}

Result<Image> read_pgm(const std::filesystem::path& path) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path);
  if (!bytes) {
    return tl::unexpected(bytes.error());
  }
  Result<Image> image = decode_pgm(*bytes);
  if (!image) {
    return fail_with_context(path.string(), image.error());
  }
  return image;
}

std::vector<std::uint8_t> encode_pgm(const Image& image, const std::string& comment_lines) {
  const Image grey = to_grey(image);
  const std::string header =
      "P5\n" + comment_lines + std::to_string(grey.width_px()) + " " + std::to_string(grey.height_px()) + "\n255\n";
  std::vector<std::uint8_t> bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), grey.data().begin(), grey.data().end());
  return bytes;
}

Status write_pgm(const std::filesystem::path& path, const Image& image, const std::string& comment_lines) {
  if (image.empty()) {
    return fail(Errc::kInvalidArgument, path.string() + ": an image without pixels cannot be written as PGM");
  }
  return files::write_file(path, encode_pgm(image, comment_lines));
}

Result<Image> read_image(const std::filesystem::path& path) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path);
  if (!bytes) {
    return tl::unexpected(bytes.error());
  }
  const bool is_pgm = bytes->size() >= 2 && (*bytes)[0] == 'P' && (*bytes)[1] == '5';
  Result<Image> image = is_pgm ? decode_pgm(*bytes) : decode_png(*bytes);
  if (!image) {
    return fail_with_context(path.string(), image.error());
  }
  return image;
}

}  // namespace seeker::image
