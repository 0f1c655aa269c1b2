#include "server/drivers/camera/image_folder.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "common/core/angle.hpp"
#include "common/core/natural_order.hpp"
#include "common/core/number_in.hpp"
#include "common/files/files.hpp"
#include "common/image/jpeg.hpp"

namespace seeker::drivers {
namespace {

constexpr std::size_t kMaxCsv_bytes = std::size_t{16} << 20U;

struct NaturalLess {
  bool operator()(const std::string& a, const std::string& b) const { return natural_less(a, b); }
};
using PairsByName = std::map<std::string, ImagePair, NaturalLess>;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, ',');) {
    const std::size_t first = word.find_first_not_of(" \t\r");
    const std::size_t last = word.find_last_not_of(" \t\r");
    words.push_back(first == std::string::npos ? "" : word.substr(first, last - first + 1));
  }
  return words;
}

Status read_poses(const std::filesystem::path& path, PairsByName& pairs) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path, kMaxCsv_bytes);
  if (!bytes) {
    return tl::unexpected<Error>(bytes.error());
  }
  std::istringstream in(std::string(bytes->begin(), bytes->end()));
  std::string line;
  int number = 0;
  while (std::getline(in, line)) {
    ++number;
    const std::vector<std::string> words = split(line);
    if (number == 1 || words.empty() || (words.size() == 1 && words[0].empty())) {
      continue;  // the heading, an empty line
    }
    const bool whole = words.size() == 4;
    const std::optional<double> x_m = whole ? finite_in(words[1]) : std::nullopt;
    const std::optional<double> y_m = whole ? finite_in(words[2]) : std::nullopt;
    const std::optional<double> heading_deg = whole ? finite_in(words[3]) : std::nullopt;
    if (!x_m || !y_m || !heading_deg) {
      return fail(Errc::kParse, path.string() + ":" + std::to_string(number) +
                                    ": a line must be name,x_m,y_m,theta_deg with three numbers");
    }
    if (const auto pair = pairs.find(words[0]); pair != pairs.end()) {
      pair->second.map_T_eye = Pose2{*x_m, *y_m, wrap_angle(deg_to_rad(*heading_deg))};
    }
  }
  for (const auto& [name, pair] : pairs) {
    if (!pair.map_T_eye) {
      return fail(Errc::kInvalidArgument, path.string() + ": the pair '" + name + "' has no pose; add its line");
    }
  }
  return {};
}

}  // namespace

std::optional<std::string> match_pattern(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos || name.substr(0, star) != pattern.substr(0, star)) {
    return std::nullopt;
  }
  std::string_view tail = pattern.substr(star + 1);
  std::string_view rest = name.substr(star);
  if (const std::size_t second = tail.find('*'); second != std::string_view::npos) {
    const std::string_view middle = tail.substr(0, second);
    const std::string_view end = tail.substr(second + 1);
    const std::size_t at = rest.rfind(middle);
    if (at == std::string_view::npos || rest.size() < at + middle.size() + end.size() ||
        rest.substr(rest.size() - end.size()) != end) {
      return std::nullopt;
    }
    rest = rest.substr(0, at);
  } else {
    if (rest.size() < tail.size() || rest.substr(rest.size() - tail.size()) != tail) {
      return std::nullopt;
    }
    rest = rest.substr(0, rest.size() - tail.size());
  }
  return rest.empty() ? std::nullopt : std::optional<std::string>(rest);
}

Result<std::vector<ImagePair>> list_image_pairs(const ImageFolderParams& params) {
  for (const std::string* pattern : {&params.left_pattern, &params.right_pattern}) {
    if (pattern->find('*') == std::string::npos) {
      return fail(Errc::kInvalidArgument, "the pattern '" + *pattern + "' needs a '*' where the pairs' names differ");
    }
  }
  std::error_code error;
  std::filesystem::directory_iterator files(params.folder, error);
  if (error) {
    return fail(Errc::kNotFound, "cannot read the folder '" + params.folder.string() + "': " + error.message());
  }
  PairsByName pairs;
  for (const auto& entry : files) {
    const std::string file = entry.path().filename().string();
    if (const auto name = match_pattern(file, params.left_pattern)) {
      pairs[*name].left = entry.path();
    } else if (const auto other = match_pattern(file, params.right_pattern)) {
      pairs[*other].right = entry.path();
    }
    if (pairs.size() > kMaxImagePairs) {
      return fail(Errc::kTooLarge, "the folder '" + params.folder.string() + "' holds more than 100000 pairs");
    }
  }
  if (pairs.empty()) {
    return fail(Errc::kNotFound, "the folder '" + params.folder.string() + "' has no files that fit '" +
                                     params.left_pattern + "' and '" + params.right_pattern + "'");
  }
  for (auto& [name, pair] : pairs) {
    pair.name = name;
    if (pair.left.empty() || pair.right.empty()) {
      return fail(Errc::kInvalidArgument, "the pair '" + name + "' in '" + params.folder.string() + "' has no " +
                                              (pair.left.empty() ? "left" : "right") +
                                              " picture; add it or remove its partner");
    }
  }
  if (!params.poses.empty()) {
    if (const Status read = read_poses(params.folder / params.poses, pairs); !read) {
      return tl::unexpected<Error>(read.error());
    }
  }
  std::vector<ImagePair> list;
  list.reserve(pairs.size());
  for (auto& [name, pair] : pairs) {
    list.push_back(std::move(pair));
  }
  return list;
}

Result<PairPictures> read_pair(const ImagePair& pair) {
  Result<Image> left = image::read_picture(pair.left);
  if (!left) {
    return tl::unexpected<Error>(left.error());
  }
  Result<Image> right = image::read_picture(pair.right);
  if (!right) {
    return tl::unexpected<Error>(right.error());
  }
  return PairPictures{std::move(*left), std::move(*right)};
}

}  // namespace seeker::drivers
