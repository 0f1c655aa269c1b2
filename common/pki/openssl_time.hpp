/// \file
/// Times and serial numbers of OpenSSL as ours.
#pragma once

#include <string>

#include "common/pki/certificate.hpp"
#include "common/pki/openssl_ptr.hpp"

namespace seeker::pki {

/// A time that cannot be read is the beginning of 1970: long expired.
[[nodiscard]] CalendarTime calendar_time(const ASN1_TIME* time);
/// Never null, except where memory is out.
[[nodiscard]] TimePtr asn1_time(CalendarTime time);
/// Lower-case hexadecimal.
[[nodiscard]] std::string serial_text(const ASN1_INTEGER* serial);

}  // namespace seeker::pki
