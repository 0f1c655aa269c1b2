/// \file
/// Files that travel in pieces between a client and a robot, named by their hash, so that what was cut off goes on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/api/landmarks.hpp"
#include "common/api/map.hpp"
#include "common/core/result.hpp"

namespace seeker::api {

/// SHA-256 of a file.
using FileHash = std::array<std::uint8_t, 32>;

enum class FileKind : std::uint8_t {
  kMap,        ///< a map of segments
  kLandmarks,  ///< a database of landmarks
  kPicture,    ///< of a target, as PNG: missions name it by its hash
};
[[nodiscard]] std::string_view to_string(FileKind kind);

inline constexpr std::size_t kMaxFilePiece_bytes = 1UL << 20U;  ///< of one call
/// The largest file of a kind, in bytes: 256 MiB of a map, 512 MiB of a database, 8 MiB of a picture.
[[nodiscard]] std::uint64_t max_file_bytes(FileKind kind);

/// A file that a client wants to send.
struct FileOffer {
  FileKind kind = FileKind::kMap;
  FileHash hash{};
  std::uint64_t size_bytes = 0;

  friend bool operator==(const FileOffer&, const FileOffer&) = default;
};
/// kInvalidArgument: it is empty; kTooLarge: larger than max_file_bytes().
[[nodiscard]] Status validate(const FileOffer& offer);

/// Some bytes of a file that is being sent.
struct UploadPiece {
  FileHash hash{};
  std::uint64_t offset = 0;
  std::vector<std::uint8_t> bytes;

  friend bool operator==(const UploadPiece&, const UploadPiece&) = default;
};

/// What is to be done with a file that the robot has as a whole.
struct UploadEnd {
  FileKind kind = FileKind::kMap;
  FileHash hash{};
  std::string name;         ///< under which it is kept; of no meaning for a picture
  bool replace = false;     ///< another file of this name
  bool check_only = false;  ///< verify the file and do not keep it

  friend bool operator==(const UploadEnd&, const UploadEnd&) = default;
};

/// Summary of a file that was taken: of its kind, none for a picture.
struct UploadedFile {
  std::optional<MapSummary> map;
  std::optional<LandmarkSummary> landmarks;

  friend bool operator==(const UploadedFile&, const UploadedFile&) = default;
};

/// Asks for some bytes of a map or a database of the robot.
struct FileRead {
  FileKind kind = FileKind::kMap;
  std::string name;
  std::uint64_t offset = 0;
  std::uint32_t max_bytes = 0;   ///< 0: only hash and size are wanted; at most kMaxFilePiece_bytes are given
  std::optional<FileHash> hash;  ///< of the file whose bytes before `offset` the client has

  friend bool operator==(const FileRead&, const FileRead&) = default;
};

struct FilePiece {
  FileHash hash{};  ///< of the whole file
  std::uint64_t size_bytes = 0;
  std::vector<std::uint8_t> bytes;  ///< from the offset that was asked for

  friend bool operator==(const FilePiece&, const FilePiece&) = default;
};

}  // namespace seeker::api
