#include "server/lab/search/search_experiment.hpp"
#include "server/lab/experiments/load_run.hpp"

#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/experiments/resumable.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/search/run_picture.hpp"

namespace seeker::lab {
namespace {

/// Files of one run: numbers last, since they say that the run is complete.
Status keep(const RunSpec& spec, const RunRecord& record, const ExperimentParams& params, const RecordSink& sink) {
  const std::filesystem::path file = run_file(params.out, spec);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  std::filesystem::path log = file;
  log.replace_extension(".log");
  if (Status ok = files::write_file(log, log_text(record.events)); !ok) {
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

}  // namespace

std::filesystem::path run_file(const std::filesystem::path& out, const RunSpec& spec) {
  const std::string world =
      spec.world_file.stem().string() + (spec.random_target ? "-random" : "") + (spec.explore ? "-explore" : "");
  return out / "runs" / world / std::string(to_string(spec.strategy)) / ("seed-" + std::to_string(spec.seed) + ".json");
}

Result<std::vector<RunResult>> run_missing(const std::vector<RunSpec>& specs, const ExperimentParams& params) {
  return run_missing(specs, params, {});
}

Result<std::vector<RunResult>> run_missing(const std::vector<RunSpec>& specs, const ExperimentParams& params,
                                           const RecordSink& sink) {
  RunKind<RunSpec, RunResult> kind;
  kind.file = [&](const RunSpec& spec) { return run_file(params.out, spec); };
  kind.settings = settings_of;
  kind.load = load_run<RunResult>;
  kind.make = [&](const RunSpec& spec, const std::string& settings) -> Result<RunResult> {
    Result<RunRecord> record = run_search(spec);
    if (!record) {
      return tl::unexpected<Error>(record.error());
    }
    record->result.world = run_file({}, spec).parent_path().parent_path().filename().string();
    record->result.settings = settings;
    if (const Status kept = keep(spec, *record, params, sink); !kept) {
      return tl::unexpected<Error>(kept.error());
    }
    return record->result;
  };
  kind.progress_line = [](const RunResult& result) {
    return result.world + " " + result.strategy + " seed " + std::to_string(result.seed) + ": " + result.outcome +
           " after " + fixed(result.robot_time_s, 0) + " s (" + fixed(result.speed(), 0) + "x)";
  };
  return resume_runs(specs, kind, params.jobs, params.show_progress);
}

Result<std::filesystem::path> without_targets(const std::filesystem::path& world_file,
                                              const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path written = folder / (world_file.stem().string() + "-no-target.yaml");
  const std::string text = "# The same world without anything to be found.\nbase: \"" +
                           std::filesystem::absolute(world_file).string() + "\"\nname: \"" +
                           world_file.stem().string() + "-no-target\"\ntargets: []\n";
  if (const Status ok = files::write_file(written, text); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return written;
}

}  // namespace seeker::lab
