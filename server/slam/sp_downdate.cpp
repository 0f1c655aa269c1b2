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

// Eigen uses the vector unit the whole program is compiled for (SSE2); this takes the widest that it finds.

constexpr Index kColumns = 4;  ///< taken at once

/// Numbers in one register. (GCC drops the attribute where its size depends on a template's argument.)
template <Index kLanes>
struct Wide;
template <>
struct Wide<4> {
  using Pack = double __attribute__((vector_size(32)));
  static constexpr Index kPanel = 8;
};
template <>
struct Wide<8> {
  using Pack = double __attribute__((vector_size(64)));
  static constexpr Index kPanel = 16;
};

/// W in panels of rows, each with its columns one after the other, filled up with zeros: the kernel reads straight on,
/// for any number of rows.
template <Index kPanel>
std::vector<double> panels_of(const Eigen::Ref<const Eigen::MatrixXd>& w) {
  const Index rows = w.rows();
  const Index width = w.cols();
  const Index panels = (rows + kPanel - 1) / kPanel;
  std::vector<double> packed(static_cast<std::size_t>(panels * kPanel * width), 0.0);
  for (Index panel = 0; panel < panels; ++panel) {
    const Index first = panel * kPanel;
    const Index count = std::min(kPanel, rows - first);
    double* target = packed.data() + first * width;
    for (Index k = 0; k < width; ++k) {
      std::memcpy(target + k * kPanel, w.data() + k * w.outerStride() + first,
                  static_cast<std::size_t>(count) * sizeof(double));
    }
  }
  return packed;
}

/// Sums of a panel of rows by 4 columns. The loop over columns is unrolled, for -O2 keeps in memory what it indexes,
/// at a quarter of the speed (`update` in bench_spmap).
template <Index kLanes>
struct Sums {
  using Pack = typename Wide<kLanes>::Pack;
  static constexpr Index kPanel = Wide<kLanes>::kPanel;

  Pack low[kColumns];
  Pack high[kColumns];

  [[gnu::always_inline]] inline Sums(const double* rows, const double* factors, Index width) : low{}, high{} {
    for (Index k = 0; k < width; ++k) {
      Pack a;
      Pack b;
      std::memcpy(&a, rows + k * kPanel, sizeof a);
      std::memcpy(&b, rows + k * kPanel + kLanes, sizeof b);
#pragma GCC unroll 4
      for (Index c = 0; c < kColumns; ++c) {
        const double factor = factors[k * kPanel + c];
        low[c] += a * factor;
        high[c] += b * factor;
      }
    }
  }
};

/// p -= rows * columns^T where all rows and columns of the tile are there.
template <Index kLanes>
[[gnu::always_inline]] inline void full_tile(double* p, Index stride, const double* rows, const double* factors,
                                             Index width) {
  using Pack = typename Wide<kLanes>::Pack;
  const Sums<kLanes> sums(rows, factors, width);
#pragma GCC unroll 4
  for (Index c = 0; c < kColumns; ++c) {
    double* target = p + c * stride;
    Pack a;
    Pack b;
    std::memcpy(&a, target, sizeof a);
    std::memcpy(&b, target + kLanes, sizeof b);
    a -= sums.low[c];
    b -= sums.high[c];
    std::memcpy(target, &a, sizeof a);
    std::memcpy(target + kLanes, &b, sizeof b);
  }
}

/// The same at an edge: `left` of the rows and `columns` of the columns are there.
template <Index kLanes>
[[gnu::always_inline]] inline void edge_tile(double* p, Index stride, const double* rows, const double* factors,
                                             Index width, Index left, Index columns) {
  const Sums<kLanes> sums(rows, factors, width);
  for (Index c = 0; c < columns; ++c) {
    double column[Wide<kLanes>::kPanel];
    std::memcpy(column, &sums.low[c], sizeof sums.low[c]);
    std::memcpy(column + kLanes, &sums.high[c], sizeof sums.high[c]);
    for (Index r = 0; r < left; ++r) {
      p[c * stride + r] -= column[r];
    }
  }
}

template <Index kLanes>
[[gnu::always_inline]] inline void downdate_panels(double* p, Index stride, const double* packed, Index rows,
                                                   Index width) {
  constexpr Index kPanel = Wide<kLanes>::kPanel;
  for (Index j = 0; j < rows; j += kColumns) {
    const double* factors = packed + (j / kPanel) * kPanel * width + j % kPanel;
    // Whole panels of rows: those above the diagonal in the first one are scratch.
    for (Index i = j / kPanel * kPanel; i < rows; i += kPanel) {
      double* target = p + j * stride + i;
      const double* panel = packed + i * width;
      if (i + kPanel <= rows && j + kColumns <= rows) {
        full_tile<kLanes>(target, stride, panel, factors, width);
      } else {
        edge_tile<kLanes>(target, stride, panel, factors, width, std::min(kPanel, rows - i),
                          std::min(kColumns, rows - j));
      }
    }
  }
}

[[gnu::target("avx2,fma")]] void downdate_256(double* p, Index stride, const double* packed, Index rows, Index width) {
  downdate_panels<4>(p, stride, packed, rows, width);
}

[[gnu::target("avx512f")]] void downdate_512(double* p, Index stride, const double* packed, Index rows, Index width) {
  downdate_panels<8>(p, stride, packed, rows, width);
}

#endif

}  // namespace

void downdate_lower(Eigen::Ref<Eigen::MatrixXd> p, const Eigen::Ref<const Eigen::MatrixXd>& w) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f") != 0) {
    downdate_512(p.data(), p.outerStride(), panels_of<Wide<8>::kPanel>(w).data(), p.rows(), w.cols());
    return;
  }
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) {
    downdate_256(p.data(), p.outerStride(), panels_of<Wide<4>::kPanel>(w).data(), p.rows(), w.cols());
    return;
  }
#endif
  downdate_portable(p, w);
}

}  // namespace seeker::slam
