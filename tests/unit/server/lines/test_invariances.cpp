#include <functional>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/lines/fast_extractor.hpp"
#include "server/lines/paper_extractor.hpp"
#include "tests/unit/server/lines/scenes.hpp"

namespace seeker::lines {
namespace {

using testing::ScannerModel;
using Extract = std::function<ScanLines(const LaserScan&)>;

const std::vector<std::pair<std::string, Extract>>& extractors() {
  static const std::vector<std::pair<std::string, Extract>> kExtractors{
      {"fast", [](const LaserScan& scan) { return FastExtractor().extract(scan); }},
      {"paper", [](const LaserScan& scan) { return PaperExtractor().extract(scan); }}};
  return kExtractors;
}

/// Every line of `a` has one in `b` with the same numbers, turned by `rotation_rad`.
bool same_lines(const ScanLines& a, const ScanLines& b, double rotation_rad) {
  if (a.lines.size() != b.lines.size()) {
    return false;
  }
  const auto same = [&](const Line& p, const Line& q) {
    return std::abs(p.r_m - q.r_m) < 1e-5 && std::abs(wrap_angle(p.alpha_rad + rotation_rad - q.alpha_rad)) < 1e-5 &&
           (p.covariance - q.covariance).norm() < 1e-3 * p.covariance.norm() && p.points == q.points &&
           std::abs(p.length_m - q.length_m) < 1e-4;
  };
  return std::all_of(a.lines.begin(), a.lines.end(), [&](const Line& p) {
    return std::any_of(b.lines.begin(), b.lines.end(), [&](const Line& q) { return same(p, q); });
  });
}

LaserScan random_scan(std::uint64_t seed) {
  Rng rng(seed);
  const testing::Room room = testing::random_room(rng);
  return testing::scan_room(room, ScannerModel::full_circle(360, 0.01), rng).scan;
}

/// The same full circle from a scanner whose cut is `beams` later.
LaserScan cut_elsewhere(const LaserScan& scan, std::size_t beams) {
  LaserScan moved = scan;
  moved.angle_min_rad = scan.angle_rad(beams);
  std::rotate(moved.ranges_m.begin(), moved.ranges_m.begin() + static_cast<std::ptrdiff_t>(beams),
              moved.ranges_m.end());
  return moved;
}

RC_GTEST_PROP(LineInvariance, TurningTheScanTurnsTheLines, ()) {
  const LaserScan scan = random_scan(*rc::gen::inRange<std::uint64_t>(1, 1'000'000));
  const double rotation_rad = *rc::gen::inRange(-314, 314) / 100.0;
  LaserScan turned = scan;
  turned.angle_min_rad += rotation_rad;
  for (const auto& [name, extract] : extractors()) {
    RC_ASSERT(same_lines(extract(scan), extract(turned), rotation_rad));
  }
}

RC_GTEST_PROP(LineInvariance, TheCutOfAFullCircleDoesNotMatter, ()) {
  const LaserScan scan = random_scan(*rc::gen::inRange<std::uint64_t>(1, 1'000'000));
  const LaserScan moved = cut_elsewhere(scan, *rc::gen::inRange<std::size_t>(0, 360));
  for (const auto& [name, extract] : extractors()) {
    RC_ASSERT(same_lines(extract(scan), extract(moved), 0.0));
  }
}

RC_GTEST_PROP(LineInvariance, ThePlaceOfTheCutInAClosedRoomDoesNotMatter, ()) {
  // No gap anywhere: the circle has to be opened in a corner.
  const LaserScan scan = scan_of(box_room(-1.7, -1.2, 2.1, 1.9), ScannerModel::full_circle(720, 0.0), 0.01,
                                 *rc::gen::inRange<std::uint64_t>(1, 1'000'000));
  const LaserScan moved = cut_elsewhere(scan, *rc::gen::inRange<std::size_t>(0, 720));
  const ScanLines a = FastExtractor().extract(scan);
  RC_ASSERT(a.lines.size() >= 4U);
  RC_ASSERT(same_lines(a, FastExtractor().extract(moved), 0.0));
}

RC_GTEST_PROP(LineInvariance, TheDirectionOfTheScannerDoesNotMatter, ()) {
  const LaserScan scan = random_scan(*rc::gen::inRange<std::uint64_t>(1, 1'000'000));
  for (const auto& [name, extract] : extractors()) {
    const ScanLines a = extract(scan);
    const ScanLines b = extract(turned_round(scan));
    RC_ASSERT(same_lines(a, b, 0.0));
    for (std::size_t k = 0; k < a.lines.size(); ++k) {
      RC_ASSERT(a.lines[k].first_beam == 359U - b.lines[k].first_beam);
      RC_ASSERT(a.lines[k].last_beam == 359U - b.lines[k].last_beam);
    }
  }
}

RC_GTEST_PROP(LineInvariance, TheScaleOfTheQualityDoesNotMatter, ()) {
  LaserScan scan = random_scan(*rc::gen::inRange<std::uint64_t>(1, 1'000'000));
  for (std::size_t k = 0; k < scan.ranges_m.size(); ++k) {
    scan.quality.push_back(static_cast<std::uint8_t>(1 + k % 40));
  }
  LaserScan scaled = scan;
  for (std::uint8_t& quality : scaled.quality) {
    quality = static_cast<std::uint8_t>(6 * quality);
  }
  for (const auto& [name, extract] : extractors()) {
    RC_ASSERT(same_lines(extract(scan), extract(scaled), 0.0));
  }
}

}  // namespace
}  // namespace seeker::lines
