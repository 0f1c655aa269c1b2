#include "common/pki/private_key.hpp"

#include <openssl/ec.h>
#include <openssl/pem.h>

#include "common/pki/bundle.hpp"
#include "common/pki/openssl_error.hpp"

namespace seeker::pki {
namespace {

/// OpenSSL would ask for a passphrase at the terminal.
int no_passphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* /*user*/) { return -1; }

}  // namespace

Result<KeyPtr> make_key() {
  KeyPtr key(EVP_EC_gen("P-256"));
  if (!key) {
    return fail(Errc::kInternal, "no private key could be made: " + last_openssl_error());
  }
  return key;
}

Result<std::string> pem_of(EVP_PKEY* key) {
  const BioPtr out(BIO_new(BIO_s_mem()));
  if (!out || PEM_write_bio_PKCS8PrivateKey(out.get(), key, nullptr, nullptr, 0, nullptr, nullptr) != 1) {
    return fail(Errc::kInternal, "the private key cannot be written: " + last_openssl_error());
  }
  return text_of(out.get());
}

Result<KeyPtr> read_key(const std::filesystem::path& file) {
  const Result<std::string> text = read_pem(file);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  const BioPtr in = reader_of(*text);
  KeyPtr key(PEM_read_bio_PrivateKey(in.get(), nullptr, no_passphrase, nullptr));
  if (!key) {
    static_cast<void>(last_openssl_error());
    return fail(Errc::kCorrupt, file.string() +
                                    " holds no private key in PEM without a passphrase; make another "
                                    "bundle with 'seeker pki issue'");
  }
  return key;
}

}  // namespace seeker::pki
