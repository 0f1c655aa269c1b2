#include "common/pki/trust.hpp"

#include "common/pki/openssl_error.hpp"
#include "common/pki/revocation_list.hpp"

namespace seeker::pki {
namespace {

Status add_revocations(const BundleFiles& files, const Certificate& ca, X509_STORE* store) {
  const Result<RevocationList> list = RevocationList::read(files.revocations);
  if (!list) {
    return tl::unexpected<Error>(list.error());
  }
  if (X509_CRL_verify(list->get(), X509_get0_pubkey(ca.get())) != 1) {
    static_cast<void>(last_openssl_error());
    return fail(Errc::kCorrupt, files.revocations.string() + " is not signed by the CA of " + files.ca.string() +
                                    "; copy both from one site");
  }
  X509_STORE_set_flags(store, X509_V_FLAG_CRL_CHECK);
  return X509_STORE_add_crl(store, list->get()) == 1
             ? Status()
             : fail(Errc::kInternal, "the revocations cannot be used: " + last_openssl_error());
}

}  // namespace

Result<Trust> Trust::read(const BundleFiles& files) {
  const Result<Certificate> ca = Certificate::read(files.ca);
  if (!ca) {
    return tl::unexpected<Error>(ca.error());
  }
  if (!ca->facts().is_ca) {
    return fail(Errc::kCorrupt, files.ca.string() + " is not the certificate of a CA; copy " + kCaName +
                                    " of a site made by 'seeker pki init'");
  }
  StorePtr store(X509_STORE_new());
  if (!store || X509_STORE_add_cert(store.get(), ca->get()) != 1) {
    return fail(Errc::kInternal, "the CA cannot be used: " + last_openssl_error());
  }
  if (!files.revocations.empty()) {
    if (const Status added = add_revocations(files, *ca, store.get()); !added) {
      return tl::unexpected<Error>(added.error());
    }
  }
  return Trust(std::move(store));
}

Status Trust::check(const Certificate& certificate, CalendarTime now) const {
  const StoreContextPtr context(X509_STORE_CTX_new());
  if (!context || X509_STORE_CTX_init(context.get(), store_.get(), certificate.get(), nullptr) != 1) {
    return fail(Errc::kInternal, "a certificate cannot be checked: " + last_openssl_error());
  }
  X509_STORE_CTX_set_time(context.get(), 0, std::chrono::system_clock::to_time_t(now));
  const bool good = X509_verify_cert(context.get()) == 1;
  static_cast<void>(last_openssl_error());
  return good ? Status()
              : fail(Errc::kRefused, distrust_sentence("the certificate of '" + certificate.facts().name + "'",
                                                       X509_STORE_CTX_get_error(context.get())));
}

std::string distrust_sentence(const std::string& whose, long code) {
  switch (code) {
    case X509_V_ERR_CERT_REVOKED: return whose + " was revoked; have another one issued";
    case X509_V_ERR_CERT_HAS_EXPIRED: return whose + " has expired; have another one issued ('seeker pki issue')";
    case X509_V_ERR_CERT_NOT_YET_VALID:
    case X509_V_ERR_CRL_NOT_YET_VALID: return whose + " is not valid yet; check the clocks of both machines";
    case X509_V_ERR_HOSTNAME_MISMATCH:
    case X509_V_ERR_IP_ADDRESS_MISMATCH:
      return whose +
             " does not name this address; connect by a name that it lists ('seeker pki show'), or issue it "
             "again with --host";
    case X509_V_ERR_CRL_HAS_EXPIRED:
      return "the list of revocations has expired; make another one with 'seeker pki revoke'";
    case X509_V_ERR_INVALID_PURPOSE: return whose + " is not one of a robot, or not one of a client";
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
    case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
    case X509_V_ERR_CERT_SIGNATURE_FAILURE:
    case X509_V_ERR_CERT_UNTRUSTED: return whose + " is of another site's CA; use certificates of one site";
    default: return whose + " is not valid (" + X509_verify_cert_error_string(code) + ")";
  }
}

}  // namespace seeker::pki
