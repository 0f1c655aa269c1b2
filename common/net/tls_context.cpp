#include "common/net/tls_context.hpp"

#include "common/pki/openssl_error.hpp"
#include "common/pki/private_key.hpp"

namespace seeker::net {
namespace {

/// Of what a peer may send as its certificates.
constexpr long kMaxCertificateBytes = 16384;
/// CA and certificate: nothing lies between them.
constexpr int kChainDepth = 1;

tl::unexpected<Error> not_usable(const std::string& what) {
  return fail(Errc::kCorrupt, what + " cannot be used for TLS: " + pki::last_openssl_error());
}

}  // namespace

Result<std::shared_ptr<const TlsContext>> TlsContext::make(const pki::BundleFiles& files, TlsSide side) {
  Result<pki::Trust> trust = pki::Trust::read(files);
  if (!trust) {
    return tl::unexpected<Error>(trust.error());
  }
  Result<pki::Certificate> own = pki::Certificate::read(files.certificate);
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  SSL_CTX* native = SSL_CTX_new(side == TlsSide::kServer ? TLS_server_method() : TLS_client_method());
  if (native == nullptr) {
    return not_usable("this machine");
  }
  const std::shared_ptr<TlsContext> context(new TlsContext(native, std::move(*own), std::move(*trust)));
  if (const Status rules = context->set_rules(side); !rules) {
    return tl::unexpected<Error>(rules.error());
  }
  if (const Status identity = context->set_identity(files); !identity) {
    return tl::unexpected<Error>(identity.error());
  }
  return context;
}

Status TlsContext::set_rules(TlsSide side) {
  const bool only_1_3 = SSL_CTX_set_min_proto_version(context_, TLS1_3_VERSION) == 1 &&
                        SSL_CTX_set_max_proto_version(context_, TLS1_3_VERSION) == 1;
  const bool no_resumption = SSL_CTX_set_num_tickets(context_, 0) == 1 &&
                             SSL_CTX_set_max_early_data(context_, 0) == 1 &&
                             SSL_CTX_set_recv_max_early_data(context_, 0) == 1;
  if (!only_1_3 || !no_resumption) {
    return not_usable("this machine's OpenSSL");
  }
  SSL_CTX_set1_cert_store(context_, trust_.store());
  SSL_CTX_set_session_cache_mode(context_, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(context_, SSL_OP_NO_TICKET | SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  // Idle connections keep no buffers, and a write may go on with other memory than it began with.
  SSL_CTX_set_mode(context_,
                   SSL_MODE_RELEASE_BUFFERS | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER | SSL_MODE_ENABLE_PARTIAL_WRITE);
  SSL_CTX_set_max_cert_list(context_, kMaxCertificateBytes);
  SSL_CTX_set_verify_depth(context_, kChainDepth);
  const int both = SSL_VERIFY_PEER | (side == TlsSide::kServer ? SSL_VERIFY_FAIL_IF_NO_PEER_CERT : 0);
  SSL_CTX_set_verify(context_, both, nullptr);
  return {};
}

Status TlsContext::set_identity(const pki::BundleFiles& files) {
  const Result<pki::KeyPtr> key = pki::read_key(files.key);
  if (!key) {
    return tl::unexpected<Error>(key.error());
  }
  if (X509_check_private_key(own_.get(), key->get()) != 1) {
    static_cast<void>(pki::last_openssl_error());
    return fail(Errc::kCorrupt, files.key.string() + " is not the key of " + files.certificate.string() +
                                    "; take both from one bundle");
  }
  if (SSL_CTX_use_certificate(context_, own_.get()) != 1 || SSL_CTX_use_PrivateKey(context_, key->get()) != 1) {
    return not_usable(files.certificate.string());
  }
  return {};
}

bool expect_host(SSL* session, const std::string& host) {
  X509_VERIFY_PARAM* rules = SSL_get0_param(session);
  X509_VERIFY_PARAM_set_hostflags(rules, X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS | X509_CHECK_FLAG_NEVER_CHECK_SUBJECT);
  if (X509_VERIFY_PARAM_set1_ip_asc(rules, host.c_str()) == 1) {
    return true;
  }
  static_cast<void>(pki::last_openssl_error());
  return X509_VERIFY_PARAM_set1_host(rules, host.data(), host.size()) == 1 &&
         SSL_set_tlsext_host_name(session, host.c_str()) == 1;
}

}  // namespace seeker::net
