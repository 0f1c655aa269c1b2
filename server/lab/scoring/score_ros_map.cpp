#include "server/lab/scoring/score_ros_map.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <zlib.h>

#include "common/config/yaml.hpp"
#include "common/core/image.hpp"
#include "common/image/pgm.hpp"

namespace seeker::lab {

/// The fields of a map_server file.
struct RosMapFile {
  std::string image;
  std::string mode = "trinary";
  double resolution = 0.05;
  std::vector<double> origin = {0.0, 0.0, 0.0};  ///< x, y of the lower left corner, yaw
  int negate = 0;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
};

// Not in an unnamed namespace: argument-dependent look-up would not find it from Fields.
void describe(config::Fields& f, RosMapFile& file) {
  f.field("image", file.image);
  f.require("image");
  f.field("mode", file.mode);
  f.field("resolution", file.resolution);
  f.check("resolution", file.resolution > 0.0, "must be above 0");
  f.field("origin", file.origin);
  f.check("origin", file.origin.size() == 3 && file.origin.back() == 0.0, "must be x, y and yaw 0");
  f.field("negate", file.negate);
  f.field("occupied_thresh", file.occupied_thresh);
  f.field("free_thresh", file.free_thresh);
}

namespace {

/// A compressed PGM; plain pictures go through image::read_image().
Result<Image> read_compressed(const std::filesystem::path& path) {
  constexpr std::size_t kLimit_bytes = std::size_t{64} << 20U;
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) {
    return fail(Errc::kNotFound, "there is no picture " + path.string());
  }
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> block(std::size_t{1} << 16U);
  int got = 0;
  while (bytes.size() <= kLimit_bytes && (got = gzread(file, block.data(), static_cast<unsigned>(block.size()))) > 0) {
    bytes.insert(bytes.end(), block.begin(), block.begin() + got);
  }
  gzclose(file);
  if (got < 0) {
    return fail(Errc::kCorrupt, path.string() + " is damaged");
  }
  const Result<Image> picture = image::decode_pgm(bytes);
  return picture ? picture : Result<Image>(fail_with_context(path.string(), picture.error()));
}

Result<Image> read_picture(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    return image::read_image(path);
  }
  return read_compressed(path.string() + ".gz");
}

}  // namespace

Result<RosMap> read_ros_map(const std::filesystem::path& yaml) {
  RosMapFile file;
  if (const Status ok = config::load_file(yaml, file); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  Result<Image> picture = read_picture(yaml.parent_path() / file.image);
  if (!picture) {
    return tl::unexpected<Error>(picture.error());
  }
  const Image grey = to_grey(*picture);
  GridFrame frame;
  frame.origin = {file.origin[0], file.origin[1]};
  frame.resolution_m = file.resolution;
  RosMap map{Grid<std::uint8_t>(frame, grey.width_px(), grey.height_px()),
             Grid<std::uint8_t>(frame, grey.width_px(), grey.height_px())};
  bool any = false;
  for (int v = 0; v < grey.height_px(); ++v) {
    for (int u = 0; u < grey.width_px(); ++u) {
      constexpr double kWhite = 255.0;
      const double share = *grey.at(u, v) / kWhite;
      const double occupied = file.negate != 0 ? share : 1.0 - share;
      const CellIndex cell{u, grey.height_px() - 1 - v};
      const bool wall = occupied > file.occupied_thresh;
      map.occupied[cell] = wall ? 1 : 0;
      map.known[cell] = wall || occupied < file.free_thresh ? 1 : 0;
      any = any || wall;
    }
  }
  if (!any) {
    return fail(Errc::kNotReady, yaml.string() + " has no occupied cell to measure distances to");
  }
  return map;
}

}  // namespace seeker::lab
