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
#include "saca/lab/cases/chat_set_report.h"

namespace saca::app {
namespace {

struct CasesCheckOptions {
  std::vector<std::string> files;
  bool as_json = false;
};

int check_sets(const CasesCheckOptions& options) {
  nlohmann::json out = nlohmann::json::array();
  const cases::ChatLimits limits;
  for (const std::string& file : options.files) {
    const auto text = read_file(file, limits.most_bytes + 1);
    if (!text.has_value()) {
      return refused(text.error());
    }
    const auto checked = cases::check_chat_set(text.value(), file, limits);
    if (!checked.has_value()) {
      return refused(checked.error());
    }
    out.push_back(cases::chat_set_json(file, checked.value()));
    if (!options.as_json) {
      app::print("{}", cases::chat_set_text(file, checked.value()));
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
