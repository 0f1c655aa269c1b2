#include <gtest/gtest.h>

#include "common/wire/outcome.hpp"

namespace seeker::wire {
namespace {

namespace pb = ::seeker::v1;

template <class F>
void for_each_call(F&& f) {
  const auto* descriptor = pb::Response::descriptor();
  for (int k = 0; k < descriptor->field_count(); ++k) {
    if (descriptor->field(k)->containing_oneof() != nullptr) {
      f(*descriptor->field(k));
    }
  }
}

TEST(Outcome, EveryCodeComesBackFromEveryCall) {
  for_each_call([](const google::protobuf::FieldDescriptor& field) {
    for (int k = 0; k <= static_cast<int>(Errc::kInternal); ++k) {
      const Error error{static_cast<Errc>(k), "why"};
      pb::Response response;
      set_outcome(response, field.number(), tl::unexpected<Error>(error));
      const Status back = outcome(response);
      ASSERT_FALSE(back) << field.name();
      EXPECT_EQ(back.error(), error) << field.name();
    }
    pb::Response response;
    set_outcome(response, field.number(), {});
    EXPECT_TRUE(outcome(response)) << field.name();
  });
}

TEST(Outcome, EveryStatusOfTheProtocolMeansAnErrorCode) {
  for_each_call([](const google::protobuf::FieldDescriptor& field) {
    const auto* status = field.message_type()->FindFieldByName("status");
    ASSERT_NE(status, nullptr) << field.name();
    EXPECT_EQ(status->number(), 1);
    for (int k = 2; k < status->enum_type()->value_count(); ++k) {
      Errc code{};
      EXPECT_TRUE(errc_of(status->enum_type()->value(k)->name(), code)) << status->enum_type()->value(k)->full_name();
    }
  });
}

TEST(Outcome, RequestAndResponseOfACallHaveTheSameNameAndNumber) {
  for_each_call([](const google::protobuf::FieldDescriptor& field) {
    const auto* request = pb::Request::descriptor()->FindFieldByNumber(field.number());
    ASSERT_NE(request, nullptr);
    EXPECT_EQ(request->name(), field.name());
    EXPECT_EQ(call_name(field.number()), field.name());
  });
}

TEST(Outcome, AResponseWithoutStatusIsAFaultOfTheRobot) {
  EXPECT_EQ(outcome(pb::Response()).error().code, Errc::kInternal);
  pb::Response response;
  response.mutable_header()->mutable_error()->set_code(pb::CommonError::CODE_OK);
  EXPECT_EQ(outcome(response).error().code, Errc::kInternal);
  response.mutable_get_info();
  EXPECT_EQ(outcome(response).error().code, Errc::kInternal);
}

}  // namespace
}  // namespace seeker::wire
