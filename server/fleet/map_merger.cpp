#include "server/fleet/map_merger.hpp"

#include <algorithm>
#include <cmath>

#include "server/fleet/merge_question.hpp"

namespace seeker::fleet {
namespace {

/// Whether a second hypothesis is good enough to doubt the best one. One that may be slid along a corridor says only
/// that both have seen corridors. Neither does one count that lays places upon each other whose pictures differ, while
/// pictures confirm the best one.
bool rivals(const MergeHypothesis& best, const MergeHypothesis& other, const MergeParams& params) {
  const bool denied = best.pictures.confirms(params.pictures) && other.pictures.denies(params.pictures);
  return !denied && other.weak_wall_m >= params.min_weak_wall_m &&
         other.contradiction <= params.max_rival_contradiction &&
         other.denied_piece_m <= params.max_rival_denied_piece_m &&
         other.support() > params.rival_ratio * best.support();
}

/// A local map that has gone on to where the other robot has not been makes no pair, and shows shared walls all the
/// same. Where pictures show the same, less wall does.
bool speaks_enough(const MergeHypothesis& best, const MergeParams& params) {
  const bool enough_walls =
      best.pictures.confirms(params.pictures) ||
      (std::max(best.pairs.size(), best.witnesses) >= params.min_pairs &&
       best.shared_wall_m >= params.sure_shared_wall_m && best.weak_wall_m >= params.sure_weak_wall_m);
  return enough_walls && best.weak_wall_m >= params.sure_weak_share * best.shared_wall_m &&
         best.contradiction <= params.sure_contradiction;
}

/// What both robots have seen does not fix the relative pose.
bool too_little(const MergeHypothesis& best, const MergeParams& params) {
  return best.shared_wall_m < params.min_shared_wall_m || best.weak_wall_m < params.min_weak_wall_m;
}

}  // namespace

std::string_view to_string(MergeMethod method) {
  switch (method) {
    case MergeMethod::kPicturesAndLaser: return "pictures_and_laser";
    case MergeMethod::kPrinted: return "printed";
  }
  return "unknown";
}

std::string_view to_string(MergeVerdict verdict) {
  switch (verdict) {
    case MergeVerdict::kInsufficientOverlap: return "INSUFFICIENT_OVERLAP";
    case MergeVerdict::kAmbiguous: return "AMBIGUOUS";
    case MergeVerdict::kContradicted: return "CONTRADICTED";
    case MergeVerdict::kMerged: return "MERGED";
  }
  return "unknown";
}

double allowed_piece_m(const MergeHypothesis& best, const MergeParams& params) {
  const double most_m = std::max(params.sure_denied_piece_m, params.kept_denied_piece_m);
  return std::clamp(params.denied_piece_share * best.shared_wall_m, params.sure_denied_piece_m, most_m);
}

double confidence_of(const MergeHypothesis& hypothesis, const MergeParams& params) {
  const double seen = 1.0 - std::exp(-hypothesis.shared_wall_m / (0.5 * params.sure_shared_wall_m));
  const double agreed = std::clamp(1.0 - hypothesis.contradiction / (2.0 * params.max_contradiction), 0.0, 1.0);
  return seen * agreed;
}

MapMerger::MapMerger(const MergeParams& params) : params_(params), check_(params.pair) {}

MergeAnswer MapMerger::merge(PreparedMap& a, PreparedMap& b) const {
  if (params_.method == MergeMethod::kPrinted) {
    return merge_as_printed(a, b);
  }
  MergeAnswer answer;
  const PicturePairs pictures(a, b, params_.pictures);
  MergeQuestion question(a, b, pictures, params_);
  question.compare(check_, answer);
  answer.hypotheses = question.hypotheses();
  judge(answer, params_);
  return answer;
}

void judge(MergeAnswer& answer, const MergeParams& params) {
  answer.verdict = MergeVerdict::kInsufficientOverlap;
  answer.reason = "no local map of one robot is to be seen in the map of the other; drive on and ask again";
  if (answer.hypotheses.empty()) {
    return;
  }
  const MergeHypothesis& best = answer.hypotheses.front();
  const bool rival = std::any_of(answer.hypotheses.begin() + 1, answer.hypotheses.end(),
                                 [&](const MergeHypothesis& other) { return rivals(best, other, params); });
  if (best.contradiction > params.max_contradiction) {
    answer.verdict = MergeVerdict::kContradicted;
    answer.reason = "places look alike, but laid upon each other the maps deny what the other has seen";
  } else if (best.deformation.ratio() > params.deformation.max_ratio) {
    answer.verdict = MergeVerdict::kContradicted;
    answer.reason = "places look alike, but the maps would have to deform more than their uncertainty allows";
  } else if (too_little(best, params) && best.pictures.confirms(params.pictures) &&
             best.shared_wall_m >= params.pictured_shared_wall_m) {
    answer.verdict = MergeVerdict::kAmbiguous;
    answer.reason = "pictures show the same places, but both robots have seen few walls there; confirm or drive on";
  } else if (too_little(best, params)) {
    answer.reason = "what both robots have seen is too little to be sure of the place; drive on and ask again";
  } else if (rival) {
    answer.verdict = MergeVerdict::kAmbiguous;
    answer.reason = "the maps fit at more than one relative pose; choose one or drive on until they differ";
  } else if (best.pictures.denies(params.pictures)) {
    answer.verdict = MergeVerdict::kAmbiguous;
    answer.reason = "the maps fit, but pictures taken there show different things; confirm or drive on";
  } else if (best.denied_piece_m > allowed_piece_m(best, params)) {
    answer.verdict = MergeVerdict::kAmbiguous;
    answer.reason =
        "the maps fit at one relative pose, but one robot has looked through a wall of the other; confirm or drive on";
  } else if (!speaks_enough(best, params)) {
    answer.verdict = MergeVerdict::kAmbiguous;
    answer.reason = "the maps fit at one relative pose, but the evidence is weak; confirm it or drive on";
  } else {
    answer.verdict = MergeVerdict::kMerged;
    answer.reason = "the maps fit at one relative pose only and agree where both have observed";
  }
}

}  // namespace seeker::fleet
