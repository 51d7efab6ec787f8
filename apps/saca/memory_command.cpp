#include <fmt/core.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/lab/banks/bank_changes.h"
#include "saca/lab/banks/bank_contents.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/banks/case_neighbours.h"
#include "saca/lab/banks/case_page.h"
#include "saca/lab/banks/case_picture.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/store.h"

namespace saca::app {
namespace {

struct MemoryOptions {
  std::string file = "runs/memory.sqlite";
  std::int64_t id = 0;
  std::string cases;  ///< JSON Lines
  std::string svg;
  std::string html;
  std::size_t most = 0;
  bool keep_trust = false;
  bool as_json = false;
};

int list_cases(const MemoryOptions& options) {
  const auto bank = banks::read_bank(options.file);
  if (!bank.has_value()) {
    complain(bank.error().message);
    return bad_input;
  }
  if (options.as_json) {
    app::print_json(banks::list_json(bank.value().cases));
  } else {
    app::print("{}", banks::list_text(bank.value().cases, bank.value().store.name()));
  }
  return success;
}

std::optional<Error> write_pictures(const MemoryOptions& options, memory::Store& memory,
                                    const memory::Case& one) {
  if (options.svg.empty() && options.html.empty()) {
    return std::nullopt;
  }
  const auto all = memory.all();
  if (!all.has_value()) {
    return all.error();
  }
  const auto near = banks::nearest_cases(one, all.value());
  if (!options.svg.empty()) {
    if (auto problem = long_work::write_output(options.svg, banks::case_picture(one, near))) {
      return problem;
    }
  }
  return options.html.empty()
             ? std::nullopt
             : long_work::write_output(
                   options.html,
                   banks::case_page(one, near,
                                    fmt::format("saca memory show {} --memory {} --html {}", one.id,
                                                memory.name(), options.html)));
}

int show_case(const MemoryOptions& options) {
  auto store = memory::Store::open_existing(options.file);
  if (!store.has_value()) {
    complain(store.error().message);
    return bad_input;
  }
  memory::Store memory = std::move(store).value();
  const auto found = memory.find(options.id);
  if (!found.has_value()) {
    complain(found.error().message);
    return bad_input;
  }
  if (!found.value()) {
    complain(
        fmt::format("{}: want an id of `saca memory list`, got {}", memory.name(), options.id));
    return bad_input;
  }
  if (const auto problem = write_pictures(options, memory, *found.value())) {
    return refused(*problem);
  }
  app::print("{}\n", memory::to_json(*found.value()).dump(1));  // it comes back to the last bit
  return success;
}

int export_cases(const MemoryOptions& options) {
  const auto bank = banks::read_bank(options.file);
  if (!bank.has_value()) {
    return refused(bank.error());
  }
  const std::vector<memory::Case>& cases = bank.value().cases;
  if (const auto problem = long_work::write_output(options.cases, memory::cases_text(cases))) {
    return refused(*problem);
  }
  app::print("{}: {} cases\n", options.cases, cases.size());
  return success;
}

int import_cases(const MemoryOptions& options) {
  auto cases = banks::read_cases(options.cases);
  if (!cases.has_value()) {
    return refused(cases.error());
  }
  auto store = banks::open_to_add(options.file);
  if (!store.has_value()) {
    return refused(store.error());
  }
  memory::Store memory = std::move(store).value();
  const auto import = banks::import_cases(
      memory, std::move(cases).value(),
      options.keep_trust ? banks::ImportedTrust::kept : banks::ImportedTrust::withdrawn);
  if (!import.has_value()) {
    return refused(import.error());
  }
  app::print("{}", text_of(import.value()));
  return success;
}

/// Forgets what is missed least, until there are few enough.
int thin_bank(const MemoryOptions& options) {
  auto read = banks::read_bank(options.file);
  if (!read.has_value()) {
    return refused(read.error());
  }
  banks::ReadBank bank = std::move(read).value();
  const auto thinning = banks::thin(bank, options.most);
  if (!thinning.has_value()) {
    return refused(thinning.error());
  }
  app::print("{}", text_of(thinning.value()));
  return success;
}

/// Reads everything in the bank.
int verify_bank(const MemoryOptions& options) {
  const auto bank = banks::read_bank(options.file);
  if (!bank.has_value()) {
    return refused(bank.error());
  }
  const auto contents = banks::contents_of(bank.value());
  if (!contents.has_value()) {
    return refused(contents.error());
  }
  if (options.as_json) {
    app::print_json(json_of(contents.value()));
  } else {
    app::print("{}", text_of(contents.value()));
  }
  return success;
}

}  // namespace

void add_memory(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("memory", "What was learnt");
  command->require_subcommand(1);
  const auto options = std::make_shared<MemoryOptions>();
  const auto add_bank = [&options](CLI::App& to) {
    to.add_option("--memory", options->file, "The memory bank")->capture_default_str();
  };
  add_bank(*command);
  CLI::App* const list = command->add_subcommand("list", "All cases");
  list->add_flag("--json", options->as_json, "For programs");
  add_bank(*list);
  list->callback([options, &exit_code] { exit_code = list_cases(*options); });
  CLI::App* const show = command->add_subcommand("show", "One case, with its scene, as JSON");
  show->add_option("id", options->id)->required();
  show->add_option("--svg", options->svg, "It and those most like it as a picture, besides");
  show->add_option("--html", options->html, "Likewise as a page, with all that is known of it");
  add_bank(*show);
  show->callback([options, &exit_code] { exit_code = show_case(*options); });
  CLI::App* const taken = command->add_subcommand("import", "Takes over cases from JSON Lines");
  taken->add_option("cases", options->cases, "What `export` or `build` wrote")->required();
  taken->add_flag("--keep-trust", options->keep_trust,
                  "As they were trusted there: for one's own. Else each is used only where a "
                  "rollout confirms it");
  add_bank(*taken);
  taken->callback([options, &exit_code] { exit_code = import_cases(*options); });
  CLI::App* const given = command->add_subcommand("export", "Writes all cases as JSON Lines");
  given->add_option("cases", options->cases, "The file")->required();
  add_bank(*given);
  given->callback([options, &exit_code] { exit_code = export_cases(*options); });
  CLI::App* const thin = command->add_subcommand(
      "thin", "Forgets cases for which others stand, the most redundant first");
  thin->add_option("--most", options->most, "How many are to be left")->required();
  add_bank(*thin);
  thin->callback([options, &exit_code] { exit_code = thin_bank(*options); });
  CLI::App* const verify =
      command->add_subcommand("verify", "Reads all of the bank, and counts what is in it");
  verify->add_flag("--json", options->as_json, "For programs");
  add_bank(*verify);
  verify->callback([options, &exit_code] { exit_code = verify_bank(*options); });
  add_memory_add(*command, exit_code);
  add_memory_build(*command, exit_code);
  add_memory_check(*command, exit_code);
  add_memory_calibrate(*command, exit_code);
  add_memory_stats(*command, exit_code);
}

}  // namespace saca::app
