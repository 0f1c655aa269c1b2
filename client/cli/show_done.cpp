#include "client/cli/show_done.hpp"

#include <nlohmann/json.hpp>

#include "client/cli/values_json.hpp"

namespace seeker::cli {

VerbResult show_done(const Context& context, const Status& ok, const std::string& done) {
  if (!ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (context.json) {
    *context.out << json_line({{"ok", true}, {"message", done}}) << '\n';
  } else {
    *context.out << done << '\n';
  }
  return ExitCode::kOk;
}

}  // namespace seeker::cli
