/// \file
/// `seeker-lab revisit`: which photographs of an ordered folder show a place again.
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
  std::filesystem::path out;     ///< made where missing
  int gap = 15;                  ///< photographs nearer than this in the order are no revisit
  bool all = false;              ///< every pair; else each photograph's best earlier one
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

/// Pictures of a folder by name, numbers in names by their value: 2.jpg before 10.jpg. Errors: kNotFound where there is
/// no such folder or no picture in it.
[[nodiscard]] Result<std::vector<std::filesystem::path>> ordered_pictures(const std::filesystem::path& folder);

/// Finds revisits and writes revisits.csv and one picture a pair, both photographs side by side with their inliers,
/// into `out`. Errors: those of files, with their names.
[[nodiscard]] Result<std::vector<Revisit>> find_revisits(const RevisitOptions& options);

/// find_revisits() and the list as text or JSON.
[[nodiscard]] Status run_revisit(const RevisitOptions& options, std::ostream& text);

}  // namespace seeker::lab
