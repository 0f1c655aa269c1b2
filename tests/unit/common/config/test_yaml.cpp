#include "common/config/yaml.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace seeker::config {
namespace {

enum class Colour : std::uint8_t { kRed, kBlue };

struct Wheel {
  double radius_m = 0.1;
  std::string name = "left";
};
struct Car {
  double speed_m_s = 1.0;
  double limit_rad = 1.0;
  int doors = 4;
  bool fast = false;
  Colour colour = Colour::kRed;
  Pose2 start;
  Polygon bound;
  Wheel spare;
  std::vector<Wheel> wheels{Wheel{}};
  std::optional<double> tow_kg;
};

void describe(Fields& f, Wheel& wheel) {
  f.field("radius_m", wheel.radius_m);
  f.check("radius_m", wheel.radius_m > 0.0, "must be above 0");
  f.field("name", wheel.name);
}

void describe(Fields& f, Car& car) {
  f.field("speed_m_s", car.speed_m_s);
  f.angle_deg("limit_deg", car.limit_rad);
  f.field("doors", car.doors);
  f.field("fast", car.fast);
  f.choice("colour", car.colour, Choices<Colour>{{"red", Colour::kRed}, {"blue", Colour::kBlue}});
  f.field("start", car.start);
  f.field("bound", car.bound);
  f.section("spare", car.spare);
  f.list("wheels", car.wheels);
  f.optional_field("tow_kg", car.tow_kg);
}

Result<Car> read(std::string_view text, const std::vector<std::string>& overrides = {}) {
  const Result<Document> document = Document::parse(text, "car.yaml", overrides);
  if (!document) {
    return tl::unexpected<Error>(document.error());
  }
  Car car;
  if (const Status ok = document->read(car); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return car;
}

std::string error_of(std::string_view text, const std::vector<std::string>& overrides = {}) {
  const Result<Car> car = read(text, overrides);
  return car ? "no error" : car.error().message;
}

TEST(Yaml, EmptyFileKeepsDefaults) {
  const Result<Car> car = read("");
  ASSERT_TRUE(car) << car.error().message;
  EXPECT_EQ(car->doors, 4);
  EXPECT_FALSE(car->tow_kg.has_value());
}

TEST(Yaml, ReadsEveryKindOfField) {
  const Result<Car> car = read(
      "speed_m_s: 2.5\nlimit_deg: 90\ndoors: 2\nfast: true\ncolour: blue\nstart: [1, 2, 180]\n"
      "bound: [[0, 0], [1, 0], [1, 1]]\nspare: {radius_m: 0.2}\nwheels:\n  - {name: a}\n  - {name: b}\ntow_kg: 700\n");
  ASSERT_TRUE(car) << car.error().message;
  EXPECT_DOUBLE_EQ(car->limit_rad, std::numbers::pi / 2.0);
  EXPECT_EQ(car->colour, Colour::kBlue);
  EXPECT_DOUBLE_EQ(car->start.theta_rad, std::numbers::pi);
  EXPECT_EQ(car->bound.size(), 3U);
  EXPECT_DOUBLE_EQ(car->spare.radius_m, 0.2);
  ASSERT_EQ(car->wheels.size(), 2U);
  EXPECT_EQ(car->wheels[1].name, "b");
  EXPECT_EQ(car->tow_kg, 700.0);
}

TEST(Yaml, UnknownKeyNamesFileLinePathAndWhatIsAllowed) {
  EXPECT_EQ(error_of("doors: 2\nspare:\n  radius: 1\n"),
            "car.yaml:3: spare.radius: unknown key; allowed here: radius_m, name");
  EXPECT_EQ(error_of("wheels:\n  - {name: a}\n  - {nam: b}\n"),
            "car.yaml:3: wheels[1].nam: unknown key; allowed here: radius_m, name");
}

TEST(Yaml, UnknownKeyIsToldBeforeWhatTheSectionLacks) {
  EXPECT_EQ(error_of("spare:\n  radius_m: -1\n  nam: b\n"),
            "car.yaml:3: spare.nam: unknown key; allowed here: radius_m, name");
  const std::string all = error_of("door: 2\n");
  EXPECT_NE(all.find("tow_kg"), std::string::npos) << "what may be left out is allowed too: " << all;
}

TEST(Yaml, WrongTypesRangesAndRepeatsAreRefused) {
  EXPECT_EQ(error_of("doors: two\n"), "car.yaml:1: doors: expected a whole number, got 'two'");
  EXPECT_EQ(error_of("speed_m_s: .nan\n"), "car.yaml:1: speed_m_s: must be a finite number");
  EXPECT_EQ(error_of("spare:\n  radius_m: -1\n"), "car.yaml:2: spare.radius_m: must be above 0");
  EXPECT_EQ(error_of("colour: green\n"), "car.yaml:1: colour: 'green' is not one of red, blue");
  EXPECT_EQ(error_of("doors: 2\ndoors: 3\n"), "car.yaml:2: doors: stands here twice");
  EXPECT_EQ(error_of("start: [1, 2]\n"), "car.yaml:1: start: expected [x, y, heading in degrees]");
}

TEST(Yaml, AliasesAndBrokenTextAreRefused) {
  EXPECT_NE(error_of("spare: &a {name: x}\nwheels: [*a]\n").find("not allowed"), std::string::npos);
  EXPECT_NE(error_of("spare: {name: [\n").find("car.yaml:"), std::string::npos);
}

TEST(Yaml, OverridesWinAndAreCheckedToo) {
  const Result<Car> car = read("doors: 2\n", {"doors=5", "spare.name=x"});
  ASSERT_TRUE(car) << car.error().message;
  EXPECT_EQ(car->doors, 5);
  EXPECT_EQ(car->spare.name, "x");
  EXPECT_NE(error_of("", {"spare.nme=x"}).find("unknown key"), std::string::npos);
  EXPECT_NE(error_of("", {"nonsense"}).find("key.path=value"), std::string::npos);
}

TEST(Yaml, AMistakeInAnOverrideIsToldAsOne) {
  EXPECT_EQ(error_of("doors: 2\n", {"fast=true", "doors=two"}),
            "--set doors=two: doors: expected a whole number, got 'two'");
  EXPECT_EQ(error_of("", {"spare.radius_m=-1"}), "--set spare.radius_m=-1: spare.radius_m: must be above 0");
  EXPECT_EQ(error_of("", {"spare.nme=x"}).find("--set spare.nme=x: spare.nme: unknown key"), 0U);
  EXPECT_EQ(error_of("", {"spra.name=x"}).find("--set spra.name=x: spra: unknown key"), 0U);
  EXPECT_EQ(error_of("doors: two\n", {"spare.name=x"}).find("car.yaml:1: doors"), 0U);
}

TEST(Yaml, PrintedValuesReadBackTheSame) {
  const Result<Car> car = read("speed_m_s: 0.1\nstart: [0.3, 2, 33.3]\nwheels: [{name: 'a\"b'}, {radius_m: 3}]\n");
  ASSERT_TRUE(car);
  const std::string text = print(*car);
  const Result<Car> again = read(text);
  ASSERT_TRUE(again) << again.error().message << "\n" << text;
  EXPECT_EQ(print(*again), text);
  EXPECT_EQ(again->wheels[0].name, "a\"b");
}

}  // namespace
}  // namespace seeker::config
