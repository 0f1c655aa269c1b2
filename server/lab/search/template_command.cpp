#include "server/lab/search/template_command.hpp"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <memory>
#include <string>
#include <system_error>

#include "common/core/angle.hpp"
#include "common/image/png.hpp"
#include "server/vision/multi_recogniser.hpp"

namespace seeker::lab {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    constexpr unsigned kFirstPrintable = 0x20;
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < kFirstPrintable) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out += code;
    } else {
      out += c;
    }
  }
  return out + '"';
}

Result<std::vector<vision::TargetModel>> read_targets(const TemplateOptions& options) {
  std::vector<vision::TargetModel> models;
  for (const std::filesystem::path& path : options.targets) {
    Result<Image> picture = image::read_png(path);
    if (!picture) {
      return tl::unexpected<Error>(picture.error());
    }
    const double height_m = options.width_m * picture->height_px() / std::max(1, picture->width_px());
    models.push_back({path.filename().string(), std::move(*picture), options.width_m, height_m, options.kind});
  }
  return models;
}

Result<std::vector<std::string>> write_stages(const std::filesystem::path& out,
                                              const std::vector<vision::StageImage>& stages) {
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) {
    return fail(Errc::kIo, "cannot make the folder " + out.string() + ": " + error.message());
  }
  std::vector<std::string> files;
  for (const vision::StageImage& stage : stages) {
    const std::string number = std::to_string(files.size() + 1);
    const std::filesystem::path file =
        out / (std::string(number.size() < 2 ? "0" : "") + number + "_" + stage.name + ".png");
    if (Status written = image::write_png(file, stage.image); !written) {
      return tl::unexpected<Error>(written.error());
    }
    files.push_back(file.string());
  }
  return files;
}

void print_sighting(const vision::Sighting& s, const std::vector<vision::TargetModel>& models, std::ostream& json) {
  json << "{\"target\": " << quoted(models[static_cast<std::size_t>(s.target)].name) << ", \"u_px\": " << s.u_px
       << ", \"v_px\": " << s.v_px << ", \"score\": " << s.score << ", \"verify_score\": " << s.verify_score
       << ", \"box_px\": [" << s.box.left_px << ", " << s.box.top_px << ", " << s.box.width_px << ", "
       << s.box.height_px << "], \"rotation_deg\": " << rad_to_deg(s.rotation_rad)
       << ", \"bearing_deg\": " << rad_to_deg(s.bearing_base_rad) << "}";
}

void print_stages(const vision::StageCounts& s, std::ostream& json) {
  json << "{\"regions\": " << s.regions << ", \"rejected_area\": " << s.rejected_area
       << ", \"rejected_duplicate\": " << s.rejected_duplicate << ", \"rejected_aspect\": " << s.rejected_aspect
       << ", \"candidates\": " << s.candidates << ", \"rejected_ncc\": " << s.rejected_ncc
       << ", \"rejected_verify\": " << s.rejected_verify << ", \"rejected_overlap\": " << s.rejected_overlap
       << ", \"features\": " << s.features << ", \"matches\": " << s.matches
       << ", \"rejected_geometry\": " << s.rejected_geometry << ", \"accepted\": " << s.accepted << "}";
}

void print_report(const vision::RecognitionReport& report, const std::vector<vision::TargetModel>& models,
                  const std::vector<std::string>& files, std::ostream& json) {
  json << std::fixed << std::setprecision(3) << "{\"sightings\": [";
  for (std::size_t i = 0; i < report.sightings.size(); ++i) {
    json << (i == 0 ? "" : ", ");
    print_sighting(report.sightings[i], models, json);
  }
  json << "], \"stages\": ";
  print_stages(report.stages, json);
  json << ", \"files\": [";
  for (std::size_t i = 0; i < files.size(); ++i) {
    json << (i == 0 ? "" : ", ") << quoted(files[i]);
  }
  json << "]}\n";
}

}  // namespace

Status run_template(const TemplateOptions& options, std::ostream& json) {
  const auto models = read_targets(options);
  if (!models) {
    return tl::unexpected<Error>(models.error());
  }
  const Result<Image> scene = image::read_png(options.scene);
  if (!scene) {
    return tl::unexpected<Error>(scene.error());
  }
  const auto recogniser = vision::make_recogniser(*models, options.params);
  if (!recogniser) {
    return tl::unexpected<Error>(recogniser.error());
  }
  const auto report = (*recogniser)->recognise(*scene);
  if (!report) {
    return fail_with_context(options.scene.string(), report.error());
  }
  std::vector<std::string> files;
  if (!options.out.empty()) {
    const auto stages = (*recogniser)->explain(*scene);
    if (!stages) {
      return fail_with_context(options.scene.string(), stages.error());
    }
    auto written = write_stages(options.out, *stages);
    if (!written) {
      return tl::unexpected<Error>(written.error());
    }
    files = std::move(*written);
  }
  print_report(*report, *models, files, json);
  return {};
}

}  // namespace seeker::lab
