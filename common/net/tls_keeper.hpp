/// \file
/// Certificates of a server that are read again when their files change.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "common/core/result.hpp"
#include "common/net/tls_context.hpp"

namespace seeker::net {

/// Files that cannot be used leave the former certificates in use, until they change again.
class TlsKeeper {
 public:
  /// Reads the files of a server. The error names the file and the remedy.
  [[nodiscard]] static Result<TlsKeeper> open(const pki::BundleFiles& files);

  /// Looks at the files, and reads them where one has changed. True: others are in use now.
  bool refresh();
  [[nodiscard]] const TlsContext& context() const { return *context_; }
  /// Why the newest files are not in use.
  [[nodiscard]] const std::optional<Error>& problem() const { return problem_; }

 private:
  /// What changes when a file is written or replaced; -1 where there is none.
  struct Stamp {
    std::int64_t written_ns = -1;
    std::int64_t size = -1;
    std::uint64_t inode = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  using Stamps = std::array<Stamp, 4>;

  TlsKeeper(pki::BundleFiles files, std::shared_ptr<const TlsContext> context, Stamps stamps)
      : files_(std::move(files)), context_(std::move(context)), stamps_(stamps) {}
  [[nodiscard]] static Stamp stamp_of(const std::filesystem::path& file);
  [[nodiscard]] static Stamps stamps_of(const pki::BundleFiles& files);

  pki::BundleFiles files_;
  std::shared_ptr<const TlsContext> context_;
  Stamps stamps_;
  std::optional<Error> problem_;
};

}  // namespace seeker::net
