#include "server/app/missions/picture_round.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"

namespace seeker::app {

void PictureRound::start(const Situation& situation, int headings) {
  sweep_.start(situation.odom_T_base, headings);
  started_ = true;
  asked_at_.reset();
  seen_.clear();
}

void PictureRound::step(const Situation& situation, Decision& decision) {
  SEEKER_ASSERT(active());
  if (!asked_at_) {
    sweep_.step(situation.odom_T_base, situation, decision);
    // The turns are those of the stereo camera's looks; the picture is another camera's.
    if (!std::exchange(decision.wants_look, false)) {
      return;
    }
    asked_at_ = situation.now;
  }
  if (to_seconds(situation.now - *asked_at_) <= picture_timeout_s_) {
    decision.wants_image = true;
    return;
  }
  asked_at_.reset();
  if (sweep_.failed()) {
    decision.events.push_back({"picture-left-out", "no picture came in time", api::Severity::kWarning});
  }
}

void PictureRound::take(const Recognition& recognition) {
  if (active() && asked_at_) {
    asked_at_.reset();
    seen_.push_back(recognition);
    sweep_.looked();
  }
}

void PictureRound::map_moved(const MapMove& move) {
  for (Recognition& recognition : seen_) {
    recognition.map_T_base = move * recognition.map_T_base;
  }
}

void PictureRound::resumed() {
  asked_at_.reset();
  sweep_.resumed();
}

std::vector<Recognition> PictureRound::finish() {
  started_ = false;
  asked_at_.reset();
  return std::exchange(seen_, {});
}

int pictures_around(const vision::ViewParams& view, const RoundParams& params) {
  const double step_rad = view.photo_fov_rad - params.overlap_rad;
  const int pictures = step_rad > 0.0 ? static_cast<int>(std::ceil(kTwoPi / step_rad)) : api::kMaxHeadings;
  return std::clamp(pictures, 1, api::kMaxHeadings);
}

std::vector<search::Look> to_looks(const std::vector<Recognition>& round) {
  std::vector<search::Look> looks;
  looks.reserve(round.size());
  for (const Recognition& recognition : round) {
    looks.push_back({recognition.stamp, recognition.map_T_base, Matrix3::Zero(), recognition.sightings,
                     recognition.scan ? &*recognition.scan : nullptr,
                     recognition.sonar ? &*recognition.sonar : nullptr});
  }
  return looks;
}

}  // namespace seeker::app
