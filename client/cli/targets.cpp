#include "client/cli/targets.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <system_error>

#include "client/values/names.hpp"
#include "common/config/yaml.hpp"
#include "common/files/config_folder.hpp"
#include "common/image/pgm.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

/// A target's YAML file.
struct TargetFile {
  std::string name;
  std::string picture;
  SolidKind solid = SolidKind::kSphere;
  double width_m = 0.4;
  double height_m = 0.4;
  double depth_m = 0.0;
  api::RecogniserKind recogniser = api::RecogniserKind::kTemplate;
};

void describe(config::Fields& f, TargetFile& target) {
  f.field("name", target.name);
  f.choice("recogniser", target.recogniser,
           config::Choices<api::RecogniserKind>{{"template", api::RecogniserKind::kTemplate},
                                                {"features", api::RecogniserKind::kFeatures},
                                                {"solid", api::RecogniserKind::kSolid}});
  const bool is_solid = target.recogniser == api::RecogniserKind::kSolid;
  f.require(is_solid ? "solid" : "picture");
  if (is_solid && f.reading()) {
    target.width_m = target.height_m = target.depth_m = api::kSolidSize_m;
  }
  f.field("picture", target.picture);
  f.check("picture", !is_solid || target.picture.empty(), "a solid has no picture");
  f.choice("solid", target.solid, config::choices_of(kSolidKinds));
  f.field("width_m", target.width_m);
  f.check("width_m", target.width_m > 0.0, "must be above 0");
  f.field("height_m", target.height_m);
  f.check("height_m", target.height_m > 0.0, "must be above 0");
  f.field("depth_m", target.depth_m);
  f.check("depth_m", target.depth_m >= 0.0, "must not be negative");
}

/// The stem of a file as a target's name: a-z, 0-9 and '-'.
std::string name_from(const fs::path& file) {
  constexpr std::size_t kLongest = 32;
  std::string name;
  for (const char c : file.stem().string()) {
    const auto byte = static_cast<unsigned char>(c);
    name += std::isalnum(byte) != 0 && byte < 128 ? static_cast<char>(std::tolower(byte)) : '-';
  }
  return name.substr(0, kLongest);
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool has_extension(const std::string& text, std::initializer_list<const char*> extensions) {
  const std::string extension = fs::path(text).extension().string();
  return std::any_of(extensions.begin(), extensions.end(), [&](const char* e) { return extension == e; });
}

tl::unexpected<Error> unknown_target(const std::string& name, const std::vector<fs::path>& folders) {
  std::string places;
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code error;
    places += (places.empty() ? "" : ", ") + folder.string();
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      if (has_extension(entry.path().string(), {".yaml"})) {
        names.insert(entry.path().stem().string());
      }
    }
  }
  std::string known;
  for (const std::string& other : names) {
    known += (known.empty() ? "" : ", ") + other;
  }
  return fail(Errc::kNotFound,
              "there is no target '" + name + "' in " + places +
                  (known.empty() ? "; name a folder with --targets, or give a picture" : "; there are: " + known));
}

Result<fs::path> find_target(const std::string& name, const std::vector<fs::path>& folders) {
  if (has_extension(name, {".yaml", ".yml", ".png", ".pgm"}) || name.find('/') != std::string::npos) {
    return fs::path(name);
  }
  for (const fs::path& folder : folders) {
    for (const char* extension : {".yaml", ".png"}) {
      if (const fs::path file = folder / (name + extension); is_file(file)) {
        return file;
      }
    }
  }
  return unknown_target(name, folders);
}

Result<TargetFile> read_target_file(const fs::path& file) {
  TargetFile target;
  if (!has_extension(file.string(), {".yaml", ".yml"})) {
    target.picture = file.string();
    target.name = name_from(file);
    return target;
  }
  if (const Status ok = config::load_file(file, target); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (target.name.empty()) {
    target.name = name_from(file);
  }
  if (target.recogniser != api::RecogniserKind::kSolid) {
    target.picture = (file.parent_path() / target.picture).string();
  }
  return target;
}

/// What was said on the command line or in the script wins.
void take_sizes(const TargetDefaults& defaults, api::TargetSpec& spec) {
  spec.width_m = defaults.width_m.value_or(spec.width_m);
  spec.height_m = defaults.height_m.value_or(spec.height_m);
  spec.depth_m = defaults.depth_m.value_or(spec.depth_m);
}

}  // namespace

std::vector<fs::path> target_folders(const std::vector<std::string>& given) {
  std::vector<fs::path> folders(given.begin(), given.end());
  folders.push_back(files::config_folder() / "targets");
  return folders;
}

Result<api::TargetSpec> load_target(const std::string& name_or_file, const TargetDefaults& defaults,
                                    const std::vector<fs::path>& folders) {
  const Result<fs::path> file = find_target(name_or_file, folders);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  const Result<TargetFile> target = read_target_file(*file);
  if (!target) {
    return tl::unexpected<Error>(target.error());
  }
  api::TargetSpec spec;
  spec.name = target->name;
  spec.width_m = target->width_m;
  spec.height_m = target->height_m;
  spec.depth_m = target->depth_m;
  spec.recogniser = target->recogniser;
  spec.solid = target->solid;
  take_sizes(defaults, spec);
  if (spec.recogniser == api::RecogniserKind::kSolid) {
    return spec;
  }
  Result<Image> picture = image::read_image(target->picture);
  if (!picture) {
    return fail_with_context("target '" + target->name + "'", picture.error());
  }
  spec.picture = std::move(*picture);
  if (!defaults.recogniser.empty()) {
    spec.recogniser =
        defaults.recogniser == "features" ? api::RecogniserKind::kFeatures : api::RecogniserKind::kTemplate;
  }
  return spec;
}

Result<std::vector<api::TargetSpec>> load_targets(const std::vector<std::string>& names,
                                                  const std::vector<std::string>& solids,
                                                  const TargetDefaults& defaults,
                                                  const std::vector<fs::path>& folders) {
  std::vector<api::TargetSpec> targets;
  for (const std::string& name : names) {
    Result<api::TargetSpec> target = load_target(name, defaults, folders);
    if (!target) {
      return tl::unexpected<Error>(target.error());
    }
    targets.push_back(std::move(*target));
  }
  for (const std::string& name : solids) {
    const std::optional<SolidKind> solid = solid_named(name);
    if (!solid) {
      return fail(Errc::kInvalidArgument, "there is no solid '" + name + "'; known are " + listed(kSolidKinds));
    }
    targets.push_back(api::solid_target(*solid));
    take_sizes(defaults, targets.back());
  }
  return targets;
}

}  // namespace seeker::cli
