#include "common/pki/revocation_list.hpp"

#include <algorithm>

#include <openssl/pem.h>

#include "common/pki/bundle.hpp"
#include "common/pki/openssl_error.hpp"
#include "common/pki/openssl_time.hpp"

namespace seeker::pki {

Result<RevocationList> RevocationList::read(const std::filesystem::path& file) {
  const Result<std::string> text = read_pem(file);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  const BioPtr in = reader_of(*text);
  RevocationListPtr list(PEM_read_bio_X509_CRL(in.get(), nullptr, nullptr, nullptr));
  if (!list) {
    static_cast<void>(last_openssl_error());
    return fail(Errc::kCorrupt, file.string() + " is no list of revoked certificates in PEM; copy " + kRevocationsName +
                                    " of the site's CA");
  }
  return RevocationList(std::move(list));
}

bool RevocationList::has(std::string_view serial) const {
  const STACK_OF(X509_REVOKED)* revoked = X509_CRL_get_REVOKED(list_.get());
  for (int k = 0; k < sk_X509_REVOKED_num(revoked); ++k) {
    if (serial_text(X509_REVOKED_get0_serialNumber(sk_X509_REVOKED_value(revoked, k))) == serial) {
      return true;
    }
  }
  return false;
}

int RevocationList::size() const { return std::max(0, sk_X509_REVOKED_num(X509_CRL_get_REVOKED(list_.get()))); }

}  // namespace seeker::pki
