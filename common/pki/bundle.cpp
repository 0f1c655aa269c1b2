#include "common/pki/bundle.hpp"

#include <cstdint>
#include <vector>

#include "common/files/files.hpp"

namespace seeker::pki {
namespace {

/// A list with tens of thousands of revocations is below this.
constexpr std::size_t kMaxPemBytes = std::size_t{4} << 20U;

}  // namespace

BundleFiles bundle_in(const std::filesystem::path& folder) {
  BundleFiles files{folder / kCaName, folder / kCertificateName, folder / kKeyName, folder / kRevocationsName};
  std::error_code ignored;
  if (!std::filesystem::exists(files.revocations, ignored)) {
    files.revocations.clear();
  }
  return files;
}

Result<std::string> read_pem(const std::filesystem::path& file) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(file, kMaxPemBytes);
  if (!bytes) {
    return tl::unexpected<Error>(bytes.error());
  }
  return std::string(bytes->begin(), bytes->end());
}

}  // namespace seeker::pki
