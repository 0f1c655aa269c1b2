/// \file
/// The files with which a program shows who it is and knows whom to trust.
#pragma once

#include <filesystem>

#include "common/core/result.hpp"

namespace seeker::pki {

// Names in the folder of a bundle, and of a site.
inline constexpr const char* kCaName = "ca.pem";
inline constexpr const char* kCertificateName = "cert.pem";
inline constexpr const char* kKeyName = "key.pem";
inline constexpr const char* kRevocationsName = "crl.pem";

/// Paths of PEM files.
struct BundleFiles {
  std::filesystem::path ca;           ///< certificate of the site's CA
  std::filesystem::path certificate;  ///< of this program
  std::filesystem::path key;          ///< its private key, without a passphrase
  std::filesystem::path revocations;  ///< the CA's list of revoked certificates; empty: none is checked

  friend bool operator==(const BundleFiles&, const BundleFiles&) = default;
};

/// The files of a folder that `seeker pki issue` has made; the list of revocations where it is there.
[[nodiscard]] BundleFiles bundle_in(const std::filesystem::path& folder);

/// A PEM file as text. kNotFound, kIo, kTooLarge.
[[nodiscard]] Result<std::string> read_pem(const std::filesystem::path& file);

}  // namespace seeker::pki
