/// \file
/// Reads the results of finished runs.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "common/config/yaml.hpp"
#include "common/core/result.hpp"

namespace seeker::lab {

/// The numbers of a run that save() wrote. Errors: kNotFound, those of the strict reader, and kUnsupportedVersion for a
/// schema that differs from this program's.
template <class Run>
[[nodiscard]] Result<Run> load_run(const std::filesystem::path& path) {
  Run run;
  const int known = std::exchange(run.schema, 0);
  if (const Status ok = config::load_file(path, run); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (run.schema != known) {
    return fail(Errc::kUnsupportedVersion, path.string() + ": schema " + std::to_string(run.schema) +
                                               ", this program writes " + std::to_string(known) +
                                               "; use another --out or remove the file");
  }
  return run;
}

}  // namespace seeker::lab
