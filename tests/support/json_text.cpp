#include "tests/support/json_text.hpp"

#include <nlohmann/json.hpp>

namespace seeker::testing {

bool is_json(const std::string& text) { return nlohmann::json::accept(text); }

}  // namespace seeker::testing
