#include "server/store/outgoing_files.hpp"

#include <algorithm>

namespace seeker::store {
namespace {

/// Files that are sent at the same time; more of them cost time, not memory.
constexpr std::size_t kMaxKnown = 8;

tl::unexpected<Error> changed(const std::filesystem::path& path) {
  return fail(Errc::kRefused, "'" + path.stem().string() + "' has changed since the download began; begin again");
}

}  // namespace

Result<digest::Sha256Sum> OutgoingFiles::hash_of(const std::filesystem::path& path, const files::FileIdentity& identity,
                                                 const std::function<Status()>& check) {
  const auto found = std::find_if(known_.begin(), known_.end(),
                                  [&](const Known& known) { return known.path == path && known.identity == identity; });
  if (found != known_.end()) {
    return found->hash;
  }
  if (const Status sound = check(); !sound) {
    return tl::unexpected<Error>(sound.error());
  }
  const Result<digest::Sha256Sum> hash = digest::sha256_of_file(path);
  if (hash) {
    std::erase_if(known_, [&](const Known& known) { return known.path == path; });
    known_.push_front({path, identity, *hash});
    known_.resize(std::min(known_.size(), kMaxKnown));
  }
  return hash;
}

Result<OutgoingPiece> OutgoingFiles::read(const std::filesystem::path& path, const OutgoingRange& range,
                                          const std::function<Status()>& check) {
  const Result<files::FileReader> file = files::FileReader::open(path);
  const Result<files::FileIdentity> before = file ? file->identity() : tl::unexpected<Error>(file.error());
  if (!before) {
    return tl::unexpected<Error>(before.error());
  }
  const Result<digest::Sha256Sum> hash = hash_of(path, *before, check);
  if (!hash) {
    return tl::unexpected<Error>(hash.error());
  }
  if (range.hash && *range.hash != *hash) {
    return changed(path);
  }
  if (range.offset > before->size_bytes) {
    return fail(Errc::kInvalidArgument, "the file has " + std::to_string(before->size_bytes) + " bytes, none at " +
                                            std::to_string(range.offset));
  }
  Result<std::vector<std::uint8_t>> bytes = file->read(range.offset, range.max_bytes);
  const Result<files::FileIdentity> after = file->identity();
  if (!bytes || !after) {
    return tl::unexpected<Error>(bytes ? after.error() : bytes.error());
  }
  if (*after != *before) {
    return changed(path);
  }
  return OutgoingPiece{*hash, before->size_bytes, std::move(*bytes)};
}

}  // namespace seeker::store
