#include "server/app/metrics/metrics_settings.hpp"

namespace seeker::app {

Status validate(const MetricsSettings& settings) {
  if (settings.address != "[::1]" && settings.address.rfind("127.", 0) != 0) {
    return fail(Errc::kInvalidArgument, "metrics are for this machine alone, not for '" + settings.address +
                                            "'; use 127.0.0.1, and a proxy where others are to read them");
  }
  return {};
}

}  // namespace seeker::app
