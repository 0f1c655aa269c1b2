#include "server/lab/stereo_database/reproduce_stereo_database.hpp"
#include "server/lab/experiments/load_run.hpp"

#include <algorithm>
#include <array>

#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/resumable.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/stereo_database/stereo_bisection.hpp"
#include "server/lab/stereo_database/stereo_comparison.hpp"
#include "server/lab/stereo_database/stereo_run.hpp"

namespace seeker::lab {
namespace {

namespace fs = std::filesystem;

fs::path file_of(const fs::path& out, const StereoSpec& spec, const std::string& ending) {
  return out / "runs" / (spec.paper ? "paper" : "default") / ("seed-" + std::to_string(spec.seed) + ending);
}

Status keep_figures(const fs::path& out, const StereoSpec& spec, const StereoRecord& record) {
  struct Plan {
    const char* name;
    const char* figure;
  };
  for (const Plan& wanted : {Plan{"all", "-fig4.png"}, Plan{"sparse", "-fig6.png"}, Plan{"salient", "-fig8.png"}}) {
    for (const DatabasePlan& plan : record.plans) {
      if (plan.name != wanted.name) {
        continue;
      }
      if (Status ok = image::write_png(file_of(out, spec, wanted.figure), plan_figure(plan, record.path)); !ok) {
        return ok;
      }
    }
  }
  std::vector<ErrorCurve> curves;
  std::copy_if(record.curves.begin(), record.curves.end(), std::back_inserter(curves),
               [](const ErrorCurve& curve) { return curve.name != "changed" && curve.name != "outdated"; });
  for (const StereoPicture& picture : record.pictures) {
    if (Status ok = image::write_png(file_of(out, spec, "-" + picture.name + ".png"), picture.image); !ok) {
      return ok;
    }
  }
  for (const std::string what : {"x", "y", "angle", "x-y"}) {
    if (Status ok = image::write_png(file_of(out, spec, "-fig13-" + what + ".png"), error_figure(curves, what)); !ok) {
      return ok;
    }
  }
  return {};
}

/// Files of one run: numbers last, since they say that the run is complete.
Status keep(const fs::path& out, const StereoSpec& spec, const StereoRecord& record) {
  std::error_code error;
  fs::create_directories(file_of(out, spec, ".json").parent_path(), error);
  if (Status ok = files::write_file(file_of(out, spec, "-table1.csv"), record.table1_csv); !ok) {
    return ok;
  }
  if (Status ok = files::write_file(file_of(out, spec, "-table2.csv"), record.table2_csv); !ok) {
    return ok;
  }
  if (Status ok = keep_figures(out, spec, record); !ok) {
    return ok;
  }
  return save(file_of(out, spec, ".json"), record.result);
}

RunKind<StereoSpec, StereoResult> kind_of(const fs::path& out) {
  RunKind<StereoSpec, StereoResult> kind;
  kind.file = [out](const StereoSpec& spec) { return file_of(out, spec, ".json"); };
  kind.settings = [](const StereoSpec& spec) { return settings_of(spec); };
  kind.load = load_run<StereoResult>;
  kind.make = [out](const StereoSpec& spec, const std::string& settings) -> Result<StereoResult> {
    Result<StereoRecord> record = run_stereo(spec);
    if (!record) {
      return tl::unexpected<Error>(record.error());
    }
    record->result.settings = settings;
    if (const Status kept = keep(out, spec, *record); !kept) {
      return tl::unexpected<Error>(kept.error());
    }
    return record->result;
  };
  kind.progress_line = [](const StereoResult& result) {
    const DatabaseScore* salient = result.find("salient");
    return result.mode + " seed " + std::to_string(result.seed) + ": " +
           (salient != nullptr ? fixed(1000.0 * salient->rms_m, 1) + " mm" : "no drive");
  };
  return kind;
}

RunKind<StereoSpec, BisectionResult> bisection_of(const fs::path& out) {
  RunKind<StereoSpec, BisectionResult> kind;
  kind.file = [out](const StereoSpec& spec) {
    return out / "runs" / "bisection" / ("seed-" + std::to_string(spec.seed) + ".json");
  };
  kind.settings = bisection_settings_of;
  kind.load = load_run<BisectionResult>;
  kind.make = [file = kind.file](const StereoSpec& spec, const std::string& settings) -> Result<BisectionResult> {
    Result<BisectionResult> result = bisect_stereo(spec);
    if (!result) {
      return result;
    }
    result->settings = settings;
    std::error_code error;
    fs::create_directories(file(spec).parent_path(), error);
    if (const Status kept = files::write_file(file(spec), to_json(*result)); !kept) {
      return tl::unexpected<Error>(kept.error());
    }
    return result;
  };
  kind.progress_line = [](const BisectionResult& result) { return "bisection of seed " + std::to_string(result.seed); };
  return kind;
}

std::vector<StereoSpec> specs_of(const ReproduceParams& params, bool paper, std::size_t at_most) {
  std::vector<StereoSpec> specs;
  for (const std::uint64_t seed : params.seeds) {
    if (specs.size() < at_most) {
      specs.push_back({params.config, seed, paper, params.overrides, params.smallest});
    }
  }
  return specs;
}

/// The bisection, of the first seeds only: it is a robot for each printed choice.
Status bisect(const ReproduceParams& params, Report& report) {
  constexpr std::size_t kSeeds = 3;
  const auto bisections =
      resume_runs(specs_of(params, true, kSeeds), bisection_of(params.out), params.jobs, params.show_progress);
  if (!bisections) {
    return tl::unexpected<Error>(bisections.error());
  }
  report_bisection(*bisections, report);
  return files::write_file(params.out / "bisection.csv", bisection_csv(*bisections));
}

}  // namespace

Status reproduce_stereo_database(const ReproduceParams& params, Report& report) {
  if (params.seeds.empty()) {
    return fail(Errc::kInvalidArgument, "no seeds to run: name some with --seeds");
  }
  std::error_code error;
  fs::create_directories(params.out, error);
  std::vector<StereoResult> all;
  std::array<std::vector<StereoResult>, 2> modes;  // ours, printed
  for (const bool paper : {false, true}) {
    Result<std::vector<StereoResult>> runs = resume_runs(specs_of(params, paper, params.seeds.size()),
                                                         kind_of(params.out), params.jobs, params.show_progress);
    if (!runs) {
      return tl::unexpected<Error>(runs.error());
    }
    all.insert(all.end(), runs->begin(), runs->end());
    if (Status ok = files::write_file(params.out / "table3.csv", table3_csv(all)); !ok) {
      return ok;
    }
    if (!paper) {
      check_stereo(*runs, report);
    }
    modes[paper ? 1 : 0] = std::move(*runs);
  }
  compare_stereo(modes[1], modes[0], report);
  return params.smallest ? Status() : bisect(params, report);
}

}  // namespace seeker::lab
