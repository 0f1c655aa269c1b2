/// \file
/// Whom a program trusts: those with a certificate of its site's CA that is valid now and not revoked.
#pragma once

#include "common/core/result.hpp"
#include "common/pki/bundle.hpp"
#include "common/pki/certificate.hpp"
#include "common/pki/openssl_ptr.hpp"

namespace seeker::pki {

class Trust {
 public:
  /// Reads the CA's certificate and, where a file is named, its list of revocations, which must be the CA's own.
  /// kNotFound, kIo, kCorrupt.
  [[nodiscard]] static Result<Trust> read(const BundleFiles& files);

  /// Whether a certificate is to be believed at `now`; the error (kRefused) says why not.
  [[nodiscard]] Status check(const Certificate& certificate, CalendarTime now) const;
  /// For TLS, which checks by the same rules.
  [[nodiscard]] X509_STORE* store() const { return store_.get(); }

 private:
  explicit Trust(StorePtr store) : store_(std::move(store)) {}

  StorePtr store_;
};

/// Why OpenSSL does not believe a certificate, with the remedy; `code` is one of X509_V_ERR_*.
[[nodiscard]] std::string distrust_sentence(const std::string& whose, long code);

}  // namespace seeker::pki
