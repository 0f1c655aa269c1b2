/// \file
/// Command `seeker-lab revisit`: finds photographs of an ordered folder that show the same place again.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/vision/place_index.hpp"

namespace seeker::lab {

struct RevisitOptions {
  std::filesystem::path folder;  ///< PNG and JPEG files, in the order of the numbers in their names
  std::filesystem::path out;     ///< created where missing
  int gap = 15;                  ///< photographs closer than this in the order are not revisits
  bool all = false;              ///< true: every pair; false: only the best earlier photograph for each one
  bool json = false;
  vision::PlaceParams params = {};
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< called after each photograph; may be empty
};

/// Two photographs of one place.
struct Revisit {
  std::string picture;  ///< file name of the later one
  std::string earlier;
  int matches = 0;
  int inliers = 0;
  std::string drawing;  ///< file name in the output folder

  friend bool operator==(const Revisit&, const Revisit&) = default;
};

/// Pictures of a folder in the order of their names, where numbers are ordered by value: 2.jpg before 10.jpg. Errors:
/// kNotFound where there is no such folder or no picture in it.
[[nodiscard]] Result<std::vector<std::filesystem::path>> ordered_pictures(const std::filesystem::path& folder);

/// Finds revisits and writes into `out` the file revisits.csv and one picture for each pair, with both photographs side
/// by side and their inliers. Errors: those of the files, with their names.
[[nodiscard]] Result<std::vector<Revisit>> find_revisits(const RevisitOptions& options);

/// Runs find_revisits() and prints the list as text or JSON.
[[nodiscard]] Status run_revisit(const RevisitOptions& options, std::ostream& text);

}  // namespace seeker::lab
