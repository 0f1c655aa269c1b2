#include "client/cli/export_check.hpp"

#include <cerrno>
#include <system_error>

#include <unistd.h>

#include "common/image/export_mark.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

Status check_folder(const fs::path& file) {
  if (Status ok = make_folder_of(file); !ok) {
    return ok;
  }
  const fs::path parent = file.parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    return fail(Errc::kIo, "cannot write into " + folder.string() + ": " + std::generic_category().message(errno));
  }
  return {};
}

Status check_file(const fs::path& file, std::string_view mark) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    return {};
  }
  if (fs::is_directory(file, error) || ::access(file.c_str(), W_OK) != 0) {
    return fail(Errc::kIo, "cannot write " + file.string() + ": it is there and is kept from being written");
  }
  if (!image::carries_mark(file, mark)) {
    return fail(Errc::kIo, file.string() +
                               " is there and is no such export of seeker, so it is not overwritten; choose "
                               "another name, or move the file away");
  }
  return {};
}

}  // namespace

Status make_folder_of(const fs::path& path) {
  if (path.has_parent_path()) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) {
      return fail(Errc::kIo, "cannot make the folder " + path.parent_path().string() + ": " + error.message());
    }
  }
  return {};
}

Status check_replaceable(const std::vector<fs::path>& files, std::string_view mark) {
  for (const fs::path& file : files) {
    Status ok = check_folder(file);
    ok = ok ? check_file(file, mark) : ok;
    if (!ok) {
      return ok;
    }
  }
  return {};
}

std::vector<fs::path> map_export_files(const std::string& name, const std::vector<std::string>& formats) {
  std::vector<fs::path> files;
  files.reserve(formats.size() + 1);
  for (const std::string& format : formats) {
    files.emplace_back(name + "." + format);
    if (format == "pgm") {
      files.emplace_back(name + ".yaml");
    }
  }
  return files;
}

Status check_map_export(const std::string& name, const std::vector<std::string>& formats) {
  return check_replaceable(map_export_files(name, formats), image::kMapExport);
}

}  // namespace seeker::cli
