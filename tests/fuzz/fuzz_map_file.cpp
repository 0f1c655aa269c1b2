/// \file
/// Map files come from disks and from clients: whatever lies there is refused or becomes a valid map, and what was read
/// is written again byte for byte. The checksums would stop every mutation, so the input also goes in with correct
/// ones.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/assert.hpp"
#include "server/store/map_file.hpp"
#include "server/store/map_file_bytes.hpp"
#include "server/store/pack.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr seeker::store::MapFileLimits kLimits{std::size_t{1} << 20U, std::size_t{1} << 22U};
constexpr std::size_t kBeforeHeader_bytes = 16;

void read(std::span<const std::uint8_t> bytes) {
  static_cast<void>(seeker::store::decode_map_header(bytes));
  const auto file = seeker::store::decode_map_file(bytes, kLimits);
  if (file) {
    SEEKER_ASSERT(seeker::validate(file->map).has_value());
    const auto again = seeker::store::encode_map_file(*file);
    SEEKER_ASSERT(again.has_value());
    const auto back = seeker::store::decode_map_file(*again);
    SEEKER_ASSERT(back.has_value());
  }
}

/// The input as the body of a file whose header is right in length and checksum.
Bytes around_body(std::span<const std::uint8_t> body) {
  const seeker::store::MapFile empty{
      {.name = "fuzz", .robot_id = "", .sensors = "", .software_version = "", .created_unix_s = 0, .saved_unix_s = 0},
      {}};
  const Bytes file = seeker::store::encode_map_file(empty).value();
  const std::span<const std::uint8_t> all(file);
  seeker::store::ByteReader in(all.subspan(kBeforeHeader_bytes - 4));
  std::uint32_t header_bytes = 0;
  in.get(header_bytes);
  const Bytes frame = seeker::store::pack(body).value();
  seeker::store::ByteWriter out;
  // The header ends with the sizes of body and frame.
  out.put(all.first(kBeforeHeader_bytes + header_bytes - 2 * sizeof(std::uint64_t)));
  out.put(static_cast<std::uint64_t>(body.size()));
  out.put(static_cast<std::uint64_t>(frame.size()));
  out.put(seeker::store::crc32(out.bytes()));
  out.put(std::span<const std::uint8_t>(frame));
  out.put(seeker::store::crc32(out.bytes()));
  return out.take();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  read(input);
  read(around_body(input));
  return 0;
}
