/// \file
/// Why a call of OpenSSL failed.
#pragma once

#include <string>

namespace seeker::pki {

/// The newest reason in this thread's queue of OpenSSL, which is empty afterwards; "no reason was given" where there is
/// none.
[[nodiscard]] std::string last_openssl_error();

}  // namespace seeker::pki
