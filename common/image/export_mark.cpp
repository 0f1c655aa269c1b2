#include "common/image/export_mark.hpp"

#include <array>
#include <fstream>

#include "common/image/png_chunks.hpp"

namespace seeker::image {
namespace {

/// All forms of the mark lie within so many bytes of a file.
constexpr std::size_t kHead_bytes = 256;

std::string head_of(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return "";
  }
  std::array<char, kHead_bytes> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return {head.data(), static_cast<std::size_t>(file.gcount())};
}

}  // namespace

std::string comment_mark(std::string_view mark) { return "# " + std::string(mark) + "\n"; }

std::string xml_mark(std::string_view mark) { return "<!-- " + std::string(mark) + " -->\n"; }

std::string with_xml_mark(std::string document, std::string_view mark) {
  document.insert(document.find('\n') + 1, xml_mark(mark));
  return document;
}

std::string json_mark(std::string_view mark) { return "\"generator\":\"" + std::string(mark) + "\""; }

bool carries_mark(const std::filesystem::path& path, std::string_view mark) {
  const std::string head = head_of(path);
  for (const std::string& form : {comment_mark(mark), xml_mark(mark), json_mark(mark), png_software_text(mark)}) {
    if (head.find(form) != std::string::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace seeker::image
