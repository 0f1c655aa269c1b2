/// \file
/// Whether what a program printed is JSON.
#pragma once

#include <string>

namespace seeker::testing {

/// Whether the text is one JSON document (RFC 8259).
[[nodiscard]] bool is_json(const std::string& text);

}  // namespace seeker::testing
