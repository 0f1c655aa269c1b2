/// \file
/// Which certificates a call to a robot is made with.
#pragma once

#include <optional>
#include <string>

#include "common/core/result.hpp"
#include "common/pki/bundle.hpp"

namespace seeker::cli {

/// The files of --tls; nothing ("none"): plain TCP. An empty `tls` means the person's own bundle, ~/.config/seeker/tls,
/// where it is there and the robot is on another machine. kInvalidArgument: the folder holds no certificate.
[[nodiscard]] Result<std::optional<pki::BundleFiles>> bundle_for(const std::string& tls, const std::string& host);

}  // namespace seeker::cli
