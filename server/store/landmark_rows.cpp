#include "server/store/landmark_rows.hpp"

#include <algorithm>
#include <bit>

#include "common/core/assert.hpp"
#include "common/core/hash.hpp"

namespace seeker::store {
namespace {

constexpr const char* kTables = R"sql(
CREATE TABLE versions (
  generation INTEGER PRIMARY KEY,   -- 0: present, 1: the one before
  revision INTEGER NOT NULL,
  robot_id TEXT NOT NULL, software_version TEXT NOT NULL, map_name TEXT NOT NULL,
  created_unix_s INTEGER NOT NULL, saved_unix_s INTEGER NOT NULL,
  calibration INTEGER NOT NULL,     -- 64 bits, as all unsigned numbers here
  next_id INTEGER NOT NULL,
  sightings INTEGER NOT NULL,
  landmarks INTEGER NOT NULL,
  checksum INTEGER NOT NULL         -- of all landmarks and sides
) STRICT;

CREATE TABLE landmarks (
  generation INTEGER NOT NULL,
  id INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  xx REAL NOT NULL, xy REAL NOT NULL, xz REAL NOT NULL, yy REAL NOT NULL, yz REAL NOT NULL, zz REAL NOT NULL,
  eye_x REAL NOT NULL, eye_y REAL NOT NULL, eye_z REAL NOT NULL,
  concentration REAL NOT NULL, scale_m REAL NOT NULL, log_odds REAL NOT NULL,
  seen INTEGER NOT NULL, expected INTEGER NOT NULL, misses INTEGER NOT NULL, last_seen INTEGER NOT NULL,
  PRIMARY KEY (generation, id)
) STRICT, WITHOUT ROWID;

CREATE TABLE sides (
  generation INTEGER NOT NULL,
  landmark INTEGER NOT NULL,
  side INTEGER NOT NULL,
  eye_x REAL NOT NULL, eye_y REAL NOT NULL, eye_z REAL NOT NULL,
  seen INTEGER NOT NULL,
  descriptor BLOB NOT NULL,
  PRIMARY KEY (generation, landmark, side)
) STRICT, WITHOUT ROWID;
)sql";

std::int64_t to_signed(std::uint64_t value) { return std::bit_cast<std::int64_t>(value); }
std::uint64_t to_unsigned(std::int64_t value) { return std::bit_cast<std::uint64_t>(value); }

template <class T, std::size_t N>
void add_all(Fnv1a& sum, const std::array<T, N>& values) {
  for (const T& value : values) {
    if constexpr (sizeof(T) == 1) {
      sum.add_byte(value);
    } else {
      sum.add(value);
    }
  }
}

/// Over everything a version holds: the database's own check knows nothing of changed numbers.
std::uint64_t checksum_of(const LandmarkContent& content) {
  Fnv1a sum;
  sum.add(content.calibration);
  sum.add(content.next_id);
  sum.add(content.sightings);
  for (const LandmarkRecord& r : content.landmarks) {
    sum.add(r.id);
    add_all(sum, r.p_map);
    add_all(sum, r.information);
    add_all(sum, r.to_eye);
    sum.add(r.concentration);
    sum.add(r.scale_m);
    sum.add(r.log_odds);
    sum.add(r.seen);
    sum.add(r.expected);
    sum.add(r.misses);
    sum.add(r.last_seen);
    for (const LandmarkSide& side : r.sides) {
      add_all(sum, side.to_eye);
      sum.add(side.seen);
      add_all(sum, side.descriptor);
    }
  }
  return sum.value();
}

void bind_all(Statement& row, std::span<const double> values) {
  for (const double value : values) {
    row.bind(value);
  }
}

Status insert_sides(Database& database, const LandmarkRecord& landmark) {
  for (std::size_t n = 0; n < landmark.sides.size(); ++n) {
    const LandmarkSide& side = landmark.sides[n];
    Result<Statement> row = database.prepare("INSERT INTO sides VALUES (0,?,?,?,?,?,?,?)");
    if (!row) {
      return tl::unexpected(row.error());
    }
    row->bind(to_signed(landmark.id)).bind(static_cast<std::int64_t>(n));
    bind_all(*row, side.to_eye);
    row->bind(side.seen).bind(std::span<const std::uint8_t>(side.descriptor));
    if (Status ok = row->run(); !ok) {
      return ok;
    }
  }
  return {};
}

Status insert_landmark(Database& database, const LandmarkRecord& landmark) {
  Result<Statement> row = database.prepare("INSERT INTO landmarks VALUES (0,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  if (!row) {
    return tl::unexpected(row.error());
  }
  row->bind(to_signed(landmark.id));
  bind_all(*row, landmark.p_map);
  bind_all(*row, landmark.information);
  bind_all(*row, landmark.to_eye);
  row->bind(landmark.concentration).bind(landmark.scale_m).bind(landmark.log_odds);
  row->bind(landmark.seen).bind(landmark.expected).bind(landmark.misses).bind(to_signed(landmark.last_seen));
  Status ok = row->run();
  return ok ? insert_sides(database, landmark) : ok;
}

template <std::size_t N>
void read_reals(const Statement& row, int first, std::array<double, N>& values) {
  for (std::size_t n = 0; n < N; ++n) {
    values[n] = row.real(first + static_cast<int>(n));
  }
}

Status read_landmarks(Database& database, std::vector<LandmarkRecord>& landmarks) {
  Result<Statement> row = database.prepare("SELECT * FROM landmarks WHERE generation = 0 ORDER BY id");
  if (!row) {
    return tl::unexpected(row.error());
  }
  for (;;) {
    const Result<bool> there = row->step();
    if (!there) {
      return tl::unexpected(there.error());
    }
    if (!*there) {
      return {};
    }
    if (landmarks.size() >= static_cast<std::size_t>(kMaxLandmarkRecords)) {
      return fail(Errc::kTooLarge, "the file has more than " + std::to_string(kMaxLandmarkRecords) + " landmarks");
    }
    LandmarkRecord& landmark = landmarks.emplace_back();
    landmark.id = to_unsigned(row->integer(1));
    read_reals(*row, 2, landmark.p_map);
    read_reals(*row, 5, landmark.information);
    read_reals(*row, 11, landmark.to_eye);
    landmark.concentration = row->real(14);
    landmark.scale_m = row->real(15);
    landmark.log_odds = row->real(16);
    landmark.seen = row->integer(17);
    landmark.expected = row->integer(18);
    landmark.misses = row->integer(19);
    landmark.last_seen = to_unsigned(row->integer(20));
  }
}

tl::unexpected<Error> damaged(const std::string& what) {
  return fail(Errc::kCorrupt, "the file is damaged (" + what + ")");
}

/// Both tables are read by rising id: one walk over the landmarks is enough.
Status read_sides(Database& database, std::vector<LandmarkRecord>& landmarks) {
  Result<Statement> row = database.prepare("SELECT * FROM sides WHERE generation = 0 ORDER BY landmark, side");
  if (!row) {
    return tl::unexpected(row.error());
  }
  auto owner = landmarks.begin();
  for (;;) {
    const Result<bool> there = row->step();
    if (!there) {
      return tl::unexpected(there.error());
    }
    if (!*there) {
      return {};
    }
    const std::uint64_t id = to_unsigned(row->integer(1));
    while (owner != landmarks.end() && owner->id != id) {
      ++owner;
    }
    const std::vector<std::uint8_t> bytes = row->blob(7);
    LandmarkSide side;
    if (owner == landmarks.end() || bytes.size() != side.descriptor.size() ||
        owner->sides.size() >= static_cast<std::size_t>(kMaxLandmarkSides)) {
      return damaged("a side of landmark " + std::to_string(id));
    }
    read_reals(*row, 3, side.to_eye);
    side.seen = row->integer(6);
    std::copy(bytes.begin(), bytes.end(), side.descriptor.begin());
    owner->sides.push_back(side);
  }
}

}  // namespace

