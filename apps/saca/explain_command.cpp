#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/lab/report/record_in_words.h"
#include "saca/lab/runs/explanation_told.h"

namespace saca::app {
namespace {

struct ExplainOptions {
  std::string record;
  bool as_json = false;
};

int run(const ExplainOptions& options) {
  const auto text = read_file(options.record);
  if (!text.has_value()) {
    return refused(text.error());
  }
  const auto told = report::explanation(text.value(), options.record);
  if (!told.has_value()) {
    return refused(told.error());
  }
  if (options.as_json) {
    app::print("{}\n", runs::explanation_json(told.value())
                           .dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    app::print("{}", runs::explanation_text(told.value()));
  }
  return success;
}

}  // namespace

void add_explain(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("explain", "Tell in plain words why a run did what it did");
  const auto options = std::make_shared<ExplainOptions>();
  command->add_option("record", options->record, "A record.json that `saca run` left")->required();
  command->add_flag("--json", options->as_json, "Print the sentences, for programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace saca::app
