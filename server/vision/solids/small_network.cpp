#include "server/vision/solids/small_network.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Dense>

#include "common/core/assert.hpp"

namespace seeker::vision {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double kSmallestSigma = 1e-9;

bool finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Samples as columns, standardised, with a row of ones below; one-hot labels as columns.
struct Batch {
  Matrix input;
  Matrix wanted;
};

struct Weights {
  Matrix first;
  Matrix second;
};

struct Forward {
  Matrix hidden;  ///< with a row of ones below
  Matrix output;
  double loss = 0.0;
};

Matrix with_ones(const Matrix& m) {
  Matrix out(m.rows() + 1, m.cols());
  out.topRows(m.rows()) = m;
  out.bottomRows(1).setOnes();
  return out;
}

Forward forward(const Weights& w, const Batch& batch, double decay) {
  Forward f;
  f.hidden = with_ones((w.first * batch.input).array().tanh().matrix());
  Matrix z = w.second * f.hidden;
  z.rowwise() -= z.colwise().maxCoeff().eval();
  z = z.array().exp().matrix();
  f.output = z.array().rowwise() / z.colwise().sum().array().eval();
  constexpr double kSmallest = 1e-300;
  f.loss = -(batch.wanted.array() * (f.output.array() + kSmallest).log()).sum() / static_cast<double>(z.cols());
  f.loss += 0.5 * decay * (w.first.squaredNorm() + w.second.squaredNorm());
  return f;
}

Weights gradient(const Weights& w, const Batch& batch, const Forward& f, double decay) {
  const auto count = static_cast<double>(batch.input.cols());
  const Matrix out = (f.output - batch.wanted) / count;
  const auto hidden = f.hidden.topRows(w.first.rows()).array();
  const Matrix back =
      ((w.second.leftCols(w.first.rows()).transpose() * out).array() * (1.0 - hidden.square())).matrix();
  return {back * batch.input.transpose() + decay * w.first, out * f.hidden.transpose() + decay * w.second};
}

double accuracy(const Weights& w, const Batch& batch) {
  const Matrix output = forward(w, batch, 0.0).output;
  int right = 0;
  for (Eigen::Index i = 0; i < output.cols(); ++i) {
    Eigen::Index best = 0;
    output.col(i).maxCoeff(&best);
    right += batch.wanted(best, i) > 0.5 ? 1 : 0;
  }
  return static_cast<double>(right) / static_cast<double>(output.cols());
}

Matrix random_matrix(Eigen::Index rows, Eigen::Index columns, double size, Rng& rng) {
  Matrix m(rows, columns);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    m.data()[i] = rng.uniform(-size, size);
  }
  return m;
}

struct Attempt {
  Weights weights;
  double loss = 0.0;
  double accuracy = -1.0;
};

/// One training run; the weights that were best on the validation samples.
Attempt train_once(const Batch& training, const Batch& validation, int outputs, const TrainingParams& params,
                   Rng& rng) {
  Weights w{random_matrix(params.hidden, training.input.rows(), params.initial_weight, rng),
            random_matrix(outputs, params.hidden + 1, params.initial_weight, rng)};
  Weights step{Matrix::Zero(w.first.rows(), w.first.cols()), Matrix::Zero(w.second.rows(), w.second.cols())};
  double rate = params.rate;
  Forward now = forward(w, training, params.weight_decay);
  Attempt best;
  constexpr int kLook = 10;  // epochs between evaluations of the validation samples
  for (int epoch = 0; epoch < params.epochs; ++epoch) {
    const Weights g = gradient(w, training, now, params.weight_decay);
    step.first = params.momentum * step.first - rate * g.first;
    step.second = params.momentum * step.second - rate * g.second;
    const Weights tried{w.first + step.first, w.second + step.second};
    Forward next = forward(tried, training, params.weight_decay);
    if (next.loss > now.loss * (1.0 + params.worse)) {
      rate *= params.rate_down;
      step.first.setZero();
      step.second.setZero();
      continue;
    }
    rate *= next.loss < now.loss ? params.rate_up : 1.0;
    w = tried;
    now = std::move(next);
    if (epoch % kLook == 0 || epoch + 1 == params.epochs) {
      const double right = accuracy(w, validation);
      if (right >= best.accuracy) {
        best = {w, now.loss, right};
      }
    }
  }
  return best;
}

Batch batch_of(const std::vector<TrainingSample>& samples, const std::vector<std::size_t>& which,
               const SmallNetwork& network) {
  Batch batch{Matrix(network.inputs + 1, static_cast<Eigen::Index>(which.size())),
              Matrix::Zero(network.outputs, static_cast<Eigen::Index>(which.size()))};
  for (std::size_t n = 0; n < which.size(); ++n) {
    const auto column = static_cast<Eigen::Index>(n);
    const TrainingSample& sample = samples[which[n]];
    for (int i = 0; i < network.inputs; ++i) {
      const auto k = static_cast<std::size_t>(i);
      batch.input(i, column) = (sample.input[k] - network.mean[k]) / network.sigma[k];
    }
    batch.input(network.inputs, column) = 1.0;
    batch.wanted(sample.label, column) = 1.0;
  }
  return batch;
}

