/// \file
/// The tables of a database of landmarks: how versions get into them and out of them. For landmark_file.cpp.
#pragma once

#include <optional>
#include <vector>

#include "server/store/landmark_file.hpp"
#include "server/store/schema.hpp"

namespace seeker::store {

/// Versions of the content in one file.
inline constexpr std::int64_t kPresent = 0;
inline constexpr std::int64_t kBefore = 1;

[[nodiscard]] const Schema& landmark_schema();

/// What a version says of itself.
struct VersionRow {
  LandmarkHeader header;
  std::uint64_t next_id = 0;
  std::uint64_t sightings = 0;
  std::uint64_t checksum = 0;
};

/// Nothing where there is no such version.
[[nodiscard]] Result<std::optional<VersionRow>> read_version(Database& database, std::int64_t generation);
/// kCorrupt where there is none.
[[nodiscard]] Result<VersionRow> present_version(Database& database);
/// The landmarks of the present version, checked against its checksum.
[[nodiscard]] Result<LandmarkContent> read_content(Database& database);

/// As the present version, which must not be there. Asserts that landmarks are sorted by id.
[[nodiscard]] Status insert_version(Database& database, std::uint64_t revision, const LandmarkOrigin& origin,
                                    const LandmarkContent& content);
/// Moves one generation over another one, which is gone then.
[[nodiscard]] Status move_generation(Database& database, std::int64_t from, std::int64_t to);

/// What the present version says of itself when it is an old one again.
[[nodiscard]] Status renumber_present(Database& database, std::uint64_t revision, std::int64_t saved_unix_s);

}  // namespace seeker::store
