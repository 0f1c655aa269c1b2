#include "server/lab/experiment.hpp"

#include <array>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <thread>

#include <opencv2/core.hpp>

#include "common/core/time.hpp"
#include "common/image/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/run_picture.hpp"

namespace seeker::lab {
namespace {

std::string log_text(const RunRecord& record) {
  std::string text;
  for (const api::Event& event : record.events) {
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%9.1f ", event.mission_time ? to_seconds(*event.mission_time) : 0.0);
    text += time.data() + event.kind + ": " + event.text + "\n";
  }
  return text;
}

/// Files of one run: numbers last, since they say that the run is complete.
Status keep(const RunSpec& spec, const RunRecord& record, const ExperimentParams& params, const RecordSink& sink) {
  const std::filesystem::path file = run_file(params.out, spec);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  std::filesystem::path log = file;
  log.replace_extension(".log");
  if (Status ok = image::write_file(log, log_text(record)); !ok) {
    return ok;
  }
  if (params.pictures) {
    std::filesystem::path picture = file;
    picture.replace_extension(".png");
    const Result<Image> drawn = draw_run(record);
    if (!drawn) {
      return tl::unexpected<Error>(drawn.error());
    }
    if (Status ok = image::write_png(picture, *drawn); !ok) {
      return ok;
    }
  }
  if (sink) {
    if (Status ok = sink(spec, record); !ok) {
      return ok;
    }
  }
  return save(file, record.result);
}

/// Shared by the workers of one experiment.
class Runner {
 public:
  Runner(const std::vector<RunSpec>& specs, const ExperimentParams& params, const RecordSink& sink)
      : specs_(specs), params_(params), sink_(sink), results_(specs.size()) {}

  Result<std::vector<RunResult>> run() {
    // Threads run whole robots; OpenCV's own would only fight with them.
    const int threads_before = cv::getNumThreads();
    cv::setNumThreads(1);
    std::vector<std::thread> workers;
    for (int n = 1; n < params_.jobs; ++n) {
      workers.emplace_back([this] { work(); });
    }
    work();
    for (std::thread& worker : workers) {
      worker.join();
    }
    cv::setNumThreads(threads_before);
    if (params_.show_progress && made_ > 0) {
      std::fputs("\n", stderr);
    }
    if (error_) {
      return tl::unexpected<Error>(*error_);
    }
    return std::move(results_);
  }

 private:
  void work() {
    for (std::size_t n = next_++; n < specs_.size(); n = next_++) {
      Result<RunResult> result = one(specs_[n]);
      const std::scoped_lock lock(mutex_);
      if (result) {
        results_[n] = std::move(*result);
      } else if (!error_) {
        error_ = Error{result.error().code, run_file({}, specs_[n]).string() + ": " + result.error().message};
      }
    }
  }

  Result<RunResult> one(const RunSpec& spec) {
    const Result<std::string> settings = settings_of(spec);
    if (!settings) {
      return tl::unexpected<Error>(settings.error());
    }
    if (Result<RunResult> known = load(run_file(params_.out, spec)); known && known->settings == *settings) {
      return known;
    }
    Result<RunRecord> record = run_search(spec);
    if (!record) {
      return tl::unexpected<Error>(record.error());
    }
    record->result.world = run_file({}, spec).parent_path().parent_path().filename().string();
    record->result.settings = *settings;
    if (const Status kept = keep(spec, *record, params_, sink_); !kept) {
      return tl::unexpected<Error>(kept.error());
    }
    tell(record->result);
    return record->result;
  }

  void tell(const RunResult& result) {
    const std::scoped_lock lock(mutex_);
    ++made_;
    if (params_.show_progress) {
      std::fprintf(stderr, "\r\033[K%d of %zu runs: %s %s seed %llu: %s after %.0f s (%.0fx)", made_, specs_.size(),
                   result.world.c_str(), result.strategy.c_str(), static_cast<unsigned long long>(result.seed),
                   result.outcome.c_str(), result.robot_time_s, result.speed());
    }
  }

  const std::vector<RunSpec>& specs_;
  const ExperimentParams& params_;
  const RecordSink& sink_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::vector<RunResult> results_;
  std::optional<Error> error_;
  int made_ = 0;
};

}  // namespace

std::filesystem::path run_file(const std::filesystem::path& out, const RunSpec& spec) {
  const std::string world = spec.world_file.stem().string() + (spec.random_target ? "-random" : "");
  return out / "runs" / world / std::string(to_string(spec.strategy)) / ("seed-" + std::to_string(spec.seed) + ".json");
}

Result<std::vector<RunResult>> run_missing(const std::vector<RunSpec>& specs, const ExperimentParams& params) {
  return run_missing(specs, params, {});
}

Result<std::vector<RunResult>> run_missing(const std::vector<RunSpec>& specs, const ExperimentParams& params,
                                           const RecordSink& sink) {
  return Runner(specs, params, sink).run();
}

Result<std::filesystem::path> without_targets(const std::filesystem::path& world_file,
                                              const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path written = folder / (world_file.stem().string() + "-no-target.yaml");
  const std::string text = "# The same world without anything to be found.\nbase: \"" +
                           std::filesystem::absolute(world_file).string() + "\"\nname: \"" +
                           world_file.stem().string() + "-no-target\"\ntargets: []\n";
  if (const Status ok = image::write_file(written, text); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return written;
}

}  // namespace seeker::lab
