#include "common/files/config_folder.hpp"

#include <system_error>

namespace seeker::files {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "config";

}  // namespace

fs::path program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path();
}

fs::path config_folder(const fs::path& working, const fs::path& program,
                       const std::function<bool(const fs::path&)>& is_configuration) {
  for (fs::path above : {working, program}) {
    for (; above.has_relative_path(); above = above.parent_path()) {
      if (is_configuration(above / kName)) {
        return above / kName;
      }
    }
  }
  const fs::path installed = program.parent_path() / "share/seeker" / kName;
  return is_configuration(installed) ? installed : fs::path(kName);
}

fs::path config_folder() {
  std::error_code error;
  const fs::path working = fs::current_path(error);
  return config_folder(error ? fs::path() : working, program_folder(), [](const fs::path& folder) {
    std::error_code unreadable;
    return fs::is_directory(folder / "robots", unreadable);
  });
}

fs::path named_file(const std::string& name, const fs::path& folder) {
  const fs::path path(name);
  std::error_code error;
  const bool is_file = fs::exists(path, error) && !fs::is_directory(path, error);
  if (is_file || path.has_parent_path()) {
    return path;
  }
  return folder / (path.has_extension() ? name : name + ".yaml");
}

}  // namespace seeker::files
