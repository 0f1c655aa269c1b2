#include "common/pki/certificate_maker.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include <openssl/pem.h>
#include <openssl/rand.h>

#include "common/pki/openssl_error.hpp"
#include "common/pki/openssl_time.hpp"

namespace seeker::pki {
namespace {

constexpr int kSerialBytes = 16;
constexpr long kVersion3 = 2;          // as encoded
constexpr long kRevocationsV2 = 1;     // as encoded
constexpr std::size_t kMaxHost = 253;  // of a DNS name

tl::unexpected<Error> cannot(const std::string& what) {
  return fail(Errc::kInternal, "cannot make " + what + ": " + last_openssl_error());
}

/// Random, so that two CAs of one name, or one that was restored from a backup, give no number twice.
bool set_random_serial(X509* certificate) {
  std::array<unsigned char, kSerialBytes> bytes{};
  constexpr unsigned char kPositive = 0x7F;
  constexpr unsigned char kNotZero = 0x40;
  if (RAND_bytes(bytes.data(), kSerialBytes) != 1) {
    return false;
  }
  bytes[0] = static_cast<unsigned char>((bytes[0] & kPositive) | kNotZero);
  const NumberPtr number(BN_bin2bn(bytes.data(), kSerialBytes, nullptr));
  return number && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr;
}

bool add_entry(X509_NAME* name, const char* field, const std::string& text) {
  return X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8, reinterpret_cast<const unsigned char*>(text.data()),
                                    static_cast<int>(text.size()), -1, 0) == 1;
}

bool add_extension(X509* certificate, X509* issuer, int nid, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const ExtensionPtr extension(X509V3_EXT_conf_nid(nullptr, &context, nid, value.c_str()));
  return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

bool set_frame(X509* certificate, CalendarTime not_before, CalendarTime not_after, EVP_PKEY* key) {
  const TimePtr from = asn1_time(not_before);
  const TimePtr to = asn1_time(not_after);
  return X509_set_version(certificate, kVersion3) == 1 && set_random_serial(certificate) && from && to &&
         X509_set1_notBefore(certificate, from.get()) == 1 && X509_set1_notAfter(certificate, to.get()) == 1 &&
         X509_set_pubkey(certificate, key) == 1;
}

bool is_dns_name(const std::string& host) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '.' || c == '_'; };
  return !host.empty() && host.size() <= kMaxHost && std::isalnum(static_cast<unsigned char>(host.front())) != 0 &&
         std::all_of(host.begin(), host.end(), allowed);
}

/// As OpenSSL's configuration writes them: "DNS:r1,IP:10.0.0.5".
Result<std::string> alternative_names(const std::vector<std::string>& hosts) {
  std::string text;
  for (const std::string& host : hosts) {
    ASN1_OCTET_STRING* address = a2i_IPADDRESS(host.c_str());
    static_cast<void>(last_openssl_error());
    const bool is_address = address != nullptr;
    ASN1_OCTET_STRING_free(address);
    if (!is_address && !is_dns_name(host)) {
      return fail(Errc::kInvalidArgument, "'" + host + "' is neither a host name nor an IP address");
    }
    text += (text.empty() ? "" : ",") + std::string(is_address ? "IP:" : "DNS:") + host;
  }
  return text;
}

bool add_use(X509* certificate, X509* issuer, Role role, const std::string& names) {
  const char* purposes = role == Role::kRobot ? "serverAuth,clientAuth" : "clientAuth";
  return add_extension(certificate, issuer, NID_basic_constraints, "critical,CA:FALSE") &&
         add_extension(certificate, issuer, NID_key_usage, "critical,digitalSignature") &&
         add_extension(certificate, issuer, NID_ext_key_usage, purposes) &&
         add_extension(certificate, issuer, NID_subject_key_identifier, "hash") &&
         add_extension(certificate, issuer, NID_authority_key_identifier, "keyid:always") &&
         (names.empty() || add_extension(certificate, issuer, NID_subject_alt_name, names));
}

/// Copies what was revoked before.
bool copy_revoked(const X509_CRL* former, X509_CRL* list) {
  STACK_OF(X509_REVOKED)* revoked = former == nullptr ? nullptr : X509_CRL_get_REVOKED(const_cast<X509_CRL*>(former));
  for (int k = 0; k < sk_X509_REVOKED_num(revoked); ++k) {
    RevokedPtr entry(X509_REVOKED_dup(sk_X509_REVOKED_value(revoked, k)));
    if (!entry || X509_CRL_add0_revoked(list, entry.get()) != 1) {
      return false;
    }
    static_cast<void>(entry.release());  // the list owns it now
  }
  return true;
}

