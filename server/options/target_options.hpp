/// \file
/// A target file (config/targets/*.yaml): appearance and size of an object that is searched for.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/config/fields.hpp"
#include "common/core/image.hpp"
#include "common/core/result.hpp"

namespace seeker::options {

/// The content of the file.
struct TargetFile {
  std::string name;
  std::string picture;  ///< PNG, relative to the file
  double width_m = 0.30;
  double height_m = 0.70;
  double depth_m = 0.30;  ///< 0: a flat poster
  double z_min_m = 0.05;  ///< height of the lower edge above the floor
  std::string recogniser = "template";
  std::string solid{};  ///< name of the solid, for the recogniser `solid`; such a target has no picture
};
void describe(config::Fields& f, TargetFile& target);

/// A target with its picture.
struct TargetDescription {
  TargetFile file;
  Image picture;
};

/// Errors: those of the strict reader, kInvalidArgument for sizes and for a solid (a world places it by its shape),
/// those of image::read_png.
[[nodiscard]] Result<TargetDescription> load_target(const std::filesystem::path& path);

}  // namespace seeker::options
