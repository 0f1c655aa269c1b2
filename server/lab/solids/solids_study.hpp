/// \file
/// S6: training and testing the recogniser of solids on rendered pictures of turbid water.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <vector>

#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/sim/turbid_water.hpp"
#include "server/vision/solids/solid_recogniser.hpp"

namespace seeker::lab {

/// A set of pictures: `per_class` of each solid, reproducible by the seed.
struct SolidPictures {
  int per_class = 300;
  std::uint64_t seed = 1;
};

/// Spec S6: 300 pictures of each class for training and 100 for testing, always from different streams of random
/// numbers.
[[nodiscard]] constexpr SolidPictures training_pictures(std::uint64_t seed) { return {300, 2 * seed - 1}; }
[[nodiscard]] constexpr SolidPictures test_pictures(std::uint64_t seed) { return {100, 2 * seed}; }

struct SolidPicture {
  sim::SolidView view;
  Image image;
};
/// Picture number `index` of a solid.
[[nodiscard]] SolidPicture draw_picture(const SolidPictures& pictures, SolidKind solid, int index);

struct TrainedSolids {
  vision::SolidModel model;
  double validation_accuracy = 0.0;
  int unseen = 0;  ///< training pictures in which no solid was found
};
/// Trains a model. kInvalidArgument: too few pictures.
[[nodiscard]] Result<TrainedSolids> train_solids(const SolidPictures& pictures,
                                                 const vision::TrainingParams& params = {});

/// Confusion matrix: rows are the true classes; the last column counts pictures in which no solid was found.
using Confusion = std::array<std::array<int, kSolidKinds.size() + 1>, kSolidKinds.size()>;
[[nodiscard]] double accuracy(const Confusion& confusion, SolidKind solid);

inline constexpr std::size_t kElevationBands = 4;  ///< bands of 10 degrees, from 20 degrees on

struct SolidsStudy {
  Confusion confusion{};
  std::array<Confusion, kElevationBands> by_elevation{};
  double mean_time_s = 0.0;  ///< mean time of one recognition
};
[[nodiscard]] SolidsStudy test_solids(const vision::SolidModel& model, const SolidPictures& pictures);

/// Lines `view,class,sphere,...,none`.
[[nodiscard]] std::string confusion_csv(const SolidsStudy& study);
/// Checks R11 for the pictures of all studies together, because with 100 pictures of a class a recogniser of 95 % may
/// fall on either side of 94 %; the share of the worst study is reported too. There must be at least one study.
[[nodiscard]] Check check_solids(const std::vector<SolidsStudy>& studies, const std::vector<std::uint64_t>& seeds);

struct TrainSolidsOptions {
  std::filesystem::path out;
  SolidPictures pictures = training_pictures(1);
};
/// Command `seeker-lab train-solids`: writes the model and prints its accuracy on the share kept for validation.
[[nodiscard]] Status run_train_solids(const TrainSolidsOptions& options, std::ostream& report);

/// Writes solids-N.yaml, confusion-N.csv and examples-N.png for every seed, and R11 to the report.
[[nodiscard]] Status reproduce_solids(const ReproduceParams& params, Report& report);

}  // namespace seeker::lab
