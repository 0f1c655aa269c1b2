/// \file
/// The command line of seeker-lab.
#pragma once

namespace seeker::lab {

/// Runs one verb. Exit codes: 0 done and every check passed, 1 a check or the work failed, 2 wrong usage.
[[nodiscard]] int run_lab(int argc, char** argv);

}  // namespace seeker::lab
