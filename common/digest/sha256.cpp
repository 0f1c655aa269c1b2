#include "common/digest/sha256.hpp"

#include <openssl/evp.h>
#include <openssl/sha.h>

#include "common/core/assert.hpp"
#include "common/files/file_pieces.hpp"

namespace seeker::digest {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";

}  // namespace

static_assert(SHA256_DIGEST_LENGTH == std::tuple_size_v<Sha256Sum>);

struct Sha256::State {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  const bool begun = state_->context && EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr) == 1;
  SEEKER_ASSERT(begun);
}

Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::uint8_t> bytes) {
  const bool added = EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size()) == 1;
  SEEKER_ASSERT(added);
}

Sha256Sum Sha256::finish() {
  Sha256Sum sum{};
  const bool finished = EVP_DigestFinal_ex(state_->context.get(), sum.data(), nullptr) == 1;
  SEEKER_ASSERT(finished);
  return sum;
}

Sha256Sum sha256_of(std::span<const std::uint8_t> bytes) {
  Sha256 sum;
  sum.add(bytes);
  return sum.finish();
}

Result<Sha256Sum> sha256_of_file(const std::filesystem::path& path) {
  constexpr std::size_t kPiece_bytes = std::size_t{256} << 10U;
  const Result<files::FileReader> file = files::FileReader::open(path);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  Sha256 sum;
  for (std::uint64_t offset = 0;;) {
    const Result<std::vector<std::uint8_t>> piece = file->read(offset, kPiece_bytes);
    if (!piece) {
      return tl::unexpected<Error>(piece.error());
    }
    if (piece->empty()) {
      return sum.finish();
    }
    sum.add(*piece);
    offset += piece->size();
  }
}

std::string to_hex(std::span<const std::uint8_t> bytes) {
  constexpr unsigned kLowNibble = 0xF;
  std::string text;
  text.reserve(2 * bytes.size());
  for (const std::uint8_t byte : bytes) {
    text += kHexDigits[byte >> 4U];
    text += kHexDigits[byte & kLowNibble];
  }
  return text;
}

bool is_sha256_hex(std::string_view text) {
  return text.size() == kSha256HexDigits && text.find_first_not_of(kHexDigits) == std::string_view::npos;
}

}  // namespace seeker::digest
