#include "server/store/incoming_files.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "common/files/file_pieces.hpp"
#include "common/files/files.hpp"

namespace seeker::store {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDiskRemedy = "; free space on the disk of the state folder, then send the file again";

std::uint64_t size_of(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

/// The time of last use is that of the file, which outlives the program.
void touch(const fs::path& path) {
  std::error_code error;
  fs::last_write_time(path, fs::file_time_type::clock::now(), error);
}

/// Where that fails, the file counts on when room is made.
void delete_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
}

tl::unexpected<Error> not_begun() {
  return fail(Errc::kNotFound,
              "the file is not here: it was not begun, or was deleted to make room for others; send it again");
}

/// Deletes the file where it has another hash.
Status check_hash(const fs::path& path, const digest::Sha256Sum& hash) {
  const Result<digest::Sha256Sum> found = digest::sha256_of_file(path);
  if (!found) {
    return tl::unexpected<Error>(found.error());
  }
  if (*found == hash) {
    return {};
  }
  delete_file(path);
  return fail(Errc::kCorrupt,
              "what has arrived has another SHA-256 than was announced, and was deleted; send the file again");
}

}  // namespace

IncomingFiles::IncomingFiles(fs::path folder, const IncomingLimits& limits)
    : folder_(std::move(folder)), limits_(limits) {}

std::vector<IncomingName> IncomingFiles::names() const {
  std::vector<IncomingName> all;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    if (std::optional<IncomingName> name = parse_incoming_name(entry->path().filename().string())) {
      all.push_back(std::move(*name));
    }
  }
  return all;
}

std::vector<IncomingEntry> IncomingFiles::entries() const {
  std::vector<IncomingEntry> all;
  for (const IncomingName& name : names()) {
    const fs::path path = path_of(name);
    std::error_code unread;
    const auto used = fs::last_write_time(path, unread);
    if (!unread) {
      all.push_back({to_string(name), name.whole ? size_of(path) : name.size_bytes,
                     std::chrono::duration_cast<std::chrono::nanoseconds>(used.time_since_epoch()).count()});
    }
  }
  return all;
}

std::optional<IncomingName> IncomingFiles::part_of(const std::string& hash) const {
  const std::vector<IncomingName> all = names();
  const auto part =
      std::find_if(all.begin(), all.end(), [&](const IncomingName& name) { return !name.whole && name.hash == hash; });
  return part != all.end() ? std::optional(*part) : std::nullopt;
}

Status IncomingFiles::make_room(std::uint64_t size_bytes) const {
  if (size_bytes > limits_.total_bytes) {
    return fail(Errc::kTooLarge, "the file has " + std::to_string(size_bytes) + " bytes, more than the " +
                                     std::to_string(limits_.total_bytes) + " that arriving files may take");
  }
  if (const Status made = files::make_folder(folder_); !made) {
    return made;
  }
  for (const std::string& file : to_drop(entries(), size_bytes, limits_)) {
    delete_file(folder_ / file);
  }
  std::error_code error;
  const fs::space_info space = fs::space(folder_, error);
  if (!error && space.available < size_bytes) {
    return fail(Errc::kIo, "the disk has " + std::to_string(space.available) + " free bytes, the file needs " +
                               std::to_string(size_bytes) + kDiskRemedy);
  }
  return {};
}

Result<std::uint64_t> IncomingFiles::begin(const digest::Sha256Sum& hash, std::uint64_t size_bytes) {
  if (size_bytes == 0) {
    return fail(Errc::kInvalidArgument, "the file is empty; choose another one");
  }
  const std::string hex = digest::to_hex(hash);
  if (const fs::path here = whole_path_of(hex); size_of(here) > 0) {
    if (size_of(here) != size_bytes) {
      return fail(Errc::kInvalidArgument, "the file with this SHA-256 has " + std::to_string(size_of(here)) +
                                              " bytes, not " + std::to_string(size_bytes));
    }
    touch(here);
    return size_bytes;
  }
  const IncomingName part{hex, size_bytes, false};
  if (const std::optional<IncomingName> begun = part_of(hex)) {
    const std::uint64_t have = size_of(path_of(*begun));
    if (*begun == part && have < size_bytes) {
      touch(path_of(part));
      return have;
    }
    if (*begun == part && have == size_bytes) {
      return take_whole(part, hash);  // the program ended between the last piece and its check
    }
    delete_file(path_of(*begun));
  }
  if (const Status room = make_room(size_bytes); !room) {
    return tl::unexpected<Error>(room.error());
  }
  if (const Status made = files::write_piece(path_of(part), 0, {}); !made) {
    return tl::unexpected<Error>(made.error());
  }
  return 0;
}

Result<std::uint64_t> IncomingFiles::append(const digest::Sha256Sum& hash, std::uint64_t offset,
                                            std::span<const std::uint8_t> bytes) {
  const std::string hex = digest::to_hex(hash);
  if (const std::uint64_t all = size_of(whole_path_of(hex)); all > 0) {
    return all;
  }
  const std::optional<IncomingName> part = part_of(hex);
  if (!part) {
    return not_begun();
  }
  const std::uint64_t have = size_of(path_of(*part));
  if (offset > part->size_bytes || bytes.size() > part->size_bytes - offset) {
    return fail(Errc::kInvalidArgument, "the piece ends beyond the " + std::to_string(part->size_bytes) +
                                            " bytes that were announced; begin again with the right size");
  }
  if (offset > have) {
    return fail(Errc::kRefused, "the piece begins at " + std::to_string(offset) + " but " + std::to_string(have) +
                                    " bytes of the file are here; send on from there");
  }
  const std::uint64_t known = std::min<std::uint64_t>(have - offset, bytes.size());
  if (const auto news = bytes.subspan(known); !news.empty()) {
    if (const Status written = files::write_piece(path_of(*part), have, news); !written) {
      return fail(written.error().code, written.error().message + kDiskRemedy);
    }
  }
  const std::uint64_t now = have + bytes.size() - known;
  return now == part->size_bytes ? take_whole(*part, hash) : Result<std::uint64_t>(now);
}

Result<std::uint64_t> IncomingFiles::take_whole(const IncomingName& part, const digest::Sha256Sum& hash) const {
  const fs::path path = path_of(part);
  if (const Status same = check_hash(path, hash); !same) {
    return tl::unexpected<Error>(same.error());
  }
  if (const Status placed = files::put_in_place(path, whole_path_of(part.hash)); !placed) {
    return tl::unexpected<Error>(placed.error());
  }
  return part.size_bytes;
}

Result<fs::path> IncomingFiles::whole(const digest::Sha256Sum& hash) const {
  const fs::path path = whole_path_of(digest::to_hex(hash));
  if (const Status same = check_hash(path, hash); !same) {
    return same.error().code == Errc::kNotFound ? not_begun() : tl::unexpected<Error>(same.error());
  }
  touch(path);
  return path;
}

}  // namespace seeker::store
