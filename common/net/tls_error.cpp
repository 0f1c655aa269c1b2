#include "common/net/tls_error.hpp"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>
#include <boost/asio/error.hpp>
#include <boost/asio/ssl/error.hpp>

#include "common/pki/trust.hpp"

namespace seeker::net {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

/// OpenSSL's reason; 0: not an error of TLS.
int reason_of(const error_code& error) {
  return error.category() == asio::error::get_ssl_category() ? ERR_GET_REASON(static_cast<unsigned long>(error.value()))
                                                             : 0;
}

/// What the other side has said against our certificate; empty: nothing.
std::string refused_because(int reason) {
  switch (reason) {
    case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED: return "it asks for a certificate, and none was shown";
    case SSL_R_TLSV1_ALERT_UNKNOWN_CA: return "our certificate is of another site's CA";
    case SSL_R_SSLV3_ALERT_CERTIFICATE_REVOKED: return "our certificate was revoked";
    case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED: return "our certificate has expired, or the clocks differ";
    case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_UNSUPPORTED_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
    case SSL_R_TLSV1_ALERT_ACCESS_DENIED: return "our certificate is not valid there";
    default: return "";
  }
}

}  // namespace

bool is_end(const error_code& error) {
  return error == asio::error::eof || error == asio::ssl::error::stream_truncated;
}

Error broken_link(const error_code& error) {
  if (is_end(error)) {
    return {Errc::kLinkLost, "the other side closed the connection"};
  }
  if (const std::string why = refused_because(reason_of(error)); !why.empty()) {
    return {Errc::kRefused, "the other side refuses us: " + why +
                                "; have a bundle issued by its site ('seeker pki "
                                "issue') and name it with --tls"};
  }
  return {Errc::kLinkLost, "the connection broke: " + error.message()};
}

Error failed_handshake(const error_code& error, long verified, const std::string& whom) {
  if (verified != X509_V_OK) {
    return {Errc::kRefused, pki::distrust_sentence("the certificate of " + whom, verified)};
  }
  if (is_not_tls(error)) {
    return {Errc::kRefused, whom +
                                " does not speak TLS; leave the certificates out (--tls none), or give that program "
                                "some (server.tls)"};
  }
  if (is_end(error) || error == asio::error::connection_reset) {
    return {Errc::kLinkLost, whom +
                                 " ended the connection before TLS was agreed: it does not speak TLS (--tls none "
                                 "then), or has shut this address out for a minute"};
  }
  const Error broken = broken_link(error);
  return {broken.code, "no TLS with " + whom + ": " + broken.message};
}

bool is_not_tls(const error_code& error) {
  const int reason = reason_of(error);
  return reason == SSL_R_WRONG_VERSION_NUMBER || reason == SSL_R_HTTP_REQUEST || reason == SSL_R_UNEXPECTED_MESSAGE;
}

std::string failed_client(const error_code& error, long verified) {
  if (verified != X509_V_OK) {
    return pki::distrust_sentence("its certificate", verified);
  }
  return is_end(error) ? "it went away in the handshake" : error.message();
}

}  // namespace seeker::net
