/// \file
/// What was found when something was checked, and what to do about it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/result.hpp"

namespace seeker::api {

enum class Verdict : std::uint8_t {
  kOk,
  kWarning,  ///< it works, but somebody should look at it
  kFailed,   ///< it does not work, or soon will not
};
/// "OK", "WARNING" or "FAILED".
[[nodiscard]] std::string_view to_string(Verdict verdict);

/// The outcome of one check.
struct Finding {
  std::string check;  ///< stable word, e.g. "robot-disk"
  Verdict verdict = Verdict::kOk;
  std::string found;   ///< one sentence
  std::string remedy;  ///< one sentence that says what to do; may be empty where all is well

  friend bool operator==(const Finding&, const Finding&) = default;
};

/// A failure as a finding; `remedy` where its sentence names none.
[[nodiscard]] Finding failed_finding(std::string check, const Error& error, const std::string& remedy = "");

}  // namespace seeker::api
