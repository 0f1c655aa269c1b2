#include "client/cli/show_done.hpp"

#include <nlohmann/json.hpp>

#include "client/values/values_json.hpp"

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

VerbResult show_files(const Context& context, const Result<std::vector<std::filesystem::path>>& files) {
  if (!files) {
    return tl::unexpected<Error>(files.error());
  }
  Json names = Json::array();
  for (const std::filesystem::path& file : *files) {
    names.push_back(file.string());
    if (!context.json) {
      *context.out << file.string() << '\n';
    }
  }
  if (context.json) {
    *context.out << json_line(Json{{"files", names}}) << '\n';
  }
  return ExitCode::kOk;
}

}  // namespace seeker::cli
