/// \file
/// Signing certificates and lists of revocations.
#pragma once

#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "common/pki/certificate.hpp"
#include "common/pki/openssl_ptr.hpp"

namespace seeker::pki {

/// Who signs.
struct Signer {
  const Certificate& ca;
  EVP_PKEY* key;
};

/// What a certificate says.
struct CertificateWish {
  std::string name;
  Role role = Role::kObserver;
  std::vector<std::string> hosts;  ///< DNS names and IP addresses
  CalendarTime not_before;
  CalendarTime not_after;
};

/// A certificate for `key`, signed by the CA: for a robot as a server and a client of TLS, for anybody else as a client
/// alone. kInvalidArgument: a host is neither a name nor an address.
[[nodiscard]] Result<Certificate> make_certificate(const CertificateWish& wish, EVP_PKEY* key, const Signer& signer);

/// A CA's own certificate; it may sign certificates of programs, not other CAs.
[[nodiscard]] Result<Certificate> make_ca(const std::string& name, CalendarTime not_before, CalendarTime not_after,
                                          EVP_PKEY* key);

/// The revocations of `former` (null: none) and one more serial (hexadecimal; empty: none), as PEM. It is valid as long
/// as the CA, since nobody brings a fresh one to robots by the clock.
[[nodiscard]] Result<std::string> make_revocations(const X509_CRL* former, const std::string& serial, CalendarTime now,
                                                   const Signer& signer);

}  // namespace seeker::pki
