#include "common/api/diagnosis.hpp"

#include <utility>

namespace seeker::api {

Finding failed_finding(std::string check, const Error& error, const std::string& remedy) {
  CauseAndRemedy parts = cause_and_remedy(error);
  if (parts.remedy.empty()) {
    parts.remedy = remedy;
  }
  return {std::move(check), Verdict::kFailed, std::move(parts.cause), std::move(parts.remedy)};
}

}  // namespace seeker::api
