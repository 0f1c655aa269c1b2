#include "server/lab/stereo_database/stereo_notes.hpp"

#include "server/lab/experiments/table.hpp"

namespace seeker::lab::stereo {
namespace {

/// Which features of a survey became what, the sparsity rule applied at once or at the end.
class Fates {
 public:
  Fates(const Built& sparse, const Built& salient) : sparse_(sparse), salient_(salient) {}

  [[nodiscard]] bool in_range(std::size_t view, std::size_t feature) const {
    return fate(view, feature) != localize::FeatureFate::kOutOfRange;
  }
  [[nodiscard]] FeatureMark mark(std::size_t view, std::size_t feature) const {
    if (fate(view, feature) == localize::FeatureFate::kMatched) {
      return FeatureMark::kSquare;
    }
    const bool stays = fate(view, feature) == localize::FeatureFate::kInserted &&
                       sparse_.database->find(salient_.fates[view].landmarks[feature]) != nullptr;
    return stays ? FeatureMark::kCircle : FeatureMark::kCross;
  }
  [[nodiscard]] int count(std::size_t view, FeatureMark wanted) const {
    int found = 0;
    for (std::size_t k = 0; k < salient_.fates[view].fates.size(); ++k) {
      found += in_range(view, k) && mark(view, k) == wanted ? 1 : 0;
    }
    return found;
  }

 private:
  [[nodiscard]] localize::FeatureFate fate(std::size_t view, std::size_t feature) const {
    return salient_.fates[view].fates[feature];
  }
  const Built& sparse_;
  const Built& salient_;
};

}  // namespace

void note_survey(const SurveyPictures& pictures, const std::vector<vision::StereoFeatures>& seen,
                 StereoRecord& record) {
  StereoResult& result = record.result;
  Table table(
      {"picture", "left_keypoints", "right_keypoints", "matches_before_constraints", "matches_after_constraints"});
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::size_t before = seen[i].before_constraints.size();
    const std::size_t after = seen[i].features.size();
    table.add({std::to_string(i + 1), std::to_string(seen[i].left_keypoints), std::to_string(seen[i].right_keypoints),
               std::to_string(before), std::to_string(after)});
    ++result.survey_pictures;
    result.survey_before += static_cast<int>(before);
    result.survey_after += static_cast<int>(after);
    result.survey_reduced += after < before ? 1 : 0;
  }
  record.table1_csv = table.csv();
  record.pictures.push_back({"fig1", match_figure(pictures.pairs.front(), seen.front())});
}

void note_building(const std::vector<localize::Sighting>& views, const Built& sparse, const Built& salient,
                   const std::vector<Image>& shown, StereoRecord& record) {
  const Fates fates(sparse, salient);
  Table table({"view", "features", "in_range", "matched", "sparsified", "inserted", "landmarks"});
  for (std::size_t i = 0; i < views.size(); ++i) {
    table.add({std::to_string(i + 1), std::to_string(salient.counts[i].features),
               std::to_string(salient.counts[i].in_range), std::to_string(fates.count(i, FeatureMark::kSquare)),
               std::to_string(fates.count(i, FeatureMark::kCross)),
               std::to_string(fates.count(i, FeatureMark::kCircle)), std::to_string(salient.sizes[i])});
  }
  table.add({"end", "", "", "", "", "", std::to_string(salient.database->size())});  // observed often enough
  record.table2_csv = table.csv();
  StereoResult& result = record.result;
  std::vector<MarkedView> figure;
  for (std::size_t n = 0; n < shown.size(); ++n) {
    const std::size_t view = kShownViews[n];
    const int added = fates.count(view, FeatureMark::kCircle);
    const int known = fates.count(view, FeatureMark::kSquare);
    const int thinned = fates.count(view, FeatureMark::kCross);
    result.added_features += added;
    result.known_features += known;
    result.thinned_features += thinned;
    MarkedView marked{"View " + std::to_string(view + 1) + ": " + std::to_string(added) + " new (circles), " +
                          std::to_string(known) + " associated (squares), " + std::to_string(thinned) +
                          " thinned out (crosses)",
                      shown[n],
                      {}};
    for (std::size_t k = 0; k < views[view].features.size(); ++k) {
      if (fates.in_range(view, k)) {
        marked.features.push_back({views[view].features[k].left, fates.mark(view, k)});
      }
    }
    figure.push_back(std::move(marked));
  }
  record.pictures.push_back({"fig7", marked_figure(figure)});
}

void note_frames(const Frames& frames, const std::vector<std::vector<std::size_t>>& matched, StereoRecord& record) {
  for (const DriveFrame& frame : frames) {
    record.path.push_back(frame.world_T_base.translation());
  }
  StereoResult& result = record.result;
  std::vector<MarkedView> figure;
  for (const std::size_t i : kept_frames(frames.size())) {
    const std::vector<vision::StereoFeature>& features = frames[i].seen.features;
    const auto of_match = static_cast<int>(matched[i].size());
    const int others = static_cast<int>(features.size()) - of_match;
    MarkedView marked{"Frame " + std::to_string(i + 1) + ": " + std::to_string(of_match) + " matched (circles), " +
                          std::to_string(others) + " unmatched (crosses)",
                      frames[i].pair.left,
                      {}};
    for (const vision::StereoFeature& feature : features) {
      marked.features.push_back({feature.left, FeatureMark::kCross});
    }
    for (const std::size_t k : matched[i]) {
      marked.features[k].mark = FeatureMark::kCircle;
    }
    result.frames_shown += of_match > 0 ? 1 : 0;
    result.frames_matched += of_match;
    result.frames_unmatched += others;
    figure.push_back(std::move(marked));
  }
  record.pictures.push_back({"fig12", marked_figure(figure)});
}

}  // namespace seeker::lab::stereo
