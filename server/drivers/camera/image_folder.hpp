/// \file
/// Pairs of pictures in a folder, with or without the poses they were taken from: a recorded survey or drive.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"

namespace seeker::drivers {

inline constexpr std::size_t kMaxImagePairs = 100000;

/// Left and right picture of one moment.
struct ImagePair {
  std::string name;  ///< the text that the `*` of both patterns matches
  std::filesystem::path left;
  std::filesystem::path right;
  std::optional<Pose2> map_T_eye;  ///< pose of the left eye, from the CSV
};

struct ImageFolderParams {
  std::filesystem::path folder;
  std::string left_pattern = "*_left.*";  ///< one `*` is the pair's name, a further one (for the type) is ignored
  std::string right_pattern = "*_right.*";
  std::string poses;  ///< CSV in the folder: `name,x_m,y_m,theta_deg` with that heading line; empty: no poses
};

/// The pairs in the order of their names, where numbers are ordered by value. kNotFound: no such folder or no pair in
/// it. kInvalidArgument: a picture without its partner, a pattern without `*`, a missing pose. kParse: a malformed line
/// of the CSV. kTooLarge: too many pairs.
[[nodiscard]] Result<std::vector<ImagePair>> list_image_pairs(const ImageFolderParams& params);

/// The pictures of a pair as they are in their files.
struct PairPictures {
  Image left;
  Image right;
};
/// Reads both pictures; errors are those of image::read_picture().
[[nodiscard]] Result<PairPictures> read_pair(const ImagePair& pair);

/// The text that `*` matches. Nothing: the name does not fit the pattern.
[[nodiscard]] std::optional<std::string> match_pattern(std::string_view name, std::string_view pattern);

}  // namespace seeker::drivers