bool add_revoked(X509_CRL* list, const std::string& serial, const ASN1_TIME* at) {
  BIGNUM* parsed = nullptr;
  const bool is_number = BN_hex2bn(&parsed, serial.c_str()) == static_cast<int>(serial.size());
  const NumberPtr number(parsed);
  const IntegerPtr integer(is_number ? BN_to_ASN1_INTEGER(number.get(), nullptr) : nullptr);
  RevokedPtr entry(X509_REVOKED_new());
  if (!integer || !entry || X509_REVOKED_set_serialNumber(entry.get(), integer.get()) != 1 ||
      X509_REVOKED_set_revocationDate(entry.get(), const_cast<ASN1_TIME*>(at)) != 1 ||
      X509_CRL_add0_revoked(list, entry.get()) != 1) {
    return false;
  }
  static_cast<void>(entry.release());
  return true;
}

bool number_list(const X509_CRL* former, X509_CRL* list) {
  long before = 0;
  if (former != nullptr) {
    const IntegerPtr number(static_cast<ASN1_INTEGER*>(X509_CRL_get_ext_d2i(former, NID_crl_number, nullptr, nullptr)));
    before = number ? ASN1_INTEGER_get(number.get()) : 0;
  }
  const IntegerPtr next(ASN1_INTEGER_new());
  return next && ASN1_INTEGER_set(next.get(), before + 1) == 1 &&
         X509_CRL_add1_ext_i2d(list, NID_crl_number, next.get(), 0, 0) == 1;
}

}  // namespace

Result<Certificate> make_certificate(const CertificateWish& wish, EVP_PKEY* key, const Signer& signer) {
  const Result<std::string> names = alternative_names(wish.hosts);
  if (!names) {
    return tl::unexpected<Error>(names.error());
  }
  CertificatePtr made(X509_new());
  X509_NAME* subject = made ? X509_get_subject_name(made.get()) : nullptr;
  const bool good =
      subject != nullptr && set_frame(made.get(), wish.not_before, wish.not_after, key) &&
      add_entry(subject, "OU", std::string(to_string(wish.role))) && add_entry(subject, "CN", wish.name) &&
      X509_set_issuer_name(made.get(), X509_get_subject_name(signer.ca.get())) == 1 &&
      add_use(made.get(), signer.ca.get(), wish.role, *names) && X509_sign(made.get(), signer.key, EVP_sha256()) > 0;
  return good ? Result<Certificate>(Certificate(made.release())) : Result<Certificate>(cannot("a certificate"));
}

Result<Certificate> make_ca(const std::string& name, CalendarTime not_before, CalendarTime not_after, EVP_PKEY* key) {
  CertificatePtr made(X509_new());
  X509_NAME* subject = made ? X509_get_subject_name(made.get()) : nullptr;
  const bool good = subject != nullptr && set_frame(made.get(), not_before, not_after, key) &&
                    add_entry(subject, "CN", name) && X509_set_issuer_name(made.get(), subject) == 1 &&
                    add_extension(made.get(), made.get(), NID_basic_constraints, "critical,CA:TRUE,pathlen:0") &&
                    add_extension(made.get(), made.get(), NID_key_usage, "critical,keyCertSign,cRLSign") &&
                    add_extension(made.get(), made.get(), NID_subject_key_identifier, "hash") &&
                    X509_sign(made.get(), key, EVP_sha256()) > 0;
  return good ? Result<Certificate>(Certificate(made.release())) : Result<Certificate>(cannot("a CA"));
}

Result<std::string> make_revocations(const X509_CRL* former, const std::string& serial, CalendarTime now,
                                     const Signer& signer) {
  const RevocationListPtr list(X509_CRL_new());
  const TimePtr at = asn1_time(now);
  const bool good = list && at && X509_CRL_set_version(list.get(), kRevocationsV2) == 1 &&
                    X509_CRL_set_issuer_name(list.get(), X509_get_subject_name(signer.ca.get())) == 1 &&
                    X509_CRL_set1_lastUpdate(list.get(), at.get()) == 1 &&
                    X509_CRL_set1_nextUpdate(list.get(), X509_get0_notAfter(signer.ca.get())) == 1 &&
                    copy_revoked(former, list.get()) && (serial.empty() || add_revoked(list.get(), serial, at.get())) &&
                    number_list(former, list.get()) && X509_CRL_sort(list.get()) == 1 &&
                    X509_CRL_sign(list.get(), signer.key, EVP_sha256()) > 0;
  const BioPtr out(good ? BIO_new(BIO_s_mem()) : nullptr);
  if (!out || PEM_write_bio_X509_CRL(out.get(), list.get()) != 1) {
    return cannot("the list of revocations");
  }
  return text_of(out.get());
}

}  // namespace seeker::pki
