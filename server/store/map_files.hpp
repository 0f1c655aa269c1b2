/// \file
/// The folder in which a robot keeps its maps, each as NAME.seekermap.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/store/map_file.hpp"
#include "server/store/named_files.hpp"

namespace seeker::store {

/// One file of the folder. A damaged file is listed with its problem, so that users see it.
struct MapListing {
  MapFileHeader header;  ///< only the name is set where there is a problem
  std::uint64_t file_bytes = 0;
  std::string problem;
};

/// The folder is made when the first map is written. Calls may come from one thread at a time.
class MapFiles {
 public:
  explicit MapFiles(std::filesystem::path folder);

  /// Lists all files by name; an absent folder has none. kIo.
  [[nodiscard]] Result<std::vector<MapListing>> list() const;
  /// kNotFound names the maps that are there; kInvalidArgument: not a valid name.
  [[nodiscard]] Status check_present(const std::string& name) const { return files_.check_present(name); }
  /// Reads the header of one map. kNotFound names the maps that are there; errors of decode_map_header().
  [[nodiscard]] Result<MapListing> inspect(const std::string& name) const;
  [[nodiscard]] Result<MapFile> read(const std::string& name) const;
  /// Reads the bytes of one file, after a check of the whole file.
  [[nodiscard]] Result<std::vector<std::uint8_t>> read_bytes(const std::string& name) const;
  /// Writes a map under the name in its origin. kRefused: there is such a map and `replace` is false.
  [[nodiscard]] Result<MapListing> write(const MapFile& file, bool replace) const;
  [[nodiscard]] Status remove(const std::string& name) const { return files_.remove(name); }

  [[nodiscard]] std::filesystem::path path_of(const std::string& name) const { return files_.path_of(name); }

 private:
  NamedFiles files_;
};

}  // namespace seeker::store
