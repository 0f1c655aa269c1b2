/// \file
/// The files with which this program shows who it is, as they are on the disk.
#pragma once

#include <optional>

#include "common/core/result.hpp"
#include "common/pki/bundle.hpp"
#include "common/pki/certificate.hpp"

namespace seeker::doctor {

struct OwnFiles {
  /// Whether all are there, can be read, and belong together; the error names the file and the remedy.
  Status usable;
  std::optional<pki::CertificateFacts> certificate;  ///< where the files are usable
  /// Whether the site's CA has made the certificate, and it is valid at the time of the look and not revoked.
  Status believed;
};

/// Reads them.
[[nodiscard]] OwnFiles look_at(const pki::BundleFiles& files, pki::CalendarTime now);

}  // namespace seeker::doctor
