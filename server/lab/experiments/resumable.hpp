/// \file
/// Runs many experiments of one kind: each leaves a file, and only those without a file are made.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

/// One kind of run: its file name, its settings, and the functions that load and make it. `Run` has a member
/// `settings`.
template <class Spec, class Run>
struct RunKind {
  std::function<std::filesystem::path(const Spec&)> file;    ///< file of its results
  std::function<Result<std::string>(const Spec&)> settings;  ///< hash of everything that affects it except the seed
  std::function<Result<Run>(const std::filesystem::path&)> load;
  std::function<Result<Run>(const Spec&, const std::string& settings)> make;  ///< makes the run and writes its files
  std::function<std::string(const Run&)> progress_line;                       ///< one line of progress
};

/// Calls `work` in this number of threads at once, including the calling one, with OpenCV's own threads switched off
/// meanwhile.
void run_in_threads(int jobs, const std::function<void()>& work);
/// Overwrites the progress line on stderr; an empty text ends it.
void print_progress(const std::string& text);

/// The runs of all specs, in their order: read where a file with the same settings exists, otherwise made. A run that
/// cannot be made does not stop the others; the error then names the first of them.
template <class Spec, class Run>
[[nodiscard]] Result<std::vector<Run>> resume_runs(const std::vector<Spec>& specs, const RunKind<Spec, Run>& kind,
                                                   int jobs, bool show_progress) {
  std::vector<Run> runs(specs.size());
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::optional<Error> error;
  int made = 0;
  const auto one = [&](const Spec& spec) -> Result<Run> {
    const Result<std::string> settings = kind.settings(spec);
    if (!settings) {
      return tl::unexpected<Error>(settings.error());
    }
    if (Result<Run> known = kind.load(kind.file(spec)); known && known->settings == *settings) {
      return known;
    }
    Result<Run> run = kind.make(spec, *settings);
    if (run && show_progress) {
      const std::scoped_lock lock(mutex);
      print_progress(std::to_string(++made) + " new of " + std::to_string(specs.size()) +
                     " runs: " + kind.progress_line(*run));
    }
    return run;
  };
  run_in_threads(jobs, [&] {
    for (std::size_t n = next++; n < specs.size(); n = next++) {
      Result<Run> run = one(specs[n]);
      const std::scoped_lock lock(mutex);
      if (run) {
        runs[n] = std::move(*run);
      } else if (!error) {
        error = Error{run.error().code, kind.file(specs[n]).string() + ": " + run.error().message};
      }
    }
  });
  if (made > 0) {
    print_progress("");
  }
  if (error) {
    return tl::unexpected<Error>(*error);
  }
  return runs;
}

}  // namespace seeker::lab
