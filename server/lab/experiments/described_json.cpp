#include "server/lab/experiments/described_json.hpp"

#include <vector>

#include <nlohmann/json.hpp>

#include "common/core/angle.hpp"

namespace seeker::lab {
namespace {

using Json = nlohmann::ordered_json;

/// Adds each field that is visited to an object. Structs within structs are made apart and added when they are left,
/// since an object that grows moves its members.
class JsonFields final : public config::Fields {
 public:
  void field(std::string_view key, double& value) override { add(key, value); }
  void field(std::string_view key, int& value) override { add(key, value); }
  void field(std::string_view key, std::uint64_t& value) override { add(key, value); }
  void field(std::string_view key, bool& value) override { add(key, value); }
  void field(std::string_view key, std::string& value) override { add(key, value); }
  void field(std::string_view key, std::vector<double>& value) override { add(key, value); }
  void field(std::string_view key, std::vector<std::string>& value) override { add(key, value); }
  void field(std::string_view key, Point2& value) override { add(key, value); }
  void field(std::string_view key, Polygon& value) override { add(key, value); }
  void field(std::string_view key, Pose2& value) override {
    add(key, Json::array({value.x_m, value.y_m, rad_to_deg(value.theta_rad)}));
  }
  void require(std::string_view /*key*/) override {}
  void check(std::string_view /*key*/, bool /*ok*/, std::string_view /*message*/) override {}
  [[nodiscard]] bool has(std::string_view /*key*/) const override { return false; }
  [[nodiscard]] bool reading() const override { return false; }

  [[nodiscard]] const Json& object() const { return open_.front().value; }

 private:
  /// An object or a list whose members are being visited.
  struct Open {
    std::string key;  ///< in what surrounds it; empty in a list
    Json value;
  };

  [[nodiscard]] bool enter(std::string_view key) override {
    open_.push_back({std::string(key), Json::object()});
    return true;
  }
  [[nodiscard]] std::optional<std::size_t> enter_list(std::string_view key, std::size_t size) override {
    open_.push_back({std::string(key), Json::array()});
    return size;
  }
  void enter_item(std::size_t /*index*/) override { open_.push_back({"", Json::object()}); }
  void leave() override {
    Open left = std::move(open_.back());
    open_.pop_back();
    add(left.key, std::move(left.value));
  }
  void refuse_choice(std::string_view /*key*/, const std::string& /*got*/,
                     const std::vector<std::string_view>& /*allowed*/) override {}

  void add(std::string_view key, Json value) {
    Json& into = open_.back().value;
    if (into.is_array()) {
      into.push_back(std::move(value));
    } else {
      into[std::string(key)] = std::move(value);
    }
  }

  std::vector<Open> open_{{"", Json::object()}};  ///< innermost last
};

}  // namespace

Json described(const std::function<void(config::Fields&)>& describe) {
  JsonFields fields;
  describe(fields);
  return fields.object();
}

std::string json_lines(const Json& json) {
  const auto text = [](const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); };
  std::string lines;
  for (const auto& [key, value] : json.items()) {
    lines += lines.empty() ? "\n  " : ",\n  ";
    lines += (json.is_object() ? text(key) + ": " : "") + text(value);
  }
  return (json.is_object() ? "{" : "[") + lines + (json.is_object() ? "\n}\n" : "\n]\n");
}

std::string described_lines(const std::function<void(config::Fields&)>& describe) {
  return json_lines(described(describe));
}

}  // namespace seeker::lab
