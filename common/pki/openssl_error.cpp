#include "common/pki/openssl_error.hpp"

#include <openssl/err.h>

namespace seeker::pki {

std::string last_openssl_error() {
  const unsigned long error = ERR_peek_last_error();
  const char* reason = error == 0 ? nullptr : ERR_reason_error_string(error);
  std::string text = reason == nullptr ? "no reason was given" : reason;
  ERR_clear_error();
  return text;
}

}  // namespace seeker::pki
