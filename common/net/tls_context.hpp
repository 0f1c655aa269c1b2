/// \file
/// One side's certificates and rules, ready for handshakes.
#pragma once

#include <memory>
#include <string>

#include <openssl/ssl.h>

#include "common/core/result.hpp"
#include "common/pki/bundle.hpp"
#include "common/pki/certificate.hpp"
#include "common/pki/trust.hpp"

namespace seeker::net {

enum class TlsSide : std::uint8_t { kClient, kServer };

/// TLS 1.3 alone, with a certificate on both sides. There is neither renegotiation nor resumption nor early data: each
/// connection proves again who it is, and bytes that are sent again mean nothing.
class TlsContext {
 public:
  /// Reads the files. The error names the file and the remedy.
  [[nodiscard]] static Result<std::shared_ptr<const TlsContext>> make(const pki::BundleFiles& files, TlsSide side);
  TlsContext(const TlsContext&) = delete;
  TlsContext& operator=(const TlsContext&) = delete;
  ~TlsContext() { SSL_CTX_free(context_); }

  /// The state of one connection, which outlives this. Null: out of memory.
  [[nodiscard]] SSL* new_session() const { return SSL_new(context_); }
  [[nodiscard]] const pki::Certificate& own() const { return own_; }
  [[nodiscard]] const pki::Trust& trust() const { return trust_; }

 private:
  TlsContext(SSL_CTX* context, pki::Certificate own, pki::Trust trust)
      : context_(context), own_(std::move(own)), trust_(std::move(trust)) {}
  [[nodiscard]] Status set_rules(TlsSide side);
  [[nodiscard]] Status set_identity(const pki::BundleFiles& files);

  SSL_CTX* context_;
  pki::Certificate own_;
  pki::Trust trust_;
};

/// Has the handshake succeed only with a server whose certificate names `host`, a name or an IP address.
[[nodiscard]] bool expect_host(SSL* session, const std::string& host);

}  // namespace seeker::net
