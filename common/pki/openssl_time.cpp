#include "common/pki/openssl_time.hpp"

#include <algorithm>
#include <cctype>
#include <ctime>

namespace seeker::pki {

CalendarTime calendar_time(const ASN1_TIME* time) {
  std::tm utc{};
  if (time == nullptr || ASN1_TIME_to_tm(time, &utc) != 1) {
    return CalendarTime();
  }
  return std::chrono::system_clock::from_time_t(timegm(&utc));
}

TimePtr asn1_time(CalendarTime time) {
  return TimePtr(ASN1_TIME_set(nullptr, std::chrono::system_clock::to_time_t(time)));
}

std::string serial_text(const ASN1_INTEGER* serial) {
  const NumberPtr number(ASN1_INTEGER_to_BN(serial, nullptr));
  char* hex = number ? BN_bn2hex(number.get()) : nullptr;
  std::string text = hex == nullptr ? "" : hex;
  OPENSSL_free(hex);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace seeker::pki
