#include "common/image/map_server.hpp"

#include <array>
#include <cstdio>

#include "common/core/occupancy_tile.hpp"
#include "common/files/files.hpp"
#include "common/image/export_mark.hpp"
#include "common/image/pgm.hpp"

namespace seeker::image {
namespace {

std::uint8_t grey_of(std::uint8_t cell) {
  if (cell == kUnknownCell) {
    return kPgmUnknown;
  }
  const double p = static_cast<double>(cell) / kOccupiedCell;
  if (p > kOccupiedThreshold) {
    return kPgmOccupied;
  }
  return p < kFreeThreshold ? kPgmFree : kPgmUnknown;
}

}  // namespace

Image map_server_image(const Grid<std::uint8_t>& occupancy) {
  Image image(occupancy.width(), occupancy.height(), 1);
  for (int j = 0; j < occupancy.height(); ++j) {
    for (int i = 0; i < occupancy.width(); ++i) {
      *image.at(i, occupancy.height() - 1 - j) = grey_of(occupancy[{i, j}]);
    }
  }
  return image;
}

std::string map_server_yaml(const std::string& pgm_name, const GridFrame& frame) {
  std::array<char, 256> numbers{};
  std::snprintf(numbers.data(), numbers.size(),
                "resolution: %.6g\norigin: [%.9g, %.9g, 0.0]\nnegate: 0\noccupied_thresh: %g\nfree_thresh: %g\n",
                frame.resolution_m, frame.origin.x(), frame.origin.y(), kOccupiedThreshold, kFreeThreshold);
  std::string quoted;
  for (const char c : pgm_name) {
    quoted += c == '\'' ? std::string("''") : std::string(1, c);
  }
  return comment_mark(kMapExport) + "image: '" + quoted + "'\nmode: trinary\n" + numbers.data();
}

Status write_map_server(const std::filesystem::path& prefix, const Grid<std::uint8_t>& occupancy) {
  if (occupancy.empty()) {
    return fail(Errc::kNotReady, "there is no map yet: nothing to write; let the robot sense or move first");
  }
  const std::filesystem::path pgm = prefix.string() + ".pgm";
  if (Status ok = write_pgm(pgm, map_server_image(occupancy), comment_mark(kMapExport)); !ok) {
    return ok;
  }
  return files::write_file(prefix.string() + ".yaml", map_server_yaml(pgm.filename().string(), occupancy.frame()));
}

}  // namespace seeker::image
