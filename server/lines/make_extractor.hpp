/// \file
/// The line extractors by name, and their parameters.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "server/lines/extractor.hpp"
#include "server/lines/fast_extractor.hpp"
#include "server/lines/paper_extractor.hpp"
#include "server/lines/regression_extractor.hpp"
#include "server/lines/split_extractors.hpp"

namespace seeker::lines {

enum class ExtractorKind : std::uint8_t {
  kFast,           ///< FastExtractor
  kFiveModes,      ///< PaperExtractor: spec S5
  kRegression,     ///< RegressionExtractor: spec S1.4
  kSplitAndMerge,  ///< SplitAndMerge
  kIepf,           ///< Iepf
};
inline constexpr std::array kExtractorKinds{ExtractorKind::kFast, ExtractorKind::kFiveModes, ExtractorKind::kRegression,
                                            ExtractorKind::kSplitAndMerge, ExtractorKind::kIepf};
/// Name as in the field `lines.extractor` of a robot file.
[[nodiscard]] std::string_view to_string(ExtractorKind kind);

/// The chosen extractor with the parameters of each.
struct ExtractorParams {
  ExtractorKind kind = ExtractorKind::kFast;
  FastParams fast;
  PaperParams five_modes;
  RegressionParams regression;
  SplitParams split;  ///< of kSplitAndMerge and kIepf
};

[[nodiscard]] std::unique_ptr<Extractor> make_extractor(const ExtractorParams& params);

}  // namespace seeker::lines
