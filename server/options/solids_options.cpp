#include "server/options/solids_options.hpp"

#include "common/config/yaml.hpp"

namespace seeker::vision {

void describe(config::Fields& f, SegmentParams& params) {
  f.field("light_sigma_px", params.light_sigma_px);
  f.field("stretch_low", params.stretch_low);
  f.field("stretch_high", params.stretch_high);
  f.field("floor_sigmas", params.floor_sigmas);
  f.field("face_share", params.face_share);
  f.field("contrast_sigmas", params.contrast_sigmas);
  f.field("opening_px", params.opening_px);
  f.field("closing_px", params.closing_px);
  f.field("min_area", params.min_area);
  f.field("max_area", params.max_area);
}

void describe(config::Fields& f, SmallNetwork& network) {
  f.field("inputs", network.inputs);
  f.field("hidden", network.hidden);
  f.field("outputs", network.outputs);
  f.field("mean", network.mean);
  f.field("sigma", network.sigma);
  f.field("first", network.first);
  f.field("second", network.second);
}

void describe(config::Fields& f, SolidModel& model) {
  f.section("segment", model.segment);
  f.section("network", model.network);
  f.field("min_probability", model.min_probability);
}

}  // namespace seeker::vision

namespace seeker::options {
namespace {

constexpr int kVersion = 1;

/// The file as it stands.
struct SolidModelFile {
  int version = kVersion;
  vision::SolidModel model;
};

void describe(config::Fields& f, SolidModelFile& file) {
  f.require("version");
  f.field("version", file.version);
  describe(f, file.model);
}

}  // namespace

Result<vision::SolidModel> load_solid_model(const std::filesystem::path& path) {
  const Result<config::Document> document = config::Document::load(path);
  if (!document) {
    return tl::unexpected<Error>(document.error());
  }
  SolidModelFile file;
  if (const Status read = document->read(file); !read) {
    return tl::unexpected<Error>(read.error());
  }
  if (file.version != kVersion) {
    return fail(Errc::kUnsupportedVersion, path.string() + " has version " + std::to_string(file.version) +
                                               ", this program reads version " + std::to_string(kVersion) +
                                               "; train again or update the program");
  }
  if (const Status valid = vision::validate(file.model); !valid) {
    return fail_with_context(path.string(), valid.error());
  }
  return file.model;
}

std::string print_solid_model(const vision::SolidModel& model) {
  SolidModelFile file{kVersion, model};
  return "# Recogniser of solids, trained by seeker-lab train-solids.\n" + config::print(file);
}

}  // namespace seeker::options
