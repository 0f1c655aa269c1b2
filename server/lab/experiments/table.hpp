/// \file
/// A small table of texts, printed aligned or as CSV.
#pragma once

#include <string>
#include <vector>

namespace seeker::lab {

class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}

  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// RFC 4180, lines end in \n.
  [[nodiscard]] std::string csv() const;
  /// A table of Markdown, as it is.
  [[nodiscard]] std::string markdown() const;
  /// Columns padded to their width, the first two to the left, numbers to the right.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// A number with so many digits behind the point.
[[nodiscard]] std::string fixed(double value, int digits);

}  // namespace seeker::lab
