#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "seeker/v1/emulator.pb.h"
#include "seeker/v1/fleet.pb.h"
#include "seeker/v1/kept.pb.h"
#include "seeker/v1/session.pb.h"
#include "tests/support/data.hpp"

namespace seeker {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;

/// One line per field and enumerator: "message.name number" -> "name type label".
using Schema = std::map<std::string, std::string>;

void describe(const EnumDescriptor& type, Schema& out) {
  for (int k = 0; k < type.value_count(); ++k) {
    out[type.full_name() + " " + std::to_string(type.value(k)->number())] = type.value(k)->name();
  }
}

std::string type_of(const FieldDescriptor& field) {
  std::string type = field.type_name();
  if (field.type() == FieldDescriptor::TYPE_MESSAGE) {
    type = field.message_type()->full_name();
  } else if (field.type() == FieldDescriptor::TYPE_ENUM) {
    type = field.enum_type()->full_name();
  }
  const bool in_oneof = field.real_containing_oneof() != nullptr;
  return (field.is_repeated()            ? "repeated "
          : field.has_optional_keyword() ? "optional "
          : in_oneof                     ? "oneof "
                                         : "") +
         type;
}

void describe(const Descriptor& type, Schema& out) {
  for (int k = 0; k < type.field_count(); ++k) {
    const FieldDescriptor& field = *type.field(k);
    out[type.full_name() + " " + std::to_string(field.number())] = field.name() + " " + type_of(field);
  }
  for (int k = 0; k < type.nested_type_count(); ++k) {
    describe(*type.nested_type(k), out);
  }
  for (int k = 0; k < type.enum_type_count(); ++k) {
    describe(*type.enum_type(k), out);
  }
}

void describe(const FileDescriptor& file, Schema& out) {
  for (int k = 0; k < file.message_type_count(); ++k) {
    describe(*file.message_type(k), out);
  }
  for (int k = 0; k < file.enum_type_count(); ++k) {
    describe(*file.enum_type(k), out);
  }
  for (int k = 0; k < file.dependency_count(); ++k) {
    describe(*file.dependency(k), out);
  }
}

Schema present() {
  Schema out;
  describe(*seeker::v1::Envelope::descriptor()->file(), out);
  describe(*seeker::v1::FleetRequest::descriptor()->file(), out);
  describe(*seeker::v1::KeptPlace::descriptor()->file(), out);
  describe(*seeker::v1::EmulatorRequest::descriptor()->file(), out);
  return out;
}

/// "seeker.v1.Pose2 3" is reserved in today's schema.
bool is_reserved(const std::string& key) {
  const std::size_t cut = key.rfind(' ');
  const int number = std::stoi(key.substr(cut + 1));
  const auto* pool = google::protobuf::DescriptorPool::generated_pool();
  if (const auto* message = pool->FindMessageTypeByName(key.substr(0, cut))) {
    return message->IsReservedNumber(number);
  }
  const auto* enumeration = pool->FindEnumTypeByName(key.substr(0, cut));
  return enumeration != nullptr && enumeration->IsReservedNumber(number);
}

TEST(GoldenDescriptor, NoFieldOfAReleasedProtocolChangesItsMeaning) {
  std::ifstream file(testing::source_file("tests/golden/proto/schema.txt"));
  const Schema now = present();
  std::size_t lines = 0;
  for (std::string line; std::getline(file, line);) {
    const std::size_t cut = line.find(" = ");
    ASSERT_NE(cut, std::string::npos) << line;
    ++lines;
    const std::string key = line.substr(0, cut);
    const auto found = now.find(key);
    if (found == now.end()) {
      EXPECT_TRUE(is_reserved(key)) << key << " was removed: reserve its number and name, with the reason";
    } else {
      EXPECT_EQ(found->second, line.substr(cut + 3)) << key << " has changed: take a new number instead";
    }
  }
  EXPECT_GT(lines, 300U);
}

TEST(GoldenDescriptor, WhatIsNewIsWrittenDown) {
  std::ifstream file(testing::source_file("tests/golden/proto/schema.txt"));
  std::stringstream text;
  text << file.rdbuf();
  std::string missing;
  for (const auto& [key, value] : present()) {
    const std::string line = key + " = " + value + "\n";
    if (text.str().find(line) == std::string::npos) {
      missing += line;
    }
  }
  EXPECT_TRUE(missing.empty()) << "add to tests/golden/proto/schema.txt:\n" << missing;
}

TEST(GoldenDescriptor, ZeroOfEveryEnumMeansUnspecified) {
  for (const auto& [key, value] : present()) {
    const auto* type =
        google::protobuf::DescriptorPool::generated_pool()->FindEnumTypeByName(key.substr(0, key.rfind(' ')));
    if (type != nullptr && key.substr(key.rfind(' ') + 1) == "0") {
      EXPECT_EQ(value.substr(value.rfind('_') + 1), "UNSPECIFIED") << key;
    }
  }
}

}  // namespace
}  // namespace seeker
