#include "common/core/result.hpp"

namespace seeker {

std::string_view to_string(Errc code) {
  switch (code) {
    case Errc::kInvalidArgument: return "invalid_argument";
    case Errc::kParse: return "parse";
    case Errc::kNotFound: return "not_found";
    case Errc::kUnsupportedVersion: return "unsupported_version";
    case Errc::kCorrupt: return "corrupt";
    case Errc::kIo: return "io";
    case Errc::kTimeout: return "timeout";
    case Errc::kCancelled: return "cancelled";
    case Errc::kRefused: return "refused";
    case Errc::kBusy: return "busy";
    case Errc::kNotReady: return "not_ready";
    case Errc::kLinkLost: return "link_lost";
    case Errc::kTooLarge: return "too_large";
    case Errc::kUnreachable: return "unreachable";
    case Errc::kInternal: return "internal";
  }
  return "internal";
}

CauseAndRemedy cause_and_remedy(const Error& error) {
  constexpr std::string_view kApart = "; ";
  const std::size_t at = error.message.rfind(kApart);
  return at == std::string::npos
             ? CauseAndRemedy{error.message, ""}
             : CauseAndRemedy{error.message.substr(0, at), error.message.substr(at + kApart.size())};
}

}  // namespace seeker
