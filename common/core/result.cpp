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

}  // namespace seeker
