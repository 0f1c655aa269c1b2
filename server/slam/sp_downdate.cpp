#include <algorithm>
#include <cstring>
#include <vector>

#include "server/slam/sp_covariance.hpp"

namespace seeker::slam {
namespace {

void downdate_portable(Eigen::Ref<Eigen::MatrixXd> p, const Eigen::Ref<const Eigen::MatrixXd>& w) {
  p.selfadjointView<Eigen::Lower>().rankUpdate(w, -1.0);
}

#if defined(__x86_64__) && defined(__GNUC__)

// Eigen uses the vector unit the whole program is compiled for (SSE2); this one function takes what it finds.
#define SEEKER_WIDE __attribute__((target("avx2,fma")))

using Pack = double __attribute__((vector_size(32)));
constexpr Index kPack = 4;
constexpr Index kPanel = 2 * kPack;  ///< rows taken at once: 8 sums of a pack fill half of the registers

/// W in panels of 8 rows, each with its columns one after the other, filled up with zeros: the kernel reads straight
/// on, whatever the number of rows.
void pack_panels(const Eigen::Ref<const Eigen::MatrixXd>& w, std::vector<double>& packed) {
  const Index rows = w.rows();
  const Index width = w.cols();
  const Index panels = (rows + kPanel - 1) / kPanel;
  packed.assign(static_cast<std::size_t>(panels * kPanel * width), 0.0);
  for (Index panel = 0; panel < panels; ++panel) {
    const Index first = panel * kPanel;
    const Index count = std::min(kPanel, rows - first);
    double* target = packed.data() + first * width;
    for (Index k = 0; k < width; ++k) {
      std::memcpy(target + k * kPanel, w.data() + k * w.outerStride() + first,
                  static_cast<std::size_t>(count) * sizeof(double));
    }
  }
}

/// 8 rows of 4 columns: p -= rows * columns^T. `left` of the rows and `columns` of the columns are there.
SEEKER_WIDE void tile(double* p, Index stride, const double* rows, const double* factors, Index width, Index left,
                      Index columns) {
  Pack low[4] = {};
  Pack high[4] = {};
  for (Index k = 0; k < width; ++k) {
    Pack a;
    Pack b;
    std::memcpy(&a, rows + k * kPanel, sizeof a);
    std::memcpy(&b, rows + k * kPanel + kPack, sizeof b);
    for (Index c = 0; c < 4; ++c) {
      const double f = factors[k * kPanel + c];
      const Pack factor = {f, f, f, f};
      low[c] += a * factor;
      high[c] += b * factor;
    }
  }
  for (Index c = 0; c < columns; ++c) {
    double* target = p + c * stride;
    double sums[kPanel];
    std::memcpy(sums, &low[c], sizeof low[c]);
    std::memcpy(sums + kPack, &high[c], sizeof high[c]);
    for (Index r = 0; r < left; ++r) {
      target[r] -= sums[r];
    }
  }
}

/// The same where all 8 rows and all 4 columns are there.
SEEKER_WIDE void full_tile(double* p, Index stride, const double* rows, const double* factors, Index width) {
  Pack low[4] = {};
  Pack high[4] = {};
  for (Index k = 0; k < width; ++k) {
    Pack a;
    Pack b;
    std::memcpy(&a, rows + k * kPanel, sizeof a);
    std::memcpy(&b, rows + k * kPanel + kPack, sizeof b);
    for (Index c = 0; c < 4; ++c) {
      const double f = factors[k * kPanel + c];
      const Pack factor = {f, f, f, f};
      low[c] += a * factor;
      high[c] += b * factor;
    }
  }
  for (Index c = 0; c < 4; ++c) {
    double* target = p + c * stride;
    Pack a;
    Pack b;
    std::memcpy(&a, target, sizeof a);
    std::memcpy(&b, target + kPack, sizeof b);
    a -= low[c];
    b -= high[c];
    std::memcpy(target, &a, sizeof a);
    std::memcpy(target + kPack, &b, sizeof b);
  }
}

SEEKER_WIDE void downdate_wide(double* p, Index stride, const double* packed, Index rows, Index width) {
  for (Index j = 0; j < rows; j += kPack) {
    const double* factors = packed + (j / kPanel) * kPanel * width + j % kPanel;
    const Index columns = std::min(kPack, rows - j);
    // Whole panels of rows: those above the diagonal in the first one are scratch.
    for (Index i = j / kPanel * kPanel; i < rows; i += kPanel) {
      double* target = p + j * stride + i;
      const double* panel = packed + i * width;
      if (columns == kPack && i + kPanel <= rows) {
        full_tile(target, stride, panel, factors, width);
      } else {
        tile(target, stride, panel, factors, width, std::min(kPanel, rows - i), columns);
      }
    }
  }
}

bool has_wide_unit() { return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0; }

#endif

}  // namespace

void downdate_lower(Eigen::Ref<Eigen::MatrixXd> p, const Eigen::Ref<const Eigen::MatrixXd>& w) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (has_wide_unit()) {
    std::vector<double> packed;
    pack_panels(w, packed);
    downdate_wide(p.data(), p.outerStride(), packed.data(), p.rows(), w.cols());
    return;
  }
#endif
  downdate_portable(p, w);
}

}  // namespace seeker::slam
