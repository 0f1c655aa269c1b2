/// \file
/// A network with one hidden layer, trained by back-propagation with momentum and an adaptive rate (spec S6).
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/rng.hpp"

namespace seeker::vision {

/// Weights of a network with tanh hidden units and softmax outputs; inputs are standardised first.
struct SmallNetwork {
  int inputs = 0;
  int hidden = 0;
  int outputs = 0;
  std::vector<double> mean;    ///< mean of each input over the training samples
  std::vector<double> sigma;   ///< standard deviation of each input, positive
  std::vector<double> first;   ///< hidden x (inputs + 1), row by row, the last column is the bias
  std::vector<double> second;  ///< outputs x (hidden + 1), in the same layout

  friend bool operator==(const SmallNetwork&, const SmallNetwork&) = default;
};

/// Fails with kInvalidArgument for inconsistent sizes, and for numbers that are not finite.
[[nodiscard]] Status validate(const SmallNetwork& network);

/// Probabilities of the outputs. The input must have the network's size (asserted).
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
  double rate_up = 1.05;   ///< factor of the rate when the loss falls
  double rate_down = 0.7;  ///< factor when it rises by more than `worse`: the step is undone
  double worse = 0.04;
  double weight_decay = 1e-4;  ///< against overfitting
  double initial_weight = 0.3;
  /// Number of networks trained from random weights, each with another share of the samples (1 / members) as validation
  /// samples for early stopping. Their mean is a network of members * hidden units.
  int members = 5;

  friend bool operator==(const TrainingParams&, const TrainingParams&) = default;
};

struct TrainedNetwork {
  SmallNetwork network;
  double training_loss = 0.0;        ///< cross-entropy per sample
  double validation_accuracy = 0.0;  ///< accuracy of the members, each on its own validation samples
};

/// Full-batch training of a committee whose members' outputs before the softmax are averaged, which is again a network
/// with one hidden layer. Fails with kInvalidArgument for fewer samples than members, samples of different sizes, and
/// labels outside 0 .. labels - 1.
[[nodiscard]] Result<TrainedNetwork> train_network(const std::vector<TrainingSample>& samples, int labels,
                                                   const TrainingParams& params, Rng& rng);

}  // namespace seeker::vision
