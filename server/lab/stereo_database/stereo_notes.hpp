/// \file
/// What the tables and pictures of the stereo database paper say of one seed. Used by stereo_run.cpp.
#pragma once

#include <array>
#include <vector>

#include "server/lab/stereo_database/stereo_parts.hpp"
#include "server/lab/stereo_database/stereo_pictures.hpp"

namespace seeker::lab::stereo {

/// Indices of the views of a survey that Fig 7 shows: one of each of four places.
inline constexpr std::array<std::size_t, 4> kShownViews = {12, 25, 38, 51};

/// Table 1 and Fig 1.
void note_survey(const SurveyPictures& pictures, const std::vector<vision::StereoFeatures>& seen, StereoRecord& record);

/// Table 2 and Fig 7, of the views of a survey, its databases, and the left pictures of kShownViews. A feature is
/// thinned out where the sparsity rule refuses it at once, or drops its landmark at the end.
void note_building(const std::vector<localize::Sighting>& views, const Built& sparse, const Built& salient,
                   const std::vector<Image>& shown, StereoRecord& record);

/// Fig 12 and the path of the plans; `matched` has the features of each frame that corrected the pose.
void note_frames(const Frames& frames, const std::vector<std::vector<std::size_t>>& matched, StereoRecord& record);

}  // namespace seeker::lab::stereo
