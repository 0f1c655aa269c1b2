#include "common/pki/certificate.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>

#include <arpa/inet.h>
#include <openssl/pem.h>

#include "common/pki/bundle.hpp"
#include "common/pki/openssl_error.hpp"
#include "common/pki/openssl_ptr.hpp"
#include "common/pki/openssl_time.hpp"

namespace seeker::pki {
namespace {

/// A certificate that lists more is of nobody we know; the rest is not shown.
constexpr int kMaxHosts = 64;
constexpr int kV4Bytes = 4;
constexpr int kV6Bytes = 16;

/// The one entry of that kind; empty where there is none or several, which would let two readers see two owners.
std::string entry_of(const X509_NAME* name, int nid) {
  const int at = X509_NAME_get_index_by_NID(name, nid, -1);
  if (at < 0 || X509_NAME_get_index_by_NID(name, nid, at) >= 0) {
    return "";
  }
  const ASN1_STRING* data = X509_NAME_ENTRY_get_data(X509_NAME_get_entry(name, at));
  unsigned char* utf8 = nullptr;
  const int size = ASN1_STRING_to_UTF8(&utf8, data);
  std::string text = size > 0 ? std::string(reinterpret_cast<const char*>(utf8), static_cast<std::size_t>(size)) : "";
  OPENSSL_free(utf8);
  // Nothing that a terminal or a log would obey.
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return text;
}

std::string address_text(const ASN1_OCTET_STRING* octets) {
  const int size = ASN1_STRING_length(octets);
  const int family = size == kV4Bytes ? AF_INET : size == kV6Bytes ? AF_INET6 : AF_UNSPEC;
  std::array<char, INET6_ADDRSTRLEN> text{};
  return ::inet_ntop(family, ASN1_STRING_get0_data(octets), text.data(), text.size()) == nullptr ? "" : text.data();
}

std::vector<std::string> hosts_of(const X509* certificate) {
  std::vector<std::string> hosts;
  const NamesPtr names(
      static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)));
  const int count = names ? std::min(sk_GENERAL_NAME_num(names.get()), kMaxHosts) : 0;
  for (int k = 0; k < count; ++k) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(names.get(), k);
    if (name->type == GEN_DNS) {
      hosts.emplace_back(reinterpret_cast<const char*>(ASN1_STRING_get0_data(name->d.dNSName)),
                         static_cast<std::size_t>(ASN1_STRING_length(name->d.dNSName)));
    } else if (name->type == GEN_IPADD) {
      hosts.push_back(address_text(name->d.iPAddress));
    }
  }
  return hosts;
}

CertificateFacts facts_of(X509* certificate) {
  CertificateFacts facts;
  const X509_NAME* subject = X509_get_subject_name(certificate);
  facts.name = entry_of(subject, NID_commonName);
  facts.role = parse_role(entry_of(subject, NID_organizationalUnitName));
  facts.issuer = entry_of(X509_get_issuer_name(certificate), NID_commonName);
  facts.serial = serial_text(X509_get0_serialNumber(certificate));
  facts.not_before = calendar_time(X509_get0_notBefore(certificate));
  facts.not_after = calendar_time(X509_get0_notAfter(certificate));
  facts.hosts = hosts_of(certificate);
  facts.is_ca = X509_check_ca(certificate) == 1;
  static_cast<void>(last_openssl_error());  // of what was absent
  return facts;
}

std::string formatted(CalendarTime time, const char* format) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm utc{};
  std::array<char, 32> text{};
  const bool good = gmtime_r(&seconds, &utc) != nullptr && std::strftime(text.data(), text.size(), format, &utc) > 0;
  return good ? text.data() : "an unknown day";
}

}  // namespace

Certificate::Certificate(x509_st* owned) : x509_(owned, &X509_free), facts_(facts_of(owned)) {}

Result<Certificate> Certificate::parse(const std::string& pem) {
  const BioPtr in = reader_of(pem);
  X509* certificate = PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr);
  if (certificate == nullptr) {
    static_cast<void>(last_openssl_error());
    return fail(Errc::kCorrupt, "this is no certificate in PEM");
  }
  return Certificate(certificate);
}

Result<Certificate> Certificate::read(const std::filesystem::path& file) {
  const Result<std::string> text = read_pem(file);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  Result<Certificate> certificate = parse(*text);
  return certificate ? certificate : Result<Certificate>(fail_with_context(file.string(), certificate.error()));
}

Result<std::string> Certificate::pem() const {
  const BioPtr out(BIO_new(BIO_s_mem()));
  if (!out || PEM_write_bio_X509(out.get(), x509_.get()) != 1) {
    return fail(Errc::kInternal, "the certificate cannot be written: " + last_openssl_error());
  }
  return text_of(out.get());
}

bool is_certificate_name(std::string_view name) {
  constexpr std::size_t kMaxName = 32;
  const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0; };
  const auto allowed = [&](unsigned char c) { return is_word(c) || c == '.' || c == '_' || c == '-'; };
  return !name.empty() && name.size() <= kMaxName && is_word(static_cast<unsigned char>(name.front())) &&
         std::all_of(name.begin(), name.end(), allowed);
}

bool expires_soon(CalendarTime not_after, CalendarTime now) { return not_after - now <= kExpiryWarning; }

std::string date_text(CalendarTime time) { return formatted(time, "%Y-%m-%d %H:%M UTC"); }
std::string iso_text(CalendarTime time) { return formatted(time, "%Y-%m-%dT%H:%M:%SZ"); }

}  // namespace seeker::pki
