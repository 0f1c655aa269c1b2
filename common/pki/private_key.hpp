/// \file
/// Private keys: NIST P-256.
#pragma once

#include <filesystem>
#include <string>

#include "common/core/result.hpp"
#include "common/pki/openssl_ptr.hpp"

namespace seeker::pki {

/// A new key. kInternal: the machine has no random numbers.
[[nodiscard]] Result<KeyPtr> make_key();
/// The key as PEM without a passphrase.
[[nodiscard]] Result<std::string> pem_of(EVP_PKEY* key);
/// Reads a key of any kind that TLS 1.3 signs with. One with a passphrase is refused: nobody is there to type it.
/// kNotFound, kIo, kCorrupt.
[[nodiscard]] Result<KeyPtr> read_key(const std::filesystem::path& file);

}  // namespace seeker::pki
