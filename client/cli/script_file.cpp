#include "client/cli/script.hpp"
#include "common/config/yaml.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

/// A file that the script at `script` names under `key`, relative to the script's folder.
Status resolve(const fs::path& script, const std::string& key, fs::path& file) {
  if (file.empty()) {
    return {};
  }
  const fs::path there = fs::absolute(script.parent_path() / file).lexically_normal();
  std::error_code error;
  if (!fs::is_regular_file(there, error)) {
    return fail(Errc::kNotFound, script.string() + ": " + key + ": there is no file " + there.string() +
                                     "; write its path relative to the script's folder, or leave '" + key + "' out");
  }
  file = there;
  return {};
}

}  // namespace

Result<Script> load_script(const fs::path& path) {
  const Result<std::string> text = config::read_text_file(path);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  Result<Script> script = parse_script(*text, path.string());
  if (script) {
    for (const auto& [key, file] : {std::pair("robot", &script->robot), std::pair("world", &script->world)}) {
      if (const Status ok = resolve(path, key, *file); !ok) {
        return tl::unexpected<Error>(ok.error());
      }
    }
  }
  return script;
}

}  // namespace seeker::cli
