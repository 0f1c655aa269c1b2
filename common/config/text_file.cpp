#include <fstream>
#include <sstream>

#include "common/config/yaml.hpp"

namespace seeker::config {

Result<std::string> read_text_file(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) {
    return fail(Errc::kNotFound, path.string() + ": no such file");
  }
  if (std::filesystem::file_size(path, code) > kMaxFileBytes || code) {
    return fail(Errc::kTooLarge, path.string() + ": larger than 4 MiB");
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) {
    return fail(Errc::kIo, path.string() + ": cannot be read; check its permissions");
  }
  return text.str();
}

Result<Document> Document::load(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  const Result<std::string> text = read_text_file(path);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  return parse(*text, path.string(), overrides);
}

}  // namespace seeker::config
