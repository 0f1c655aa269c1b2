/// \file
/// A bundle of certificates as gRPC takes it.
#pragma once

#include <string>
#include <utility>

#include "common/pki/bundle.hpp"

namespace seeker::link_bench {

/// PEM texts.
struct PemBundle {
  std::string ca;
  std::string certificate;
  std::string key;
};

/// kNotFound, kIo, kTooLarge.
[[nodiscard]] inline Result<PemBundle> read_bundle(const pki::BundleFiles& files) {
  Result<std::string> ca = pki::read_pem(files.ca);
  Result<std::string> certificate = pki::read_pem(files.certificate);
  Result<std::string> key = pki::read_pem(files.key);
  for (const Result<std::string>* file : {&ca, &certificate, &key}) {
    if (!*file) {
      return tl::unexpected<Error>(file->error());
    }
  }
  return PemBundle{std::move(*ca), std::move(*certificate), std::move(*key)};
}

}  // namespace seeker::link_bench
