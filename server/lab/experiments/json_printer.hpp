/// \file
/// A described struct (see config::Fields) as one JSON object. What it prints, the strict YAML reader reads back.
#pragma once

#include <string>

#include "common/config/fields.hpp"

namespace seeker::lab {

/// Values that are not finite become null: JSON has no others.
class JsonPrinter final : public config::Fields {
 public:
  void field(std::string_view key, double& value) override;
  void field(std::string_view key, int& value) override;
  void field(std::string_view key, std::uint64_t& value) override;
  void field(std::string_view key, bool& value) override;
  void field(std::string_view key, std::string& value) override;
  void field(std::string_view key, std::vector<double>& value) override;
  void field(std::string_view key, std::vector<std::string>& value) override;
  void field(std::string_view key, Point2& value) override;
  void field(std::string_view key, Polygon& value) override;
  void field(std::string_view key, Pose2& value) override;
  void require(std::string_view /*key*/) override {}
  void check(std::string_view /*key*/, bool /*ok*/, std::string_view /*message*/) override {}
  [[nodiscard]] bool has(std::string_view /*key*/) const override { return false; }
  [[nodiscard]] bool reading() const override { return false; }
  /// The members printed so far, without the outermost braces.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] bool enter(std::string_view key) override;
  [[nodiscard]] std::optional<std::size_t> enter_list(std::string_view key, std::size_t size) override;
  void enter_item(std::size_t index) override;
  void leave() override;
  void refuse_choice(std::string_view /*key*/, const std::string& /*got*/,
                     const std::vector<std::string_view>& /*allowed*/) override {}
  void member(std::string_view key, const std::string& value);
  void separate();

  std::string text_;
  std::string closing_;  ///< brackets that are open, innermost last
  bool first_ = true;    ///< nothing stands yet in the innermost bracket
};

/// A number as JSON writes it: the shortest text that reads back as the same value, or null.
[[nodiscard]] std::string json_number(double value);
[[nodiscard]] std::string json_string(std::string_view text);

/// The struct as an object, one member a line at the outermost level, with a newline at the end.
template <class T>
[[nodiscard]] std::string to_json(T value) {
  JsonPrinter printer;
  describe(printer, value);
  return "{" + printer.text() + "\n}\n";
}

}  // namespace seeker::lab
