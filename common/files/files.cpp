#include "common/files/files.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "common/files/file_descriptor.hpp"
#include "common/files/file_error.hpp"
#include "common/files/file_pieces.hpp"
#include "common/files/temporary_file.hpp"

namespace seeker::files {
namespace {

tl::unexpected<Error> too_large(const std::filesystem::path& path, std::size_t limit_bytes) {
  return fail(Errc::kTooLarge, path.string() + " is larger than " + std::to_string(limit_bytes) + " bytes");
}

}  // namespace

Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path, std::size_t limit_bytes) {
  constexpr std::size_t kPiece_bytes = 65536;
  const Result<FileReader> file = FileReader::open(path);
  const Result<FileIdentity> found = file ? file->identity() : tl::unexpected<Error>(file.error());
  if (!found) {
    return tl::unexpected<Error>(found.error());
  }
  if (found->size_bytes > limit_bytes) {
    return too_large(path, limit_bytes);
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(found->size_bytes);
  // It may grow while it is read: its end is where no more comes.
  for (;;) {
    const Result<std::vector<std::uint8_t>> piece = file->read(bytes.size(), kPiece_bytes);
    if (!piece) {
      return piece;
    }
    bytes.insert(bytes.end(), piece->begin(), piece->end());
    if (bytes.size() > limit_bytes) {
      return too_large(path, limit_bytes);
    }
    if (piece->size() < kPiece_bytes) {
      return bytes;
    }
  }
}

Status write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, Outlives outlives,
                  ReadableBy readers) {
  const bool sync = outlives == Outlives::kPowerCut;
  Result<TemporaryFile> file = TemporaryFile::beside(path, readers);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  const int fd = file->descriptor();
  if (!write_all(fd, bytes) || (sync && ::fsync(fd) != 0)) {
    return cannot_write(path, errno);
  }
  if (const Status moved = file->move_to(path); !moved) {
    return moved;
  }
  return sync ? sync_folder(path.parent_path()) : Status();
}

Status write_file(const std::filesystem::path& path, std::string_view text, ReadableBy readers) {
  return write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
                    Outlives::kPowerCut, readers);
}

Status sync_folder(const std::filesystem::path& folder) {
  const std::filesystem::path place = folder.empty() ? std::filesystem::path(".") : folder;
  const FileDescriptor file(::open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.get() < 0 || ::fsync(file.get()) != 0) {
    return cannot("sync the folder", place, errno);
  }
  return {};
}

Status make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (folder.empty() || std::filesystem::is_directory(folder, error)) {
    return {};
  }
  if (const Status above = make_folder(folder.parent_path()); !above) {
    return above;
  }
  if (std::filesystem::create_directory(folder, error)) {
    return sync_folder(folder.parent_path());
  }
  // Made by somebody else meanwhile is as good.
  if (std::filesystem::is_directory(folder)) {
    return {};
  }
  return fail(Errc::kIo, "cannot make the folder " + folder.string() + ": " +
                             (error ? error.message() : "a file of that name exists already"));
}

}  // namespace seeker::files
