#include "server/lab/solids/solids_study.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "common/core/angle.hpp"
#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/experiments/log_stopwatch.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/plots/image_tools.hpp"
#include "server/options/solids_options.hpp"

namespace seeker::lab {
namespace {

/// Table 2 of the paper, in the order of the classes, less 3 points (spec S6).
constexpr std::array<double, kSolidKinds.size()> kPaperAccuracy{0.95, 0.97, 0.94, 0.98};
constexpr double kSlack = 0.03;
constexpr double kTimeLimit_s = 0.5;

std::size_t band_of(const sim::SolidView& view) {
  constexpr double kFirst_deg = 20.0;
  constexpr double kBand_deg = 10.0;
  const double band = std::floor((rad_to_deg(view.elevation_rad) - kFirst_deg) / kBand_deg);
  return static_cast<std::size_t>(std::clamp(band, 0.0, static_cast<double>(kElevationBands - 1)));
}

void add_rows(Table& table, const std::string& view, const Confusion& confusion) {
  for (const SolidKind solid : kSolidKinds) {
    std::vector<std::string> row{view, std::string(to_string(solid))};
    for (const int count : confusion[static_cast<std::size_t>(solid)]) {
      row.push_back(std::to_string(count));
    }
    table.add(row);
  }
}

/// A few test pictures, each with what was seen in it.
Image examples(const vision::SolidModel& model, const SolidPictures& pictures) {
  constexpr int kEach = 3;
  std::vector<CaptionedImage> sheet;
  for (int i = 0; i < kEach; ++i) {
    for (const SolidKind solid : kSolidKinds) {
      const SolidPicture picture = draw_picture(pictures, solid, i);
      const auto found = vision::classify_solid(picture.image, model);
      sheet.push_back({found ? std::string(to_string(found->solid)) : "none", picture.image});
    }
  }
  return contact_sheet(sheet, static_cast<int>(kSolidKinds.size()));
}

}  // namespace

SolidPicture draw_picture(const SolidPictures& pictures, SolidKind solid, int index) {
  Rng rng = Rng(pictures.seed).fork(std::string(to_string(solid)) + " " + std::to_string(index));
  const sim::SolidView view = sim::draw_view(solid, rng);
  const sim::TurbidWater water = sim::draw_water(rng);
  return {view, sim::render_solid(view, water, rng)};
}

Result<TrainedSolids> train_solids(const SolidPictures& pictures, const vision::TrainingParams& params) {
  TrainedSolids trained;
  std::vector<vision::TrainingSample> samples;
  samples.reserve(kSolidKinds.size() * static_cast<std::size_t>(std::max(0, pictures.per_class)));
  for (const SolidKind solid : kSolidKinds) {
    for (int i = 0; i < pictures.per_class; ++i) {
      const auto sight = vision::look_at_solid(draw_picture(pictures, solid, i).image, trained.model.segment);
      if (!sight) {
        ++trained.unseen;
        continue;
      }
      samples.push_back({{sight->features.begin(), sight->features.end()}, static_cast<int>(solid)});
    }
  }
  Rng rng = Rng(pictures.seed).fork("training");
  Result<vision::TrainedNetwork> network =
      vision::train_network(samples, static_cast<int>(kSolidKinds.size()), params, rng);
  if (!network) {
    return tl::unexpected<Error>(network.error());
  }
  trained.model.network = std::move(network->network);
  trained.validation_accuracy = network->validation_accuracy;
  return trained;
}

double accuracy(const Confusion& confusion, SolidKind solid) {
  const auto& row = confusion[static_cast<std::size_t>(solid)];
  const int all = std::accumulate(row.begin(), row.end(), 0);
  return all == 0 ? 0.0 : static_cast<double>(row[static_cast<std::size_t>(solid)]) / all;
}

SolidsStudy test_solids(const vision::SolidModel& model, const SolidPictures& pictures) {
  SolidsStudy study;
  double spent_s = 0.0;  // of this thread's processor, which another load of the machine does not lengthen
  for (const SolidKind solid : kSolidKinds) {
    for (int i = 0; i < pictures.per_class; ++i) {
      const SolidPicture picture = draw_picture(pictures, solid, i);
      const double before_s = thread_seconds();
      const auto found = vision::classify_solid(picture.image, model);
      spent_s += thread_seconds() - before_s;
      const auto row = static_cast<std::size_t>(solid);
      const std::size_t column = found ? static_cast<std::size_t>(found->solid) : kSolidKinds.size();
      ++study.confusion[row][column];
      ++study.by_elevation[band_of(picture.view)][row][column];
    }
  }
  const double count = static_cast<double>(kSolidKinds.size()) * std::max(1, pictures.per_class);
  study.mean_time_s = spent_s / count;
  return study;
}

std::string confusion_csv(const SolidsStudy& study) {
  std::vector<std::string> header{"view", "class"};
  for (const SolidKind solid : kSolidKinds) {
    header.emplace_back(to_string(solid));
  }
  header.emplace_back("none");
  Table table(header);
  add_rows(table, "all", study.confusion);
  constexpr std::array<const char*, kElevationBands> kBands{"20-30 deg", "30-40 deg", "40-50 deg", "50-60 deg"};
  for (std::size_t band = 0; band < kElevationBands; ++band) {
    add_rows(table, kBands[band], study.by_elevation[band]);
  }
  return table.csv();
}

Check check_solids(const std::vector<SolidsStudy>& studies, const std::vector<std::uint64_t>& seeds) {
  Confusion all{};
  double time_s = 0.0;
  for (const SolidsStudy& study : studies) {
    time_s += study.mean_time_s / static_cast<double>(studies.size());
    for (std::size_t row = 0; row < all.size(); ++row) {
      std::transform(all[row].begin(), all[row].end(), study.confusion[row].begin(), all[row].begin(), std::plus<>());
    }
  }
  Check check{.id = "R11", .passed = time_s <= kTimeLimit_s, .figures = {{"seeds", print_seeds(seeds)}}};
  for (const SolidKind solid : kSolidKinds) {
    const double share = accuracy(all, solid);
    const double limit = kPaperAccuracy[static_cast<std::size_t>(solid)] - kSlack;
    double worst = 1.0;
    for (const SolidsStudy& study : studies) {
      worst = std::min(worst, accuracy(study.confusion, solid));
    }
    check.passed = check.passed && share >= limit - 1e-9;
    check.figures.emplace_back(std::string(to_string(solid)), fixed(share, 3));
    check.figures.emplace_back("worst", fixed(worst, 2));
    check.figures.emplace_back("limit", fixed(limit, 2));
  }
  check.figures.emplace_back("time_s", fixed(time_s, 3));
  check.figures.emplace_back("limit_s", fixed(kTimeLimit_s, 1));
  return check;
}

Status run_train_solids(const TrainSolidsOptions& options, std::ostream& report) {
  const Result<TrainedSolids> trained = train_solids(options.pictures);
  if (!trained) {
    return tl::unexpected<Error>(trained.error());
  }
  if (Status ok = files::write_file(options.out, options::print_solid_model(trained->model)); !ok) {
    return ok;
  }
  report << "trained from " << options.pictures.per_class << " pictures a class, seed " << options.pictures.seed
         << ": validation accuracy " << fixed(trained->validation_accuracy, 3) << ", nothing seen in "
         << trained->unseen << "\n";
  return {};
}

namespace {

/// The smallest form has a third of the pictures.
SolidPictures as_many(SolidPictures pictures, bool smallest) {
  constexpr int kFewer = 3;
  pictures.per_class /= smallest ? kFewer : 1;
  return pictures;
}

Result<SolidsStudy> study_seed(const std::filesystem::path& out, std::uint64_t seed, bool smallest) {
  const std::string number = std::to_string(seed);
  const SolidPictures test = as_many(test_pictures(seed), smallest);
  const Result<TrainedSolids> trained = train_solids(as_many(training_pictures(seed), smallest));
  if (!trained) {
    return tl::unexpected<Error>(trained.error());
  }
  const std::filesystem::path file = out / ("solids-" + number + ".yaml");
  if (Status ok = files::write_file(file, options::print_solid_model(trained->model)); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  // From the file, as a robot would have it.
  const Result<vision::SolidModel> model = options::load_solid_model(file);
  if (!model) {
    return tl::unexpected<Error>(model.error());
  }
  const SolidsStudy study = test_solids(*model, test);
  if (Status ok = files::write_file(out / ("confusion-" + number + ".csv"), confusion_csv(study)); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const Image sheet = examples(*model, test);
  if (Status ok = image::write_png(out / ("examples-" + number + ".png"), sheet); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return study;
}

}  // namespace

Status reproduce_solids(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  std::vector<SolidsStudy> studies;
  for (const std::uint64_t seed : params.seeds) {
    if (seed == 0) {
      return fail(Errc::kInvalidArgument, "the seeds of solids begin with 1");
    }
    const Result<SolidsStudy> study = study_seed(params.out, seed, params.smallest);
    if (!study) {
      return tl::unexpected<Error>(study.error());
    }
    studies.push_back(*study);
  }
  if (!studies.empty()) {
    report.add(check_solids(studies, params.seeds));
  }
  return {};
}

}  // namespace seeker::lab
