/// \file
/// One certificate, and what is written in it.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"
#include "common/pki/role.hpp"

struct x509_st;  // OpenSSL's X509

namespace seeker::pki {

/// Certificates are dated by the calendar.
using CalendarTime = std::chrono::system_clock::time_point;
/// Time before the end of a certificate from which on people are warned.
inline constexpr std::chrono::hours kExpiryWarning{30 * 24};

/// What people and programs want to know of a certificate.
struct CertificateFacts {
  std::string name;          ///< common name (CN) of the subject
  std::optional<Role> role;  ///< nothing: a CA, or not one of `seeker pki`
  std::string serial;        ///< lower-case hexadecimal
  std::string issuer;        ///< common name of who has signed it
  CalendarTime not_before;
  CalendarTime not_after;
  std::vector<std::string> hosts;  ///< names and addresses at which its owner may be reached
  bool is_ca = false;
};

/// An immutable certificate; copies share it.
class Certificate {
 public:
  /// Takes over one reference of OpenSSL's object.
  explicit Certificate(x509_st* owned);

  /// Reads the first certificate of a PEM file. kNotFound, kIo, kCorrupt.
  [[nodiscard]] static Result<Certificate> read(const std::filesystem::path& file);
  [[nodiscard]] static Result<Certificate> parse(const std::string& pem);

  [[nodiscard]] const CertificateFacts& facts() const { return facts_; }
  [[nodiscard]] x509_st* get() const { return x509_.get(); }
  [[nodiscard]] Result<std::string> pem() const;

 private:
  std::shared_ptr<x509_st> x509_;
  CertificateFacts facts_;
};

/// Whether a text may be the name in a certificate: 1 to 32 of [A-Za-z0-9._-], the first a letter or digit.
[[nodiscard]] bool is_certificate_name(std::string_view name);

/// Whether people should be warned of the end of a certificate: it is near, or has passed.
[[nodiscard]] bool expires_soon(CalendarTime not_after, CalendarTime now);

/// A day and time in UTC as "2027-03-01 12:00 UTC".
[[nodiscard]] std::string date_text(CalendarTime time);
/// The same as ISO 8601 writes it, for programs: "2027-03-01T12:00:00Z".
[[nodiscard]] std::string iso_text(CalendarTime time);

}  // namespace seeker::pki
