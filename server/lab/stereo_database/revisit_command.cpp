#include "server/lab/stereo_database/revisit_command.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <system_error>

#include <nlohmann/json.hpp>

#include "common/core/natural_order.hpp"
#include "common/files/files.hpp"
#include "common/image/canvas.hpp"
#include "common/image/jpeg.hpp"
#include "common/image/png.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/vision/picture.hpp"
#include "server/vision/sift_features.hpp"

namespace seeker::lab {
namespace {

struct Photograph {
  std::filesystem::path path;
  vision::FeatureList features;
};

Result<Photograph> read_photograph(const std::filesystem::path& path) {
  const Result<Image> picture = image::read_picture(path);
  if (!picture) {
    return tl::unexpected<Error>(picture.error());
  }
  return Photograph{path, vision::detect_sift(vision::to_grey_mat(*picture), vision::place_detector_params())};
}

void copy_into(Image& sheet, const Image& picture, int left_px) {
  for (int v = 0; v < picture.height_px(); ++v) {
    for (int u = 0; u < picture.width_px(); ++u) {
      for (int c = 0; c < 3; ++c) {
        sheet.at(left_px + u, v)[c] = picture.at(u, v)[picture.channels() == 3 ? c : 0];
      }
    }
  }
}

/// The later photograph left, the earlier one right, a line for each inlier.
Image draw_pair(const Image& later, const Image& earlier, const Photograph& a, const Photograph& b,
                const vision::PlaceEvidence& evidence) {
  constexpr image::Colour kLine{40, 220, 90};
  constexpr double kAlpha = 0.7;
  constexpr double kDot_px = 2.5;
  Image sheet(later.width_px() + earlier.width_px(), std::max(later.height_px(), earlier.height_px()), 3);
  copy_into(sheet, later, 0);
  copy_into(sheet, earlier, later.width_px());
  image::Canvas canvas(sheet);
  const auto centre = [](const vision::Keypoint& key, int left_px) {
    return Point2(static_cast<double>(key.u_px) + 0.5 + left_px, static_cast<double>(key.v_px) + 0.5);
  };
  for (const vision::FeatureMatch& m : evidence.inliers) {
    const Point2 from = centre(a.features.keypoints[static_cast<std::size_t>(m.first)], 0);
    const Point2 to = centre(b.features.keypoints[static_cast<std::size_t>(m.second)], later.width_px());
    canvas.line(from, to, {.colour = kLine, .width_px = 1.0, .alpha = kAlpha});
    canvas.fill_circle(from, kDot_px, kLine);
    canvas.fill_circle(to, kDot_px, kLine);
  }
  return canvas.image();
}

Result<std::string> write_pair(const std::filesystem::path& out, const Photograph& a, const Photograph& b,
                               const vision::PlaceEvidence& evidence) {
  const Result<Image> later = image::read_picture(a.path);
  const Result<Image> earlier = image::read_picture(b.path);
  if (!later || !earlier) {
    return tl::unexpected<Error>(!later ? later.error() : earlier.error());
  }
  const std::string name = a.path.stem().string() + "_shows_" + b.path.stem().string() + ".png";
  if (Status written = image::write_png(out / name, draw_pair(*later, *earlier, a, b, evidence)); !written) {
    return tl::unexpected<Error>(written.error());
  }
  return name;
}

std::string to_csv(const std::vector<Revisit>& revisits) {
  std::ostringstream csv;
  csv << "picture,earlier,matches,inliers,drawing\n";
  for (const Revisit& r : revisits) {
    csv << r.picture << ',' << r.earlier << ',' << r.matches << ',' << r.inliers << ',' << r.drawing << '\n';
  }
  return csv.str();
}

void print_json(const std::vector<Revisit>& revisits, std::ostream& text) {
  auto list = nlohmann::ordered_json::array();
  for (const Revisit& r : revisits) {
    list.push_back({{"picture", r.picture},
                    {"earlier", r.earlier},
                    {"matches", r.matches},
                    {"inliers", r.inliers},
                    {"drawing", r.drawing}});
  }
  text << json_lines({{"revisits", list}});
}

void print_text(const std::vector<Revisit>& revisits, std::ostream& text) {
  for (const Revisit& r : revisits) {
    text << r.picture << " shows " << r.earlier << " again: " << r.inliers << " of " << r.matches << " matches agree\n";
  }
  text << revisits.size() << " revisits\n";
}

}  // namespace

Result<std::vector<std::filesystem::path>> ordered_pictures(const std::filesystem::path& folder) {
  static const std::set<std::string> kEndings = {".png", ".jpg", ".jpeg"};
  std::error_code error;
  std::vector<std::filesystem::path> found;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::string ending = it->path().extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    if (kEndings.contains(ending)) {
      found.push_back(it->path());
    }
  }
  if (error) {
    return fail(Errc::kNotFound, "cannot read the folder " + folder.string() + ": " + error.message());
  }
  if (found.empty()) {
    return fail(Errc::kNotFound, folder.string() + " holds no picture: give a folder with PNG or JPEG files");
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return natural_less(a.filename().string(), b.filename().string()); });
  return found;
}

Result<std::vector<Revisit>> find_revisits(const RevisitOptions& options) {
  const auto paths = ordered_pictures(options.folder);
  if (!paths) {
    return tl::unexpected<Error>(paths.error());
  }
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error) {
    return fail(Errc::kIo, "cannot make the folder " + options.out.string() + ": " + error.message());
  }
  vision::PlaceIndex index(options.params);
  std::vector<Photograph> seen;
  std::vector<Revisit> revisits;
  for (const std::filesystem::path& path : *paths) {
    Result<Photograph> photograph = read_photograph(path);
    if (!photograph) {
      return tl::unexpected<Error>(photograph.error());
    }
    const auto far_enough = [now = seen.size(), &options](std::uint64_t id) {
      return id + static_cast<std::uint64_t>(options.gap) < now;
    };
    for (const auto& match : index.best_matches(photograph->features, options.all ? seen.size() : 1, far_enough)) {
      const Photograph& earlier = seen[static_cast<std::size_t>(match.id)];
      const auto drawing = write_pair(options.out, *photograph, earlier, match.evidence);
      if (!drawing) {
        return tl::unexpected<Error>(drawing.error());
      }
      revisits.push_back({path.filename().string(), earlier.path.filename().string(), match.evidence.matches,
                          static_cast<int>(match.evidence.inliers.size()), *drawing});
    }
    index.add(seen.size(), photograph->features);
    seen.push_back(std::move(*photograph));
    if (options.progress) {
      options.progress(seen.size(), paths->size());
    }
  }
  if (Status written = files::write_file(options.out / "revisits.csv", to_csv(revisits)); !written) {
    return tl::unexpected<Error>(written.error());
  }
  return revisits;
}

Status run_revisit(const RevisitOptions& options, std::ostream& text) {
  const auto revisits = find_revisits(options);
  if (!revisits) {
    return tl::unexpected<Error>(revisits.error());
  }
  if (options.json) {
    print_json(*revisits, text);
  } else {
    print_text(*revisits, text);
  }
  return {};
}

}  // namespace seeker::lab
