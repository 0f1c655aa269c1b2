/// \file
/// YAML files of the recogniser of solids: what `seeker-lab train-solids` writes.
#pragma once

#include <filesystem>
#include <string>

#include "common/config/fields.hpp"
#include "server/vision/solids/solid_recogniser.hpp"

namespace seeker::vision {

// Found beside the structs they describe (see config::Fields).
void describe(config::Fields& f, SegmentParams& params);
void describe(config::Fields& f, SmallNetwork& network);
void describe(config::Fields& f, SolidModel& model);

}  // namespace seeker::vision

namespace seeker::options {

/// Loads a model. The errors kParse, kUnsupportedVersion and kInvalidArgument name the file.
[[nodiscard]] Result<vision::SolidModel> load_solid_model(const std::filesystem::path& path);
/// The text of the file of a model.
[[nodiscard]] std::string print_solid_model(const vision::SolidModel& model);

}  // namespace seeker::options
