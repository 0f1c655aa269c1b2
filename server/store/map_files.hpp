/// \file
/// The folder a robot keeps its maps in: NAME.seekermap each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/store/map_file.hpp"
#include "server/store/named_files.hpp"

namespace seeker::store {

/// One file of the folder. A damaged one is listed with its problem, so that somebody sees it.
struct MapListing {
  MapFileHeader header;  ///< only the name is set where there is a problem
  std::uint64_t file_bytes = 0;
  std::string problem;
};

/// Not made until the first map is written. Calls may come from one thread at a time.
class MapFiles {
 public:
  explicit MapFiles(std::filesystem::path folder);

  /// By name. An absent folder has no maps. kIo.
  [[nodiscard]] Result<std::vector<MapListing>> list() const;
  /// The header of one map. kNotFound names the maps that are there; errors of decode_map_header().
  [[nodiscard]] Result<MapListing> inspect(const std::string& name) const;
  [[nodiscard]] Result<MapFile> read(const std::string& name) const;
  /// The file as it is, checked as a whole.
  [[nodiscard]] Result<std::vector<std::uint8_t>> read_bytes(const std::string& name) const;
  /// Writes under the name of its origin. kRefused: there is such a map and `replace` is false.
  [[nodiscard]] Result<MapListing> write(const MapFile& file, bool replace) const;
  [[nodiscard]] Status remove(const std::string& name) const { return files_.remove(name); }

  [[nodiscard]] std::filesystem::path path_of(const std::string& name) const { return files_.path_of(name); }

 private:
  NamedFiles files_;
};

}  // namespace seeker::store
