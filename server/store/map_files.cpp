#include "server/store/map_files.hpp"

#include <algorithm>
#include <system_error>

#include "server/store/atomic_file.hpp"

namespace seeker::store {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".seekermap";

MapListing listing_of(const fs::path& path, const std::string& name) {
  MapListing listing;
  const Result<std::vector<std::uint8_t>> bytes = read_file(path, MapFileLimits().file_bytes);
  const Result<MapFileHeader> header = bytes ? decode_map_header(*bytes) : tl::unexpected<Error>(bytes.error());
  listing.file_bytes = bytes ? bytes->size() : 0;
  if (header) {
    listing.header = *header;
  } else {
    listing.problem = header.error().message;
  }
  // A file that was renamed by hand goes by the name one must type.
  listing.header.origin.name = name;
  return listing;
}

}  // namespace

fs::path MapFiles::path_of(const std::string& name) const { return folder_ / (name + kEnding); }

Result<std::vector<MapListing>> MapFiles::list() const {
  std::vector<MapListing> maps;
  std::error_code error;
  if (!fs::exists(folder_, error)) {
    return maps;
  }
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().stem().string();
    if (entry->path().extension() == kEnding && validate_map_name(name)) {
      maps.push_back(listing_of(entry->path(), name));
    }
  }
  if (error) {
    return fail(Errc::kIo, "cannot read the folder of maps '" + folder_.string() + "': " + error.message());
  }
  std::sort(maps.begin(), maps.end(),
            [](const MapListing& a, const MapListing& b) { return a.header.origin.name < b.header.origin.name; });
  return maps;
}

tl::unexpected<Error> MapFiles::unknown(const std::string& name) const {
  std::string names;
  if (const Result<std::vector<MapListing>> maps = list(); maps) {
    for (const MapListing& map : *maps) {
      names += (names.empty() ? "" : ", ") + map.header.origin.name;
    }
  }
  return fail(Errc::kNotFound,
              "there is no map '" + name + "'; " +
                  (names.empty() ? "none has been saved yet ('seeker map save NAME')" : "there are: " + names));
}

Status MapFiles::check_present(const std::string& name) const {
  if (Status ok = validate_map_name(name); !ok) {
    return ok;
  }
  std::error_code error;
  return fs::is_regular_file(path_of(name), error) ? Status() : Status(unknown(name));
}

Result<MapListing> MapFiles::inspect(const std::string& name) const {
  if (const Status ok = check_present(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  MapListing listing = listing_of(path_of(name), name);
  if (!listing.problem.empty()) {
    return fail(Errc::kCorrupt, "map '" + name + "': " + listing.problem);
  }
  return listing;
}

Result<MapFile> MapFiles::read(const std::string& name) const {
  if (const Status ok = check_present(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return read_map_file(path_of(name));
}

Result<std::vector<std::uint8_t>> MapFiles::read_bytes(const std::string& name) const {
  if (const Status ok = check_present(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  Result<std::vector<std::uint8_t>> bytes = read_file(path_of(name), MapFileLimits().file_bytes);
  if (!bytes) {
    return bytes;
  }
  if (const Result<MapFile> file = decode_map_file(*bytes); !file) {
    return fail_with_context("map '" + name + "'", file.error());
  }
  return bytes;
}

Result<MapListing> MapFiles::write(const MapFile& file, bool replace) const {
  const std::string& name = file.origin.name;
  if (const Status ok = validate_map_name(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  std::error_code error;
  if (!replace && fs::exists(path_of(name), error)) {
    return fail(Errc::kRefused, "there is a map '" + name + "' already; take another name, or --replace it");
  }
  fs::create_directories(folder_, error);
  if (error) {
    return fail(Errc::kIo, "cannot make the folder of maps '" + folder_.string() + "': " + error.message() +
                               "; give another one with --state");
  }
  if (const Status ok = write_map_file(path_of(name), file); !ok) {
    return fail_with_context("map '" + name + "' was not saved", ok.error());
  }
  return listing_of(path_of(name), name);
}

Status MapFiles::remove(const std::string& name) const {
  if (Status ok = check_present(name); !ok) {
    return ok;
  }
  std::error_code error;
  if (!fs::remove(path_of(name), error)) {
    return fail(Errc::kIo, "cannot delete map '" + name + "': " + error.message());
  }
  return sync_folder(folder_);
}

}  // namespace seeker::store
