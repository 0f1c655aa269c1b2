#include "common/net/tls_keeper.hpp"

#include <utility>

#include <sys/stat.h>

namespace seeker::net {

TlsKeeper::Stamp TlsKeeper::stamp_of(const std::filesystem::path& file) {
  struct stat found {};
  if (file.empty() || ::stat(file.c_str(), &found) != 0) {
    return {};
  }
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  return {std::int64_t{found.st_mtim.tv_sec} * kNanoseconds + found.st_mtim.tv_nsec, found.st_size, found.st_ino};
}

TlsKeeper::Stamps TlsKeeper::stamps_of(const pki::BundleFiles& files) {
  return {stamp_of(files.ca), stamp_of(files.certificate), stamp_of(files.key), stamp_of(files.revocations)};
}

Result<TlsKeeper> TlsKeeper::open(const pki::BundleFiles& files) {
  const Stamps stamps = stamps_of(files);  // before reading: what changes meanwhile is read again
  Result<std::shared_ptr<const TlsContext>> context = TlsContext::make(files, TlsSide::kServer);
  if (!context) {
    return tl::unexpected<Error>(context.error());
  }
  return TlsKeeper(files, std::move(*context), stamps);
}

bool TlsKeeper::refresh() {
  const Stamps stamps = stamps_of(files_);
  if (stamps == stamps_) {
    return false;
  }
  stamps_ = stamps;
  Result<std::shared_ptr<const TlsContext>> context = TlsContext::make(files_, TlsSide::kServer);
  if (!context) {
    problem_ = context.error();
    return false;
  }
  problem_.reset();
  context_ = std::move(*context);
  return true;
}

}  // namespace seeker::net
