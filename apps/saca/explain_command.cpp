#include "apps/saca/options.h"
#include "saca/base/core/file.h"
#include "saca/lab/report/record_in_words.h"
#include "saca/lab/runs/explanation_text.h"

namespace saca::app {
namespace {

struct ExplainOptions {
  std::string record;
  bool as_json = false;
};

void explain(const ExplainOptions& options) {
  const std::string text = need(read_file(options.record));
  const auto told = need(report::explanation(text, options.record));
  app::print("{}", options.as_json ? runs::explanation_json(told).dump(
                                         1, ' ', false, nlohmann::json::error_handler_t::replace) +
                                         "\n"
                                   : runs::explanation_text(told));
}

}  // namespace

void add_explain(CLI::App& line) {
  const auto [command, options] = add_command<ExplainOptions>(
      line, "explain", "Tell in plain words why a run did what it did", explain);
  add_needed(command, "record", options.record, "A record.json that `saca run` left");
  add_json(command, options.as_json, "Print the sentences, for programs");
}

}  // namespace saca::app
