#include "tests/docs/source_path.hpp"

#include <algorithm>
#include <array>
#include <regex>

namespace seeker::docs {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> kTop = {"client/",    "cmake/", "common/", "config/", "docs/",
                                                   "packaging/", "proto/", "server/", "tests/",  ".ci/"};

bool matches_part_of(const fs::path& folder, fs::path::const_iterator part, fs::path::const_iterator end);

/// Any entry of the folder whose name has the form of the part, from which the rest of the path leads on.
bool matches_any(const fs::path& folder, fs::path::const_iterator part, fs::path::const_iterator end) {
  std::string form;
  for (const char c : std::regex_replace(part->string(), std::regex("[A-Z]{3,}"), "*")) {
    form += c == '*' ? std::string(".*") : c == '.' ? std::string("\\.") : std::string(1, c);
  }
  const std::regex wanted(form);
  const fs::directory_iterator entries(folder);
  return std::any_of(begin(entries), fs::end(entries), [&](const fs::directory_entry& entry) {
    return std::regex_match(entry.path().filename().string(), wanted) &&
           matches_part_of(entry.path(), std::next(part), end);
  });
}

bool matches_part_of(const fs::path& folder, fs::path::const_iterator part, fs::path::const_iterator end) {
  if (part == end || part->empty()) {  // the last part of a path that ends with a slash is empty
    return true;
  }
  if (!fs::is_directory(folder)) {
    return false;
  }
  const fs::path plain = folder / *part;
  return fs::exists(plain) ? matches_part_of(plain, std::next(part), end) : matches_any(folder, part, end);
}

}  // namespace

std::vector<std::string> source_paths_in(std::string_view code) {
  std::vector<std::string> paths;
  const std::string text(code);
  static const std::regex word(R"([\w.*/-]+)");
  for (auto match = std::sregex_iterator(text.begin(), text.end(), word); match != std::sregex_iterator(); ++match) {
    std::string path = match->str();
    path.erase(path.find_last_not_of('.') + 1);
    if (std::any_of(kTop.begin(), kTop.end(), [&](std::string_view top) { return path.starts_with(top); })) {
      paths.push_back(std::move(path));
    }
  }
  return paths;
}

bool exists_in_tree(const std::filesystem::path& top, const std::string& path) {
  const fs::path parts(path);
  return matches_part_of(top, parts.begin(), parts.end());
}

}  // namespace seeker::docs
