#include "server/store/sealed_file.hpp"

#include <algorithm>
#include <array>

#include "common/files/files.hpp"
#include "server/store/map_file_bytes.hpp"

namespace seeker::store {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic{'S', 'E', 'E', 'K', 'R', 'R', 'E', 'C'};

tl::unexpected<Error> damaged() {
  return fail(Errc::kCorrupt, "the file is cut off or altered; remove it, or put a copy of it back");
}

}  // namespace

std::vector<std::uint8_t> seal(const std::string& kind, std::span<const std::uint8_t> content) {
  ByteWriter out;
  out.put(std::span<const std::uint8_t>(kMagic));
  out.put(kSealedFileVersion);
  out.put(kind);
  out.put(static_cast<std::uint32_t>(content.size()));
  out.put(content);
  out.put(crc32(out.bytes()));
  return out.take();
}

Result<std::vector<std::uint8_t>> unseal(const std::string& kind, std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const std::span<const std::uint8_t> magic = in.take(kMagic.size());
  std::uint32_t version = 0;
  in.get(version);
  if (!in.ok() || !std::equal(magic.begin(), magic.end(), kMagic.begin())) {
    return fail(Errc::kParse, "this is no file of a robot's memory");
  }
  if (version > kSealedFileVersion) {
    return fail(Errc::kUnsupportedVersion, "the file has version " + std::to_string(version) +
                                               ", this program reads up to version " +
                                               std::to_string(kSealedFileVersion) + "; use a newer program");
  }
  std::string its_kind;
  std::uint32_t size = 0;
  in.get(its_kind);
  in.get(size);
  const std::span<const std::uint8_t> content = in.take(size);
  const std::size_t covered = bytes.size() - in.left();
  std::uint32_t crc = 0;
  in.get(crc);
  if (!in.ok() || in.left() != 0 || crc != crc32(bytes.first(covered))) {
    return damaged();
  }
  if (its_kind != kind) {
    return fail(Errc::kParse, "the file holds something else than a '" + kind + "'");
  }
  return std::vector<std::uint8_t>(content.begin(), content.end());
}

Status write_sealed_file(const std::filesystem::path& path, const std::string& kind, std::string_view content,
                         files::Outlives outlives) {
  if (Status made = files::make_folder(path.parent_path()); !made) {
    return made;
  }
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
  return files::write_file(path, seal(kind, bytes), outlives);
}

Result<std::vector<std::uint8_t>> read_sealed_file(const std::filesystem::path& path, const std::string& kind,
                                                   std::size_t limit_bytes) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path, limit_bytes);
  if (!bytes) {
    return tl::unexpected<Error>(bytes.error());
  }
  Result<std::vector<std::uint8_t>> content = unseal(kind, *bytes);
  return content ? content : fail_with_context("'" + path.string() + "'", content.error());
}

}  // namespace seeker::store
