#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/cases_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/lab/eval/chat_set.h"

namespace saca::app {
namespace {

struct CasesCheckOptions {
  std::vector<std::string> files;
  bool as_json = false;
};

int check_sets(const CasesCheckOptions& options) {
  nlohmann::json out = nlohmann::json::array();
  const eval::ChatLimits limits;
  for (const std::string& file : options.files) {
    const auto text = read_file(file, limits.most_bytes + 1);
    if (!text.has_value()) {
      return refused(text.error());
    }
    const auto checked = eval::check_chat_set(text.value(), file, limits);
    if (!checked.has_value()) {
      return refused(checked.error());
    }
    const eval::ChatSetFigures& figures = checked.value();
    out.push_back({{"file", file},
                   {"examples", figures.examples},
                   {"tokens_at_most", figures.tokens},
                   {"learnt_tokens_at_most", figures.learnt_tokens},
                   {"longest_tokens_at_most", figures.longest}});
    if (!options.as_json) {
      app::print(
          "{}: {} examples, up to {} tokens, of them up to {} to be learnt, up to {} in one\n",
          file, figures.examples, figures.tokens, figures.learnt_tokens, figures.longest);
    }
  }
  if (options.as_json) {
    app::print_json(nlohmann::json{{"schema", "saca.chat_sets/1"}, {"sets", std::move(out)}});
  }
  return success;
}

}  // namespace

void add_cases_check(CLI::App& cases, int& exit_code) {
  CLI::App* const command = cases.add_subcommand(
      "check",
      "Holds sets of chats against the rules of services for fine-tuning, and counts tokens");
  const auto options = std::make_shared<CasesCheckOptions>();
  command->add_option("files", options->files, "JSON Lines of `saca cases export --format openai`")
      ->required();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = check_sets(*options); });
}

}  // namespace saca::app
