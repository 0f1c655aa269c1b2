#include "server/fleet/scan_signature.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <nanoflann.hpp>

#include "common/core/angle.hpp"

namespace seeker::fleet {
namespace {

constexpr std::size_t kLeafSize = 8;

/// Distance to the nearest wall that faces `p`, for each bearing; the range where there is none.
std::vector<double> profile_at(const Point2& p, const std::vector<slam::SeenPoints>& seen,
                               const SignatureParams& params) {
  std::vector<double> profile(static_cast<std::size_t>(params.bearings), params.range_m);
  for (const slam::SeenPoints& scan : seen) {
    for (const slam::OrientedPoint& point : scan.points) {
      const Point2 to = point.p - p;
      const double range_m = to.norm();
      if (range_m >= params.range_m || point.normal.dot(to) >= 0.0) {
        continue;
      }
      const double turn = (std::atan2(to.y(), to.x()) + kPi) / kTwoPi;
      const auto bearing = static_cast<std::size_t>(turn * params.bearings) % profile.size();
      profile[bearing] = std::min(profile[bearing], range_m);
    }
  }
  return profile;
}

}  // namespace

ScanSignature signature_at(const Point2& p, const std::vector<slam::SeenPoints>& seen, const SignatureParams& params) {
  const std::vector<double> profile = profile_at(p, seen, params);
  const double n = static_cast<double>(profile.size());
  ScanSignature signature{};
  for (std::size_t k = 0; k < kSignatureSize; ++k) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
      sum += profile[i] * std::polar(1.0, -kTwoPi * static_cast<double>(k * i) / n);
    }
    signature[k] = static_cast<float>(std::abs(sum) / (n * params.range_m));
  }
  return signature;
}

struct SignatureIndex::Tree {
  using Entries = std::vector<std::pair<ScanSignature, std::size_t>>;
  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Tree>, Tree,
                                                    static_cast<int>(kSignatureSize)>;

  explicit Tree(Entries list)
      : entries(std::move(list)),
        index(static_cast<int>(kSignatureSize), *this, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {}

  // The names are nanoflann's.
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return entries.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t entry, std::size_t dimension) const {
    return entries[entry].first[dimension];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }

  Entries entries;
  Index index;
};

SignatureIndex::SignatureIndex() = default;
SignatureIndex::SignatureIndex(SignatureIndex&& other) noexcept = default;
SignatureIndex& SignatureIndex::operator=(SignatureIndex&& other) noexcept = default;
SignatureIndex::~SignatureIndex() = default;

SignatureIndex::SignatureIndex(std::vector<std::pair<ScanSignature, std::size_t>> entries) {
  if (!entries.empty()) {
    tree_ = std::make_unique<Tree>(std::move(entries));
  }
}

std::size_t SignatureIndex::size() const { return tree_ ? tree_->entries.size() : 0; }

std::vector<SignatureIndex::Found> SignatureIndex::nearest(const ScanSignature& signature, std::size_t at_most) const {
  std::vector<Found> found;
  const std::size_t wanted = std::min(at_most, size());
  if (wanted == 0) {
    return found;
  }
  std::vector<std::uint32_t> entries(wanted);
  std::vector<float> squares(wanted);
  const std::size_t count = tree_->index.knnSearch(signature.data(), wanted, entries.data(), squares.data());
  found.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    found.push_back({tree_->entries[entries[k]].second, std::sqrt(static_cast<double>(squares[k]))});
  }
  return found;
}

}  // namespace seeker::fleet
