#include "common/api/transfer.hpp"

namespace seeker::api {

std::string_view to_string(FileKind kind) {
  switch (kind) {
    case FileKind::kMap: return "map";
    case FileKind::kLandmarks: return "database of landmarks";
    case FileKind::kPicture: return "picture";
  }
  return "file";
}

std::uint64_t max_file_bytes(FileKind kind) {
  constexpr std::uint64_t kMiB = 1UL << 20U;
  constexpr std::uint64_t kMap = 256 * kMiB;
  constexpr std::uint64_t kLandmarks = 512 * kMiB;
  constexpr std::uint64_t kPicture = 8 * kMiB;
  switch (kind) {
    case FileKind::kMap: return kMap;
    case FileKind::kLandmarks: return kLandmarks;
    case FileKind::kPicture: return kPicture;
  }
  return 0;
}

Status validate(const FileOffer& offer) {
  if (offer.size_bytes == 0) {
    return fail(Errc::kInvalidArgument, "the " + std::string(to_string(offer.kind)) + " is empty; choose another file");
  }
  if (offer.size_bytes > max_file_bytes(offer.kind)) {
    return fail(Errc::kTooLarge, "the " + std::string(to_string(offer.kind)) + " has " +
                                     std::to_string(offer.size_bytes) + " bytes; at most " +
                                     std::to_string(max_file_bytes(offer.kind)) + " can be sent");
  }
  return {};
}

}  // namespace seeker::api
