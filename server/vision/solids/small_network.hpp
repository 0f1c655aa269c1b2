/// \file
/// A network of one hidden layer with back-propagation, momentum and an adaptive rate (spec S6).
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/rng.hpp"

namespace seeker::vision {

/// tanh hidden units, softmax outputs; inputs are standardised first.
struct SmallNetwork {
  int inputs = 0;
  int hidden = 0;
  int outputs = 0;
  std::vector<double> mean;    ///< of each input over the training samples
  std::vector<double> sigma;   ///< above 0
  std::vector<double> first;   ///< hidden x (inputs + 1), row by row, the last column is the bias
  std::vector<double> second;  ///< outputs x (hidden + 1), the same

  friend bool operator==(const SmallNetwork&, const SmallNetwork&) = default;
};

/// kInvalidArgument: sizes that do not fit each other, numbers that are not finite.
[[nodiscard]] Status validate(const SmallNetwork& network);

/// Probabilities of the outputs. Asserts that the input has the network's size.
[[nodiscard]] std::vector<double> run_network(const SmallNetwork& network, const std::vector<double>& input);

struct TrainingSample {
  std::vector<double> input;
  int label = 0;
};

struct TrainingParams {
  int hidden = 16;
  int epochs = 1500;
  double rate = 0.05;
  double momentum = 0.9;
  double rate_up = 1.05;   ///< when the loss falls
  double rate_down = 0.7;  ///< when it rises by more than `worse`: the step is undone
  double worse = 0.04;
  double weight_decay = 1e-4;  ///< against learning the samples by heart
  double initial_weight = 0.3;
  /// Networks trained from random beginnings, each with another share of the samples (1 / members) kept to tell when to
  /// stop. Their mean is a network of members * hidden units.
  int members = 5;

  friend bool operator==(const TrainingParams&, const TrainingParams&) = default;
};

struct TrainedNetwork {
  SmallNetwork network;
  double training_loss = 0.0;        ///< cross-entropy per sample
  double validation_accuracy = 0.0;  ///< of the members, each on the samples that were kept from it
};

/// Full-batch training of a committee whose members' outputs before the softmax are averaged: one network of one hidden
/// layer all the same. kInvalidArgument: fewer samples than members, samples of different sizes, labels outside
/// 0 .. labels - 1.
[[nodiscard]] Result<TrainedNetwork> train_network(const std::vector<TrainingSample>& samples, int labels,
                                                   const TrainingParams& params, Rng& rng);

}  // namespace seeker::vision