const Schema& landmark_schema() {
  constexpr std::int64_t kApplicationId = 0x5345454C;  // "SEEL"
  static const Schema kSchema{kTables, kApplicationId, kLandmarkSchemaVersion, "PRAGMA quick_check(1)"};
  return kSchema;
}

Status insert_version(Database& database, std::uint64_t revision, const LandmarkOrigin& origin,
                      const LandmarkContent& content) {
  SEEKER_ASSERT(std::is_sorted(content.landmarks.begin(), content.landmarks.end(),
                               [](const LandmarkRecord& a, const LandmarkRecord& b) { return a.id < b.id; }));
  Result<Statement> row = database.prepare("INSERT INTO versions VALUES (0,?,?,?,?,?,?,?,?,?,?,?)");
  if (!row) {
    return tl::unexpected(row.error());
  }
  row->bind(to_signed(revision)).bind(origin.robot_id).bind(origin.software_version).bind(origin.map_name);
  row->bind(origin.created_unix_s).bind(origin.saved_unix_s);
  row->bind(to_signed(content.calibration)).bind(to_signed(content.next_id)).bind(to_signed(content.sightings));
  row->bind(static_cast<std::int64_t>(content.landmarks.size())).bind(to_signed(checksum_of(content)));
  if (Status ok = row->run(); !ok) {
    return ok;
  }
  for (const LandmarkRecord& landmark : content.landmarks) {
    if (Status ok = insert_landmark(database, landmark); !ok) {
      return fail_with_context("landmark " + std::to_string(landmark.id), ok.error());
    }
  }
  return {};
}

