#include "tests/docs/page.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

namespace seeker::docs {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

/// As GitHub makes it of a heading.
std::string anchor_of(std::string_view heading) {
  std::string anchor;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

/// Moves the inline code of a line into the page; the answer is the line without it.
std::string take_inline_code(const std::string& line, std::size_t number, Page& page) {
  std::string rest;
  std::size_t at = 0;
  while (true) {
    const std::size_t begin = line.find('`', at);
    const std::size_t end = begin == std::string::npos ? begin : line.find('`', begin + 1);
    if (end == std::string::npos) {
      return rest + line.substr(at);
    }
    rest += line.substr(at, begin - at);
    page.code.push_back({number, line.substr(begin + 1, end - begin - 1)});
    at = end + 1;
  }
}

void take_links(const std::string& line, std::size_t number, Page& page) {
  static const std::regex target(R"(\]\(([^)\s]+)\))");
  for (auto match = std::sregex_iterator(line.begin(), line.end(), target); match != std::sregex_iterator(); ++match) {
    page.links.push_back({number, (*match)[1].str()});
  }
}

void take_block_line(const std::string& line, std::size_t number, bool& continues, Page& page) {
  if (continues) {
    page.code.back().text += ' ' + line;
  } else {
    page.code.push_back({number, line});
  }
  continues = line.ends_with('\\');
  if (continues) {
    page.code.back().text.pop_back();
  }
}

}  // namespace

Page parse_page(const std::string& path, std::string_view text) {
  Page page{.path = path, .lines = lines_of(text), .code = {}, .links = {}, .anchors = {}};
  bool in_block = false;
  bool continues = false;
  for (std::size_t i = 0; i < page.lines.size(); ++i) {
    const std::string& line = page.lines[i];
    if (line.starts_with("```")) {
      in_block = !in_block;
      continues = false;
    } else if (in_block) {
      take_block_line(line, i + 1, continues, page);
    } else {
      take_links(take_inline_code(line, i + 1, page), i + 1, page);
      if (line.starts_with('#')) {
        page.anchors.insert(anchor_of(std::string_view(line).substr(line.find_first_not_of("# "))));
      }
    }
  }
  return page;
}

std::size_t columns(std::string_view line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace seeker::docs
