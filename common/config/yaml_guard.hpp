/// \file
/// A check of YAML text before a document is built from it. Internal to this folder.
#pragma once

#include <string>
#include <string_view>

#include "common/core/result.hpp"

namespace seeker::config {

/// Refuses text that does not parse, anchors and aliases, and more than a million values; `name` is used in messages.
[[nodiscard]] Status guard_yaml(std::string_view text, const std::string& name);

}  // namespace seeker::config
