#include <fstream>
#include <iomanip>
#include <sstream>

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "common/wire/envelope.hpp"
#include "tests/support/data.hpp"

namespace seeker {
namespace {

std::string read(const std::string& name) {
  std::ifstream file(testing::source_file("tests/golden/proto/" + name));
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string hex(const std::string& bytes) {
  std::ostringstream out;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    out << std::hex << std::setw(2) << std::setfill('0') << static_cast<int>(static_cast<unsigned char>(bytes[k]))
        << ((k + 1) % 16 == 0 || k + 1 == bytes.size() ? "\n" : " ");
  }
  return out.str();
}

class WireBytes : public ::testing::TestWithParam<const char*> {};

/// The text is what a person reads, the bytes are what other programs depend on.
TEST_P(WireBytes, AFrameHasTheBytesItAlwaysHad) {
  const std::string name = GetParam();
  v1::Envelope envelope;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(read(name + ".txt"), &envelope)) << name;
  const auto frame = wire::frame_of(envelope);
  ASSERT_TRUE(frame);
  const std::string bytes = frame->head + *frame->body + frame->tail;
  EXPECT_EQ(hex(bytes), read(name + ".hex")) << name;
  const auto back = wire::parse_envelope(std::string_view(bytes).substr(wire::kFrameHeaderBytes));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->SerializeAsString(), envelope.SerializeAsString());
}

INSTANTIATE_TEST_SUITE_P(Golden, WireBytes,
                         ::testing::Values("hello", "stop_request", "status_update", "segments_update",
                                           "decision_update", "refusal", "set_settings_request", "components_reply"));

TEST(WireBytesOfStreams, HeadBodyAndTailAreOneMessage) {
  v1::Envelope envelope;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(read("status_update.txt"), &envelope));
  v1::StreamUpdate shared = envelope.stream_update();
  shared.clear_subscription_id();
  shared.clear_dropped();
  const auto frame = wire::stream_frame(std::make_shared<const std::string>(shared.SerializeAsString()),
                                        envelope.stream_update().subscription_id(), envelope.stream_update().dropped());
  EXPECT_EQ(hex(frame.head + *frame.body + frame.tail), read("status_update.hex"));
}

}  // namespace
}  // namespace seeker
