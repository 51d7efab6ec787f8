#include "apps/saca/options.h"
#include "saca/lab/runs/record_verification.h"

namespace saca::app {
namespace {

struct VerifyOptions {
  std::string record;
  bool as_json = false;
};

ExitCode verify(const VerifyOptions& options) {
  const auto check = need(runs::verified(here(), options.record));
  tell(options.as_json, json_of(check), text_of(check));
  return check.is_same() ? success : not_the_same;
}

}  // namespace

void add_verify(CLI::App& line) {
  const auto [command, options] = add_command<VerifyOptions>(
      line, "verify",
      "Check that a record is as it was written, and that what it was made from is here", verify);
  add_needed(command, "record", options.record, "A record.json that `saca run` left");
  add_json(command, options.as_json);
}

}  // namespace saca::app
