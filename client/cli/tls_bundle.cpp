#include "client/cli/tls_bundle.hpp"

#include <filesystem>

#include "common/pki/site_authority.hpp"
#include "common/rpc/endpoint.hpp"

namespace seeker::cli {
namespace {

constexpr const char* kPlain = "none";

bool has_certificate(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / pki::kCertificateName, ignored);
}

}  // namespace

Result<std::optional<pki::BundleFiles>> bundle_for(const std::string& tls, const std::string& host) {
  if (tls == kPlain) {
    return std::nullopt;
  }
  if (tls.empty()) {
    const std::filesystem::path own = pki::default_bundle_folder();
    return !rpc::is_this_machine(host) && has_certificate(own) ? std::optional(pki::bundle_in(own)) : std::nullopt;
  }
  if (!has_certificate(tls)) {
    return fail(Errc::kInvalidArgument, "--tls: the folder " + tls + " holds no " + pki::kCertificateName +
                                            "; 'seeker pki issue' makes such a folder");
  }
  return pki::bundle_in(tls);
}

}  // namespace seeker::cli
