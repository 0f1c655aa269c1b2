#include "server/store/map_files.hpp"

#include <utility>

#include "common/files/files.hpp"

namespace seeker::store {
namespace {

namespace fs = std::filesystem;

MapListing listing_of(const fs::path& path, const std::string& name) {
  MapListing listing;
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path, MapFileLimits().file_bytes);
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

MapFiles::MapFiles(fs::path folder)
    : files_(std::move(folder), {.ending = std::string(kMapFileEnding),
                                 .name = "map",
                                 .folder = "folder of maps",
                                 .none = "none has been saved yet ('seeker map save NAME')"}) {}

Result<std::vector<MapListing>> MapFiles::list() const {
  const Result<std::vector<std::string>> names = files_.names();
  if (!names) {
    return tl::unexpected<Error>(names.error());
  }
  std::vector<MapListing> maps;
  maps.reserve(names->size());
  for (const std::string& name : *names) {
    maps.push_back(listing_of(path_of(name), name));
  }
  return maps;
}

Result<MapListing> MapFiles::inspect(const std::string& name) const {
  if (const Status ok = files_.check_present(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  MapListing listing = listing_of(path_of(name), name);
  if (!listing.problem.empty()) {
    return fail(Errc::kCorrupt, "map '" + name + "': " + listing.problem);
  }
  return listing;
}

Result<MapFile> MapFiles::read(const std::string& name) const {
  if (const Status ok = files_.check_present(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return read_map_file(path_of(name));
}

Result<std::vector<std::uint8_t>> MapFiles::read_bytes(const std::string& name) const {
  if (const Status ok = files_.check_present(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  Result<std::vector<std::uint8_t>> bytes = files::read_file(path_of(name), MapFileLimits().file_bytes);
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
  if (const Status ok = files_.check_free(name, replace); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (const Status ok = files_.make_folder(); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (const Status ok = write_map_file(path_of(name), file); !ok) {
    return fail_with_context("map '" + name + "' was not saved", ok.error());
  }
  return listing_of(path_of(name), name);
}

}  // namespace seeker::store
