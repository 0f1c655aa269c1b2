/// \file
/// Reading and writing of versions in the tables of a database of landmarks. For landmark_file.cpp.
#pragma once

#include <optional>
#include <vector>

#include "server/store/landmark_file.hpp"
#include "server/store/schema.hpp"

namespace seeker::store {

/// Numbers of the versions of the content in one file.
inline constexpr std::int64_t kPresent = 0;
inline constexpr std::int64_t kBefore = 1;

[[nodiscard]] const Schema& landmark_schema();

/// The row that describes a version.
struct VersionRow {
  LandmarkHeader header;
  std::uint64_t next_id = 0;
  std::uint64_t sightings = 0;
  std::uint64_t checksum = 0;
};

/// Reads a version; std::nullopt where there is no such version.
[[nodiscard]] Result<std::optional<VersionRow>> read_version(Database& database, std::int64_t generation);
/// Reads the present version; kCorrupt where there is none.
[[nodiscard]] Result<VersionRow> present_version(Database& database);
/// The landmarks of the present version, checked against its checksum.
[[nodiscard]] Result<LandmarkContent> read_content(Database& database);

/// Inserts the present version, which must not exist yet. Asserts that landmarks are sorted by id.
[[nodiscard]] Status insert_version(Database& database, std::uint64_t revision, const LandmarkOrigin& origin,
                                    const LandmarkContent& content);
/// Replaces the generation `to` by the generation `from`.
[[nodiscard]] Status move_generation(Database& database, std::int64_t from, std::int64_t to);

/// Gives the present version a new revision and time, after an old version has been restored.
[[nodiscard]] Status renumber_present(Database& database, std::uint64_t revision, std::int64_t saved_unix_s);

}  // namespace seeker::store
