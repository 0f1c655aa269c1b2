#include "server/store/named_files.hpp"

#include <algorithm>
#include <system_error>

#include "common/core/line_map.hpp"
#include "common/files/files.hpp"

namespace seeker::store {

namespace fs = std::filesystem;

Result<std::vector<std::string>> NamedFiles::names() const {
  std::vector<std::string> names;
  std::error_code error;
  if (!fs::exists(folder_, error)) {
    return names;
  }
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    std::string name = entry->path().stem().string();
    if (entry->path().extension() == kind_.ending && validate_map_name(name)) {
      names.push_back(std::move(name));
    }
  }
  if (error) {
    return fail(Errc::kIo, "cannot read the " + kind_.folder + " '" + folder_.string() + "': " + error.message());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Status NamedFiles::check_present(const std::string& name) const {
  if (Status ok = validate_map_name(name); !ok) {
    return ok;
  }
  std::error_code error;
  if (fs::is_regular_file(path_of(name), error)) {
    return {};
  }
  std::string list;
  for (const std::string& known : names().value_or(std::vector<std::string>())) {
    list += (list.empty() ? "" : ", ") + known;
  }
  return fail(Errc::kNotFound,
              "there is no " + kind_.name + " '" + name + "'; " + (list.empty() ? kind_.none : "there are: " + list));
}

Status NamedFiles::check_free(const std::string& name, bool replace) const {
  if (Status ok = validate_map_name(name); !ok) {
    return ok;
  }
  std::error_code error;
  if (!replace && fs::exists(path_of(name), error)) {
    return fail(Errc::kRefused,
                "there is a " + kind_.name + " '" + name + "' already; take another name, or --replace it");
  }
  return {};
}

Status NamedFiles::make_folder() const {
  const Status made = files::make_folder(folder_);
  return made
             ? made
             : fail(Errc::kIo, "the " + kind_.folder + ": " + made.error().message + "; give another one with --state");
}

Status NamedFiles::remove(const std::string& name) const {
  if (Status ok = check_present(name); !ok) {
    return ok;
  }
  std::error_code error;
  if (!fs::remove(path_of(name), error)) {
    return fail(Errc::kIo, "cannot delete " + kind_.name + " '" + name + "': " + error.message());
  }
  return files::sync_folder(folder_);
}

}  // namespace seeker::store
