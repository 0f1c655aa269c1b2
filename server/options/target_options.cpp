#include "server/options/target_options.hpp"

#include "common/config/yaml.hpp"
#include "common/image/png.hpp"

namespace seeker::options {

void describe(config::Fields& f, TargetFile& target) {
  f.require("name");
  f.field("name", target.name);
  f.check("name", !target.name.empty(), "must not be empty");
  f.field("recogniser", target.recogniser);
  f.field("solid", target.solid);
  if (target.recogniser != "solid") {
    f.require("picture");
  }
  f.field("picture", target.picture);
  f.field("width_m", target.width_m);
  f.check("width_m", target.width_m > 0.0, "must be above 0");
  f.field("height_m", target.height_m);
  f.check("height_m", target.height_m > 0.0, "must be above 0");
  f.field("depth_m", target.depth_m);
  f.check("depth_m", target.depth_m >= 0.0, "must be 0 or more");
  f.field("z_min_m", target.z_min_m);
  f.check("z_min_m", target.z_min_m >= 0.0, "must be 0 or more");
}

Result<TargetDescription> load_target(const std::filesystem::path& path) {
  TargetDescription target;
  if (const Status read = config::load_file(path, target.file); !read) {
    return tl::unexpected<Error>(read.error());
  }
  if (target.file.recogniser == "solid") {
    return fail(Errc::kInvalidArgument,
                path.string() + " is a solid and has no picture; a world places it under `solids`");
  }
  Result<Image> picture = image::read_png(path.parent_path() / target.file.picture);
  if (!picture) {
    return fail_with_context(path.string() + ": picture", picture.error());
  }
  if (picture->empty()) {
    return fail(Errc::kInvalidArgument, path.string() + ": the picture has no pixels");
  }
  target.picture = std::move(*picture);
  return target;
}

}  // namespace seeker::options
