/// \file
/// Text that is safe to hand to a drawing library.
#pragma once

#include <string>
#include <string_view>

namespace seeker::image {

/// The text without the bytes that are no UTF-8 (RFC 3629) and without NUL. Cairo refuses a text with such bytes, and
/// with it all that is drawn afterwards.
[[nodiscard]] std::string valid_utf8(std::string_view text);

}  // namespace seeker::image
