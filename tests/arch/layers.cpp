#include "tests/arch/layers.hpp"

#include <algorithm>
#include <functional>
#include <sstream>

namespace seeker::arch {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    words.push_back(word);
  }
  return words;
}

bool starts_with(const std::string& text, const std::string& prefix) { return text.rfind(prefix, 0) == 0; }

Status parse_folder(const std::string& line, Layers& layers) {
  const std::size_t first = line.find(':');
  const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
  if (second == std::string::npos) {
    return fail(Errc::kParse, "a folder needs 'folder PATH : FOLDERS : LIBRARIES'");
  }
  const std::vector<std::string> head = words_of(line.substr(0, first));
  if (head.size() != 2) {
    return fail(Errc::kParse, "a folder needs one path");
  }
  const auto folders = words_of(line.substr(first + 1, second - first - 1));
  const auto libraries = words_of(line.substr(second + 1));
  const bool added =
      layers.folders.emplace(head[1], Folder{{folders.begin(), folders.end()}, {libraries.begin(), libraries.end()}})
          .second;
  return added ? Status() : fail(Errc::kParse, "the folder " + head[1] + " is listed twice");
}

Status parse_line(const std::string& line, Layers& layers) {
  const std::vector<std::string> words = words_of(line);
  if (words.empty() || words[0][0] == '#') {
    return {};
  }
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (words[0] == "folder") {
    return parse_folder(line, layers);
  }
  if (words[0] == "library" && rest.size() >= 2) {
    layers.libraries[rest[0]] = {rest.begin() + 1, rest.end()};
    return {};
  }
  if (words[0] == "everywhere") {
    layers.everywhere.insert(rest.begin(), rest.end());
    return {};
  }
  if (words[0] == "hidden" || words[0] == "pure") {
    (words[0] == "hidden" ? layers.hidden : layers.pure).insert(rest.begin(), rest.end());
    return {};
  }
  return fail(Errc::kParse, "unknown line '" + line + "'");
}

/// Replaces `server/*` by the folders below server/, the folder itself apart.
void expand_stars(Layers& layers) {
  for (auto& [path, folder] : layers.folders) {
    std::set<std::string> expanded;
    for (const std::string& allowed : folder.folders) {
      if (allowed.back() != '*') {
        expanded.insert(allowed);
        continue;
      }
      for (const auto& [other, unused] : layers.folders) {
        if (other != path && starts_with(other, allowed.substr(0, allowed.size() - 1))) {
          expanded.insert(other);
        }
      }
    }
    folder.folders = std::move(expanded);
  }
}

Status check_names(const Layers& layers) {
  for (const auto& [path, folder] : layers.folders) {
    for (const std::string& allowed : folder.folders) {
      if (allowed != "proto" && allowed.back() != '*' && !layers.folders.contains(allowed)) {
        return fail(Errc::kParse, path + " may include " + allowed + ", which is not in the table");
      }
    }
    for (const std::string& library : folder.libraries) {
      if (library != "*" && !layers.libraries.contains(library)) {
        return fail(Errc::kParse, path + " may use " + library + ", which is not in the table");
      }
    }
  }
  for (const std::string& path : layers.pure) {
    if (!layers.folders.contains(path)) {
      return fail(Errc::kParse, "the pure folder " + path + " is not in the table");
    }
  }
  return {};
}

/// Programs' folders with stars see each other in the table; only what is written out must be free of cycles.
Status check_cycles(const Layers& layers) {
  std::set<std::string> done;
  std::vector<std::string> path;
  std::string cycle;
  const std::function<void(const std::string&)> visit = [&](const std::string& folder) {
    if (const auto seen = std::find(path.begin(), path.end(), folder); seen != path.end()) {
      for (auto it = seen; it != path.end(); ++it) {
        cycle += *it + " -> ";
      }
      cycle += folder;
      return;
    }
    const auto found = layers.folders.find(folder);
    if (found == layers.folders.end() || done.contains(folder)) {
      return;
    }
    path.push_back(folder);
    for (const std::string& next : found->second.folders) {
      if (cycle.empty() && next.back() != '*') {
        visit(next);
      }
    }
    path.pop_back();
    done.insert(folder);
  };
  for (const auto& [folder, unused] : layers.folders) {
    visit(folder);
    if (!cycle.empty()) {
      return fail(Errc::kParse, "the table has a cycle: " + cycle);
    }
  }
  return {};
}

}  // namespace

std::string Layers::library_of(const std::string& header) const {
  for (const auto& [name, prefixes] : libraries) {
    for (const std::string& prefix : prefixes) {
      if (starts_with(header, prefix)) {
        return name;
      }
    }
  }
  return {};
}

std::string Layers::folder_of(const std::string& path) const {
  std::string best;
  for (const auto& [folder, unused] : folders) {
    if (starts_with(path, folder + "/") && folder.size() > best.size()) {
      best = folder;
    }
  }
  return best;
}

Result<Layers> parse_layers(const std::string& text) {
  Layers layers;
  std::istringstream in(text);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (const Status ok = parse_line(line, layers); !ok) {
      return fail_with_context("line " + std::to_string(number), ok.error());
    }
  }
  for (const auto check : {&check_names, &check_cycles}) {
    if (const Status ok = check(layers); !ok) {
      return tl::unexpected(ok.error());
    }
  }
  expand_stars(layers);
  return layers;
}

}  // namespace seeker::arch
