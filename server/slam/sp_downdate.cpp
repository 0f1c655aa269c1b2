#include <cstring>

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

/// Column j alone, from row `from` on.
SEEKER_WIDE void column(double* p, const double* w, Index rows, Index stride, Index width, Index j, Index from) {
  for (Index k = 0; k < width; ++k) {
    const double* wk = w + k * stride;
    const double factor = wk[j];
    for (Index i = from; i < rows; ++i) {
      p[i] -= wk[i] * factor;
    }
  }
}

/// Columns j..j+3, rows in pairs of packs from j on; the first row left over. Writes 6 values above the diagonal.
SEEKER_WIDE Index panel(double* p, Index p_stride, const double* w, Index rows, Index stride, Index width, Index j) {
  Index i = j;
  for (; i + 2 * kPack <= rows; i += 2 * kPack) {
    Pack low[4] = {};
    Pack high[4] = {};
    for (Index k = 0; k < width; ++k) {
      const double* wk = w + k * stride;
      Pack a;
      Pack b;
      std::memcpy(&a, wk + i, sizeof a);
      std::memcpy(&b, wk + i + kPack, sizeof b);
      for (int c = 0; c < 4; ++c) {
        const double f = wk[j + c];
        const Pack factor = {f, f, f, f};
        low[c] += a * factor;
        high[c] += b * factor;
      }
    }
    for (int c = 0; c < 4; ++c) {
      double* target = p + c * p_stride + i;
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
  return i;
}

SEEKER_WIDE void downdate_wide(double* p, Index p_stride, const double* w, Index rows, Index stride, Index width) {
  Index j = 0;
  for (; j + kPack <= rows; j += kPack) {
    double* columns = p + j * p_stride;
    const Index left = panel(columns, p_stride, w, rows, stride, width, j);
    for (Index c = 0; c < kPack; ++c) {
      column(columns + c * p_stride, w, rows, stride, width, j + c, left);
    }
  }
  for (; j < rows; ++j) {
    column(p + j * p_stride, w, rows, stride, width, j, j);
  }
}

bool has_wide_unit() { return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0; }

#endif

}  // namespace

void downdate_lower(Eigen::Ref<Eigen::MatrixXd> p, const Eigen::Ref<const Eigen::MatrixXd>& w) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (has_wide_unit()) {
    downdate_wide(p.data(), p.outerStride(), w.data(), p.rows(), w.outerStride(), w.cols());
    return;
  }
#endif
  downdate_portable(p, w);
}

}  // namespace seeker::slam