void standardise(const std::vector<TrainingSample>& samples, SmallNetwork& network) {
  const auto count = static_cast<double>(samples.size());
  for (std::size_t k = 0; k < static_cast<std::size_t>(network.inputs); ++k) {
    double sum = 0.0;
    double sum2 = 0.0;
    for (const TrainingSample& sample : samples) {
      sum += sample.input[k];
      sum2 += sample.input[k] * sample.input[k];
    }
    network.mean.push_back(sum / count);
    const double variance = sum2 / count - network.mean.back() * network.mean.back();
    network.sigma.push_back(std::sqrt(std::max(kSmallestSigma, variance)));
  }
}

/// Hidden units of all members beside each other, the outputs before the softmax averaged.
TrainedNetwork mean_of(const std::vector<Attempt>& members, SmallNetwork network) {
  const auto count = static_cast<double>(members.size());
  const Eigen::Index hidden = members.front().weights.first.rows();
  Matrix first(hidden * static_cast<Eigen::Index>(members.size()), network.inputs + 1);
  Matrix second = Matrix::Zero(network.outputs, first.rows() + 1);
  TrainedNetwork mean;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Weights& w = members[i].weights;
    const Eigen::Index at = hidden * static_cast<Eigen::Index>(i);
    first.middleRows(at, hidden) = w.first;
    second.middleCols(at, hidden) = w.second.leftCols(hidden) / count;
    second.rightCols(1) += w.second.rightCols(1) / count;
    mean.training_loss += members[i].loss / count;
    mean.validation_accuracy += members[i].accuracy / count;
  }
  network.hidden = static_cast<int>(first.rows());
  network.first.assign(first.data(), first.data() + first.size());
  network.second.assign(second.data(), second.data() + second.size());
  mean.network = std::move(network);
  return mean;
}

Status check_samples(const std::vector<TrainingSample>& samples, int labels, const TrainingParams& params) {
  if (labels < 2 || params.hidden < 1 || params.epochs < 1 || params.members < 2 ||
      samples.size() < static_cast<std::size_t>(params.members)) {
    return fail(Errc::kInvalidArgument,
                "training needs two labels and two members at least, as many samples as members, and sizes above 0");
  }
  for (const TrainingSample& sample : samples) {
    if (sample.input.size() != samples.front().input.size() || sample.input.empty() || !finite(sample.input) ||
        sample.label < 0 || sample.label >= labels) {
      return fail(Errc::kInvalidArgument, "the training samples differ in size, or a label is none of the classes");
    }
  }
  return {};
}

}  // namespace

Status validate(const SmallNetwork& n) {
  constexpr int kMost = 4096;
  const auto size = [](int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); };
  if (n.inputs < 1 || n.hidden < 1 || n.outputs < 1 || n.inputs > kMost || n.hidden > kMost || n.outputs > kMost ||
      n.mean.size() != size(n.inputs, 1) || n.sigma.size() != size(n.inputs, 1) ||
      n.first.size() != size(n.hidden, n.inputs + 1) || n.second.size() != size(n.outputs, n.hidden + 1)) {
    return fail(Errc::kInvalidArgument, "the network's layers do not fit each other; train it again");
  }
  const bool spread = std::all_of(n.sigma.begin(), n.sigma.end(), [](double s) { return s > 0.0; });
  if (!spread || !finite(n.mean) || !finite(n.sigma) || !finite(n.first) || !finite(n.second)) {
    return fail(Errc::kInvalidArgument, "the network has numbers that are not finite; train it again");
  }
  return {};
}

std::vector<double> run_network(const SmallNetwork& n, const std::vector<double>& input) {
  SEEKER_ASSERT(input.size() == static_cast<std::size_t>(n.inputs));
  Batch batch{Matrix(n.inputs + 1, 1), Matrix::Zero(n.outputs, 1)};
  for (std::size_t k = 0; k < input.size(); ++k) {
    batch.input(static_cast<Eigen::Index>(k), 0) = (input[k] - n.mean[k]) / n.sigma[k];
  }
  batch.input(n.inputs, 0) = 1.0;
  const Weights w{Eigen::Map<const Matrix>(n.first.data(), n.hidden, n.inputs + 1),
                  Eigen::Map<const Matrix>(n.second.data(), n.outputs, n.hidden + 1)};
  const Matrix output = forward(w, batch, 0.0).output;
  return {output.data(), output.data() + output.size()};
}

Result<TrainedNetwork> train_network(const std::vector<TrainingSample>& samples, int labels,
                                     const TrainingParams& params, Rng& rng) {
  if (const Status valid = check_samples(samples, labels, params); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  SmallNetwork network;
  network.inputs = static_cast<int>(samples.front().input.size());
  network.outputs = labels;
  standardise(samples, network);
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size() - 1; i > 0; --i) {
    std::swap(order[i], order[rng.below(i + 1)]);
  }
  std::vector<Attempt> members;
  for (std::size_t fold = 0; fold < static_cast<std::size_t>(params.members); ++fold) {
    std::vector<std::size_t> kept;
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < order.size(); ++i) {
      (i % static_cast<std::size_t>(params.members) == fold ? kept : used).push_back(order[i]);
    }
    members.push_back(
        train_once(batch_of(samples, used, network), batch_of(samples, kept, network), labels, params, rng));
  }
  return mean_of(members, std::move(network));
}

}  // namespace seeker::vision
