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
  /// The table as CSV (RFC 4180); lines end in \n.
  [[nodiscard]] std::string csv() const;
  /// The table in Markdown.
  [[nodiscard]] std::string markdown() const;
  /// The table with columns padded to their width, the first two aligned left, numbers right.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// A number with this many digits after the decimal point.
[[nodiscard]] std::string fixed(double value, int digits);

}  // namespace seeker::lab
