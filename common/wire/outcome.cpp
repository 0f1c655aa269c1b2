#include "common/wire/outcome.hpp"

#include <cctype>

#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

constexpr int kLastErrc = static_cast<int>(Errc::kInternal);

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return out;
}

const google::protobuf::FieldDescriptor* result_field(CallNumber call) {
  const auto* field = pb::Response::descriptor()->FindFieldByNumber(call);
  return field != nullptr && field->containing_oneof() != nullptr ? field : nullptr;
}

pb::CommonError::Code code_of(Errc code) {
  pb::CommonError::Code out = pb::CommonError::CODE_INTERNAL;
  pb::CommonError::Code_Parse("CODE_" + upper(to_string(code)), &out);
  return out;
}

Error common_error(const pb::CommonError& error) {
  Error out{Errc::kInternal, error.message()};
  if (error.code() == pb::CommonError::CODE_RATE_LIMITED) {
    out.code = Errc::kBusy;
  } else if (error.code() == pb::CommonError::CODE_WRONG_ROBOT) {
    out.code = Errc::kNotFound;
  } else if (!errc_of(pb::CommonError::Code_Name(error.code()), out.code)) {
    out.code = Errc::kInternal;
  }
  return out;
}

}  // namespace

bool errc_of(const std::string& enumerator, Errc& code) {
  const std::size_t cut = enumerator.find('_');
  if (cut == std::string::npos) {
    return false;
  }
  for (int k = 0; k <= kLastErrc; ++k) {
    if (enumerator.compare(cut + 1, std::string::npos, upper(to_string(static_cast<Errc>(k)))) == 0) {
      code = static_cast<Errc>(k);
      return true;
    }
  }
  return false;
}

void set_common_error(pb::Response& response, pb::CommonError::Code code, const std::string& message) {
  pb::CommonError* error = response.mutable_header()->mutable_error();
  error->set_code(code);
  error->set_message(clean_text(message));
}

void set_error(pb::CommonError& error, const Status& outcome) {
  error.set_code(outcome ? pb::CommonError::CODE_OK : code_of(outcome.error().code));
  if (!outcome) {
    error.set_message(clean_text(outcome.error().message));
  }
}

Status status_of(const pb::CommonError& error) {
  if (error.code() == pb::CommonError::CODE_OK) {
    return {};
  }
  return tl::unexpected<Error>(common_error(error));
}

void set_outcome(pb::Response& response, CallNumber call, const Status& outcome) {
  const auto* field = result_field(call);
  if (field == nullptr) {
    set_common_error(response, pb::CommonError::CODE_UNSUPPORTED_VERSION, "this robot does not know the call");
    return;
  }
  auto* result = response.GetReflection()->MutableMessage(&response, field);
  const auto* status = field->message_type()->FindFieldByName("status");
  const auto* message = field->message_type()->FindFieldByName("message");
  const std::string name = outcome ? "OK" : upper(to_string(outcome.error().code));
  const auto* value = status->enum_type()->FindValueByName("STATUS_" + name);
  if (value == nullptr) {
    response.GetReflection()->ClearField(&response, field);
    set_common_error(response, code_of(outcome.error().code), outcome.error().message);
    return;
  }
  response.mutable_header()->mutable_error()->set_code(pb::CommonError::CODE_OK);
  result->GetReflection()->SetEnum(result, status, value);
  if (!outcome) {
    result->GetReflection()->SetString(result, message, clean_text(outcome.error().message));
  }
}

Status outcome(const pb::Response& response) {
  if (Status common = status_of(response.header().error()); !common) {
    return common;
  }
  const auto* field = result_field(static_cast<CallNumber>(response.result_case()));
  if (field == nullptr) {
    return fail(Errc::kInternal, "the robot answered without a result");
  }
  const auto& result = response.GetReflection()->GetMessage(response, field);
  const auto* status = field->message_type()->FindFieldByName("status");
  const auto* message = field->message_type()->FindFieldByName("message");
  const std::string name = result.GetReflection()->GetEnum(result, status)->name();
  if (name == "STATUS_OK") {
    return {};
  }
  Error failure{Errc::kInternal, result.GetReflection()->GetString(result, message)};
  if (!errc_of(name, failure.code)) {
    failure.message = "the robot answered with a status that is not known here: " + failure.message;
  }
  return tl::unexpected<Error>(std::move(failure));
}

std::string call_name(CallNumber call) {
  const auto* field = result_field(call);
  return field == nullptr ? "unknown" : field->name();
}

}  // namespace seeker::wire
