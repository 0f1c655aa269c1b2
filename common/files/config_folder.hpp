/// \file
/// Where the files lie that come with Seeker: robots/, worlds/, targets/, missions/ of one folder, the configuration.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace seeker::files {

/// The folder of this program's file; empty where the system does not say.
[[nodiscard]] std::filesystem::path program_folder();

/// The configuration for a program in the folder `program` that was started in `working`: the folder `config` of
/// `working` or of a folder above it, then the same for `program`, then ../share/seeker/config of `program`, which is
/// where a package puts it; the first that `is_configuration`. Where there is none: "config".
[[nodiscard]] std::filesystem::path config_folder(
    const std::filesystem::path& working, const std::filesystem::path& program,
    const std::function<bool(const std::filesystem::path&)>& is_configuration);
/// The same for this program where it runs; a configuration has a folder robots/.
[[nodiscard]] std::filesystem::path config_folder();

/// A YAML file as users name it: a path, or the name of a file in `folder` with or without its ending, e.g. "sim". A
/// file that exists as a path wins. Whether the file is there is left to whoever reads it.
[[nodiscard]] std::filesystem::path named_file(const std::string& name, const std::filesystem::path& folder);

}  // namespace seeker::files
