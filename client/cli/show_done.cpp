#include "client/cli/show_done.hpp"

#include "client/cli/json.hpp"

namespace seeker::cli {

VerbResult show_done(const Context& context, const Status& ok, const std::string& done) {
  if (!ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (context.json) {
    *context.out << Json().begin_object().field("ok", true).field("message", done).end_object().str() << '\n';
  } else {
    *context.out << done << '\n';
  }
  return ExitCode::kOk;
}

}  // namespace seeker::cli
