#include "server/store/map_file.hpp"

#include <filesystem>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/files/files.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/unit/server/store/killed_writer.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::store {
namespace {

using testing::random_map;
using testing::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t kSeed = 20261121;
// Where the fields before the header lie.
constexpr std::size_t kVersionAt = 8;

MapFile example(std::uint64_t seed = kSeed) {
  Rng rng(seed);
  MapFile file;
  file.origin = {.name = "office-2",
                 .robot_id = "seeker-1",
                 .sensors = "lidar with 361 beams",
                 .software_version = "1.2.3",
                 .created_unix_s = 1'790'000'000,
                 .saved_unix_s = 1'790'000'100};
  file.map = random_map(rng);
  return file;
}

Bytes encoded(const MapFile& file) {
  Result<Bytes> bytes = encode_map_file(file);
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes.value_or(Bytes());
}

RC_GTEST_PROP(MapFile, AnyValidMapComesBackAndIsSavedAgainByteForByte, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  MapFile file = example();
  file.map = random_map(rng, {.nodes = *rc::gen::inRange<std::size_t>(0, 6),
                              .segments = *rc::gen::inRange<std::size_t>(0, 50),
                              .keyframes = *rc::gen::inRange<std::size_t>(0, 5),
                              .beams = *rc::gen::inRange<std::size_t>(1, 40)});
  RC_ASSERT(validate(file.map).has_value());
  const Result<Bytes> bytes = encode_map_file(file);
  RC_ASSERT(bytes.has_value());
  const Result<MapFile> back = decode_map_file(*bytes);
  RC_ASSERT(back.has_value());
  RC_ASSERT(*back == file);
  RC_ASSERT(encode_map_file(*back).value() == *bytes);
}

RC_GTEST_PROP(MapFile, OneFlippedBitAnywhereIsATypedError, ()) {
  Bytes bytes = encoded(example());
  const std::size_t at = *rc::gen::inRange<std::size_t>(0, bytes.size());
  bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << *rc::gen::inRange(0U, 8U)));
  const Result<MapFile> back = decode_map_file(bytes);
  RC_ASSERT(!back.has_value());
  RC_ASSERT(!back.error().message.empty());
  const Errc code = back.error().code;
  RC_ASSERT(code == Errc::kCorrupt || code == Errc::kParse || code == Errc::kUnsupportedVersion);
}

TEST(MapFile, CutAtAnyByteIsATypedErrorWithARemedy) {
  const Bytes bytes = encoded(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Result<MapFile> back = decode_map_file(std::span(bytes).first(size));
    ASSERT_FALSE(back) << "cut after " << size << " bytes";
    EXPECT_TRUE(back.error().code == Errc::kCorrupt || back.error().code == Errc::kParse) << back.error().message;
    EXPECT_NE(back.error().message.find(';'), std::string::npos) << "cause; remedy: " << back.error().message;
  }
}

TEST(MapFile, HeaderIsReadWithoutTheBody) {
  const MapFile file = example();
  const Bytes bytes = encoded(file);
  const Result<MapFileHeader> header = decode_map_header(std::span(bytes).first(bytes.size() / 2));
  ASSERT_TRUE(header) << header.error().message;
  EXPECT_EQ(header->origin, file.origin);
  EXPECT_EQ(header->segments, file.map.segments.size());
  EXPECT_EQ(header->keyframes, file.map.keyframes.size());
  EXPECT_EQ(header->nodes, file.map.nodes.size());
}

TEST(MapFile, NewerFormatIsRefusedWithBothVersionsNamed) {
  Bytes bytes = encoded(example());
  bytes[kVersionAt] = 7;
  const Result<MapFile> back = decode_map_file(bytes);
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, Errc::kUnsupportedVersion);
  EXPECT_NE(back.error().message.find("format 7"), std::string::npos) << back.error().message;
  EXPECT_NE(back.error().message.find("up to 1"), std::string::npos) << back.error().message;
}

TEST(MapFile, OtherFilesAreNotTakenForMaps) {
  const std::string text = "image: office.pgm\nresolution: 0.05\n";
  const Result<MapFile> back = decode_map_file(Bytes(text.begin(), text.end()));
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, Errc::kParse);
}

TEST(MapFile, InvalidMapsAndNamesAreNotWritten) {
  MapFile file = example();
  file.origin.name = "../etc";
  EXPECT_EQ(encode_map_file(file).error().code, Errc::kInvalidArgument);
  file = example();
  file.map.segments.front().id = 0;
  EXPECT_EQ(encode_map_file(file).error().code, Errc::kInvalidArgument);
  for (const char* name : {"", "Office", "a b", "a/b", ".", "a.b"}) {
    EXPECT_FALSE(validate_map_name(name)) << name;
  }
  EXPECT_TRUE(validate_map_name("office-2nd_floor"));
  EXPECT_FALSE(validate_map_name(std::string(65, 'a')));
}

TEST(MapFile, LimitsHoldBeforeMemoryIsSpent) {
  const Bytes bytes = encoded(example());
  EXPECT_EQ(decode_map_file(bytes, {.file_bytes = 100}).error().code, Errc::kTooLarge);
  EXPECT_FALSE(decode_map_file(bytes, {.body_bytes = 100}));
  EXPECT_EQ(encode_map_file(example(), {.body_bytes = 100}).error().code, Errc::kTooLarge);
}

TEST(MapFile, FolderThatCannotBeWrittenIsATypedError) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "absent" / "map.seekermap";
  const Status written = write_map_file(path, example());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::kIo);
}

TEST(MapFile, KilledWhileSavingTheFileIsOneOfTheMapsAsAWhole) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "map.seekermap";
  for (std::uint64_t run = 0; run < 20; ++run) {
    const auto save = [&path](std::uint64_t seed) { return write_map_file(path, example(seed)).has_value(); };
    testing::kill_a_writer(save, 1, run * 20'000);
    const Result<MapFile> back = read_map_file(path);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(validate(back->map));
  }
}

}  // namespace
}  // namespace seeker::store
