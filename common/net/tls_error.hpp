/// \file
/// What went wrong with a connection, as a sentence.
#pragma once

#include <string>

#include <boost/system/error_code.hpp>

#include "common/core/result.hpp"

namespace seeker::net {

/// Whether the other side has ended the connection, in order or by dropping it under TLS.
[[nodiscard]] bool is_end(const boost::system::error_code& error);

/// Why a connection broke: kLinkLost, or kRefused where the other side does not believe our certificate. The sentence
/// names the remedy.
[[nodiscard]] Error broken_link(const boost::system::error_code& error);

/// Why a handshake of ours as a client with `whom` failed. `verified` is OpenSSL's result (X509_V_*) for the
/// certificate of the other side.
[[nodiscard]] Error failed_handshake(const boost::system::error_code& error, long verified, const std::string& whom);

/// Whether a handshake failed since the other side's bytes are not those of TLS.
[[nodiscard]] bool is_not_tls(const boost::system::error_code& error);

/// Why a client's handshake failed, for the log.
[[nodiscard]] std::string failed_client(const boost::system::error_code& error, long verified);

}  // namespace seeker::net
