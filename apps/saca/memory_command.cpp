#include <fmt/core.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/memory_commands.h"
#include "apps/saca/memory_picture.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/formats/compressed_text.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/scene_json.h"
#include "saca/thinking/memory/store.h"
#include "saca/thinking/memory/thinning.h"

namespace saca::app {
namespace {

using nlohmann::json;

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

json case_json(const memory::Case& one) {
  return {{"id", one.id},
          {"source", one.source},
          {"policy", manoeuvre::index(one.plan.policy)},
          {"best", manoeuvre::index(one.best)},
          {"harm", one.harm},
          {"best_harm", one.best_harm},
          {"collision_loss", one.collision_loss},
          {"review", one.review},
          {"origin", name(one.origin)},
          {"trust", name(one.trust)},
          {"count", one.count}};
}

int list_cases(const MemoryOptions& options) {
  const auto bank = read_bank(options.file);
  if (!bank.has_value()) {
    complain(bank.error().message);
    return bad_input;
  }
  const std::vector<memory::Case>& cases = bank.value().cases;
  json list = json::array();
  for (const memory::Case& one : cases) {
    list.push_back(case_json(one));
    if (!options.as_json) {
      const std::string mark =
          one.trust == memory::Trust::trusted ? "" : fmt::format("  [{}]", name(one.trust));
      app::print("{:5}  {:24} did {} best {}  {}{}\n", one.id, one.source,
                 manoeuvre::index(one.plan.policy), manoeuvre::index(one.best), one.review, mark);
    }
  }
  if (options.as_json) {
    app::print_json(list);
  } else if (cases.empty()) {
    app::print("{}: no cases yet\n", bank.value().store.name());
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
  if (!options.svg.empty()) {
    if (auto problem = long_work::write_output(options.svg, case_picture(one, all.value()))) {
      return problem;
    }
  }
  return options.html.empty()
             ? std::nullopt
             : long_work::write_output(
                   options.html, case_page(one, all.value(),
                                           fmt::format("saca memory show {} --memory {} --html {}",
                                                       one.id, memory.name(), options.html)));
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
  const auto bank = read_bank(options.file);
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

/// The same scene of the same source: it is the same case, whatever else is said of it.
std::string name_of_case(const memory::Case& one) {
  return one.source + '\n' + memory::to_json(one.scene).dump();
}

/// Leaves out what the bank has already, and what comes twice.
/// @return  how many
std::size_t leave_out_known(std::vector<memory::Case>& cases,
                            const std::vector<memory::Case>& known) {
  std::set<std::string> keys;
  for (const memory::Case& one : known) {
    keys.insert(name_of_case(one));
  }
  return std::erase_if(
      cases, [&](const memory::Case& one) { return !keys.insert(name_of_case(one)).second; });
}

int import_cases(const MemoryOptions& options) {
  auto read = read_cases(options.cases);
  if (!read.has_value()) {
    return refused(read.error());
  }
  std::vector<memory::Case> cases = std::move(read).value();
  for (memory::Case& one : cases) {
    if (!options.keep_trust && one.trust == memory::Trust::trusted) {
      one.trust = memory::Trust::unchecked;
    }
  }
  auto store = open_to_add(options.file);
  if (!store.has_value()) {
    return refused(store.error());
  }
  memory::Store memory = std::move(store).value();
  const auto known = memory.all();
  if (!known.has_value()) {
    return refused(known.error());
  }
  const std::size_t left_out = leave_out_known(cases, known.value());
  const auto ids = memory.add_all(cases);
  if (!ids.has_value()) {
    return refused(ids.error());
  }
  app::print(
      "{}: {} cases taken over{}{}\n", memory.name(), cases.size(),
      left_out > 0 ? fmt::format(", {} were there already", left_out) : "",
      cases.empty() || options.keep_trust ? "" : ": each is used only where a rollout confirms it");
  return success;
}

/// Forgets what is missed least, until there are few enough.
int thin_bank(const MemoryOptions& options) {
  auto read = read_bank(options.file);
  if (!read.has_value()) {
    return refused(read.error());
  }
  ReadBank bank = std::move(read).value();
  const std::vector<match::CaseId> ids = memory::most_redundant(bank.cases, options.most);
  if (const auto problem = bank.store.forget(ids)) {
    return refused(*problem);
  }
  const std::size_t left = bank.cases.size() - ids.size();
  app::print("{}: {} cases forgotten, {} left{}\n", bank.store.name(), ids.size(), left,
             left > options.most ? ": nothing else is stood for by another" : "");
  return success;
}

/// Reads everything in the bank.
int verify_bank(const MemoryOptions& options) {
  const auto bank = read_bank(options.file);
  if (!bank.has_value()) {
    return refused(bank.error());
  }
  const std::vector<memory::Case>& cases = bank.value().cases;
  const auto digest = bank.value().store.digest();
  if (!digest.has_value()) {
    return refused(digest.error());
  }
  const std::string digest_text = fmt::format("{:016x}", digest.value());
  std::map<std::string_view, int> origins;
  std::map<std::string_view, int> trusts;
  std::map<std::string_view, int> best;
  for (const memory::Case& one : cases) {
    ++origins[name(one.origin)];
    ++trusts[name(one.trust)];
    ++best[name(one.best)];
  }
  if (options.as_json) {
    app::print_json(json{{"schema", "saca.memory_bank/1"},
                         {"file", bank.value().store.name()},
                         {"cases", cases.size()},
                         {"digest", digest_text},
                         {"origins", origins},
                         {"trust", trusts},
                         {"best", best}});
    return success;
  }
  const auto counted = [](const std::map<std::string_view, int>& counts) {
    std::string text;
    for (const auto& [what, count] : counts) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
    }
    return text;
  };
  app::print("{}: {} cases, all whole; digest {}\n", bank.value().store.name(), cases.size(),
             digest_text);
  if (!cases.empty()) {
    app::print("from   {}\ntrust  {}\nbest   {}\n", counted(origins), counted(trusts),
               counted(best));
  }
  return success;
}

}  // namespace

Result<std::vector<memory::Case>> read_cases(const std::string& file) {
  const auto text = formats::read_compressed(file, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  return memory::cases_from_text(text.value(), file);
}

Result<ReadBank> read_bank(const std::string& file) {
  auto store = memory::Store::open_existing(file);
  if (!store.has_value()) {
    return store.error();
  }
  memory::Store memory = std::move(store).value();
  auto cases = memory.all();
  if (!cases.has_value()) {
    return cases.error();
  }
  return ReadBank{std::move(memory), std::move(cases).value()};
}

Result<memory::Store> open_to_add(const std::string& file) {
  if (!memory::is_on_a_server(file)) {
    if (auto problem = long_work::make_folder_of(file)) {
      return *std::move(problem);
    }
  }
  return memory::Store::open(file);
}

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
