#include "common/image/png.hpp"

#include <cstdlib>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "common/files/files.hpp"
#include "common/image/pgm.hpp"

namespace seeker::image {
namespace {

Image random_image(std::uint64_t seed, int width_px, int height_px, int channels) {
  Rng rng(seed);
  Image image(width_px, height_px, channels);
  for (std::uint8_t& value : image.data()) {
    value = static_cast<std::uint8_t>(rng.below(256));
  }
  return image;
}

std::filesystem::path temporary_file(const std::string& name) {
  return std::filesystem::path(::testing::TempDir()) / ("seeker_image_" + std::to_string(::getpid()) + "_" + name);
}

RC_GTEST_PROP(Png, AnyImageSurvivesTheRoundTrip, ()) {
  const auto width_px = *rc::gen::inRange(1, 70);
  const auto height_px = *rc::gen::inRange(1, 70);
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const Image image = random_image(seed, width_px, height_px, *rc::gen::element(1, 3));
  const auto bytes = encode_png(image);
  RC_ASSERT(bytes.has_value());
  const auto again = decode_png(*bytes);
  RC_ASSERT(again.has_value());
  RC_ASSERT(*again == image);
}

RC_GTEST_PROP(Pgm, AnyGreyImageSurvivesTheRoundTrip, ()) {
  const auto width_px = *rc::gen::inRange(1, 70);
  const auto height_px = *rc::gen::inRange(1, 70);
  const Image image = random_image(*rc::gen::arbitrary<std::uint64_t>(), width_px, height_px, 1);
  const auto again = decode_pgm(encode_pgm(image));
  RC_ASSERT(again.has_value());
  RC_ASSERT(*again == image);
}

TEST(Png, CutAtAnyByteIsATypedErrorOrTheSamePicture) {
  const Image image = random_image(7, 23, 17, 3);
  const auto bytes = encode_png(image);
  ASSERT_TRUE(bytes);
  std::size_t refused = 0;
  for (std::size_t n = 0; n < bytes->size(); ++n) {
    const auto cut = decode_png(std::span(bytes->data(), n));
    if (cut) {
      EXPECT_EQ(*cut, image) << "cut at " << n;  // only the end mark is missing
    } else {
      EXPECT_EQ(cut.error().code, Errc::kCorrupt);
      ++refused;
    }
  }
  EXPECT_GE(refused, bytes->size() - 16);
}

TEST(Png, AFlippedByteNeverCrashes) {
  const auto bytes = encode_png(random_image(3, 16, 9, 1));
  ASSERT_TRUE(bytes);
  for (std::size_t n = 0; n < bytes->size(); ++n) {
    std::vector<std::uint8_t> damaged = *bytes;
    damaged[n] ^= 0x5aU;
    const auto image = decode_png(damaged);
    if (!image) {
      EXPECT_FALSE(image.error().message.empty());
    }
  }
}

TEST(Png, EmptyAndForeignBytesAreRefused) {
  EXPECT_EQ(decode_png({}).error().code, Errc::kCorrupt);
  const std::string text = "this is not a picture at all";
  const auto result = decode_png(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("PNG"), std::string::npos);
}

TEST(Png, MissingFileIsNotFoundAndNamesIt) {
  const auto result = read_png("/no/such/picture.png");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Errc::kNotFound);
  EXPECT_NE(result.error().message.find("/no/such/picture.png"), std::string::npos);
}

TEST(Png, ImageWithoutPixelsIsRefused) { EXPECT_EQ(encode_png(Image()).error().code, Errc::kInvalidArgument); }

TEST(Png, FileIsReplacedAtOnceAndNoTemporaryStays) {
  const auto path = temporary_file("replace.png");
  const Image first = random_image(1, 4, 4, 3);
  const Image second = random_image(2, 5, 3, 1);
  ASSERT_TRUE(write_png(path, first));
  ASSERT_TRUE(write_png(path, second));
  const auto read = read_image(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, second);
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
    EXPECT_EQ(entry.path().string().find(path.string() + ".tmp"), std::string::npos);
  }
  std::filesystem::remove(path);
}

TEST(Png, UnwritableFolderIsAnIoError) {
  const Status status = write_png("/no/such/folder/picture.png", random_image(1, 2, 2, 1));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, Errc::kIo);
}

TEST(Pgm, CommentsAreSkippedAndSmallScalesAreStretched) {
  const std::string text = "P5 # made by hand\n# another\n2 1\n# and one\n5\n\x05\x01";
  const auto image = decode_pgm(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(*image->at(0, 0), 255);
  EXPECT_EQ(*image->at(1, 0), 51);
}

TEST(Pgm, ShortPixelsAndWrongHeadersAreRefused) {
  const auto decode = [](const std::string& text) {
    return decode_pgm(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  };
  EXPECT_EQ(decode("P5 4 4 255 abc").error().code, Errc::kCorrupt);
  EXPECT_EQ(decode("P5 0 4 255 abc").error().code, Errc::kParse);
  EXPECT_EQ(decode("P5 4 4 65535 abc").error().code, Errc::kParse);
  EXPECT_EQ(decode("P5 999999 4 255 abc").error().code, Errc::kTooLarge);
  EXPECT_EQ(decode("P2 1 1 255 1").error().code, Errc::kParse);
  EXPECT_EQ(decode("P5").error().code, Errc::kParse);
}

}  // namespace
}  // namespace seeker::image