Status move_generation(Database& database, std::int64_t from, std::int64_t to) {
  std::string sql;
  for (const char* table : {"versions", "landmarks", "sides"}) {
    sql += std::string("DELETE FROM ") + table + " WHERE generation = " + std::to_string(to) + "; UPDATE " + table +
           " SET generation = " + std::to_string(to) + " WHERE generation = " + std::to_string(from) + ";";
  }
  return database.execute(sql);
}

Result<std::optional<VersionRow>> read_version(Database& database, std::int64_t generation) {
  Result<Statement> row = database.prepare(
      "SELECT revision, robot_id, software_version, map_name, created_unix_s, saved_unix_s, calibration, next_id, "
      "sightings, landmarks, checksum FROM versions WHERE generation = ?");
  if (!row) {
    return tl::unexpected(row.error());
  }
  row->bind(generation);
  const Result<bool> there = row->step();
  if (!there) {
    return tl::unexpected(there.error());
  }
  if (!*there) {
    return std::optional<VersionRow>();
  }
  VersionRow version;
  version.header.revision = to_unsigned(row->integer(0));
  version.header.origin = {row->text(1), row->text(2), row->text(3), row->integer(4), row->integer(5)};
  version.header.calibration = to_unsigned(row->integer(6));
  version.next_id = to_unsigned(row->integer(7));
  version.sightings = to_unsigned(row->integer(8));
  version.header.landmarks = to_unsigned(row->integer(9));
  version.checksum = to_unsigned(row->integer(10));
  return std::optional<VersionRow>(std::move(version));
}

Result<VersionRow> present_version(Database& database) {
  const Result<std::optional<VersionRow>> version = read_version(database, kPresent);
  if (!version) {
    return tl::unexpected(version.error());
  }
  if (!*version) {
    return fail(Errc::kCorrupt, "the file is damaged (it has no present version)");
  }
  return **version;
}

Result<LandmarkContent> read_content(Database& database) {
  const Result<VersionRow> version = present_version(database);
  if (!version) {
    return tl::unexpected(version.error());
  }
  LandmarkContent content;
  content.calibration = version->header.calibration;
  content.next_id = version->next_id;
  content.sightings = version->sightings;
  Status ok = read_landmarks(database, content.landmarks);
  if (ok) {
    ok = read_sides(database, content.landmarks);
  }
  if (!ok) {
    return tl::unexpected(ok.error());
  }
  if (content.landmarks.size() != version->header.landmarks || checksum_of(content) != version->checksum) {
    return damaged("its landmarks do not match their checksum");
  }
  return content;
}

Status renumber_present(Database& database, std::uint64_t revision, std::int64_t saved_unix_s) {
  Result<Statement> row = database.prepare("UPDATE versions SET revision = ?, saved_unix_s = ? WHERE generation = 0");
  if (!row) {
    return tl::unexpected(row.error());
  }
  row->bind(to_signed(revision)).bind(saved_unix_s);
  return row->run();
}

}  // namespace seeker::store
