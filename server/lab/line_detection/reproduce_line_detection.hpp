/// \file
/// Regenerates figures 3 and 4 and Table 1 of the line-detection paper and checks them (spec S7: R10).
#pragma once

#include "common/core/image.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/lines/paper_extractor.hpp"

namespace seeker::lab {

/// Writes fig3-lines.png, fig4-fits.png, fig-thresholds.png, table1.csv, thresholds.csv, history.csv, sensitivity.csv,
/// and one line for each row of Table 1 and for each condition to the report. Recorded scans are compared, too, where
/// the environment variable SEEKER_DATA names the folder of the recordings.
[[nodiscard]] Status reproduce_line_detection(const ReproduceParams& params, Report& report);

/// The paper's detector as printed: the error limit is 5 mm for any noise.
[[nodiscard]] lines::PaperParams printed_line_params();

/// Fig 3: the scan with its lines.
[[nodiscard]] Image table1_figure(const LaserScan& scan, const lines::ScanLines& found);
/// Fig 4: distances of the points of each line from the line.
[[nodiscard]] Image table1_fit_figure(const LaserScan& scan, const lines::ScanLines& found);

/// Each row of Table 1 as printed and as found, mean over the seeds.
void check_rows(const std::vector<std::uint64_t>& seeds, Report& report);
/// Checks R10 for the seeds.
void check_table1(const std::vector<std::uint64_t>& seeds, Report& report);
/// Checks R10: initial thresholds times 0.5 to 2 against split-and-merge with the same thresholds. Returns the table as
/// CSV.
[[nodiscard]] std::string check_thresholds(const std::vector<std::uint64_t>& seeds, Report& report);

}  // namespace seeker::lab
