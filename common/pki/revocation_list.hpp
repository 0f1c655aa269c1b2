/// \file
/// The list of certificates that a CA has revoked (CRL).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/core/result.hpp"
#include "common/pki/certificate.hpp"
#include "common/pki/openssl_ptr.hpp"

namespace seeker::pki {

class RevocationList {
 public:
  /// Reads a PEM file. kNotFound, kIo, kCorrupt.
  [[nodiscard]] static Result<RevocationList> read(const std::filesystem::path& file);

  /// Whether a certificate with this serial (lower-case hexadecimal) is on it.
  [[nodiscard]] bool has(std::string_view serial) const;
  /// Number of certificates on it.
  [[nodiscard]] int size() const;
  [[nodiscard]] X509_CRL* get() const { return list_.get(); }

 private:
  explicit RevocationList(RevocationListPtr list) : list_(std::move(list)) {}

  RevocationListPtr list_;
};

}  // namespace seeker::pki
