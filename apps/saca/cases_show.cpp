#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/cases_commands.h"
#include "apps/saca/cases_pictures.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/formats/compressed_text.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/scenario/chance.h"

namespace saca::app {
namespace {

using eval::CrashCase;
using nlohmann::json;

struct CasesShowOptions {
  std::string file;
  std::string car = "compact_rwd_ev";
  std::string family;  ///< empty: all
  std::string record;  ///< empty: drawn
  int count = 60;
  std::uint64_t seed = 1;
  std::string output = "runs/crash_cases.html";
  bool as_json = false;
};

bool is_asked_for(const CrashCase& one, const CasesShowOptions& options) {
  return (options.family.empty() || one.family == options.family) &&
         (options.record.empty() || one.record.name == options.record);
}

/// So many of them, drawn evenly, in the file's order.
std::vector<CrashCase> drawn_cases(std::vector<CrashCase> cases, const CasesShowOptions& options) {
  std::erase_if(cases, [&](const CrashCase& one) { return !is_asked_for(one, options); });
  std::mt19937_64 rng = scenario::generator(options.seed, cases.size());
  std::vector<CrashCase> drawn;
  drawn.reserve(static_cast<std::size_t>(options.count));
  std::sample(cases.begin(), cases.end(), std::back_inserter(drawn), options.count, rng);
  return drawn;
}

int show_cases(const CasesShowOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto text = formats::read_compressed(options.file, many_bytes);
  if (!text.has_value()) {
    return refused(text.error());
  }
  const auto cases = eval::crash_cases_from_text(text.value(), options.file);
  if (!cases.has_value()) {
    return refused(cases.error());
  }
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const std::vector<CrashCase> drawn = drawn_cases(cases.value(), options);
  if (drawn.empty()) {
    return refused({Error::Code::out_of_range,
                    fmt::format("{}: want cases{}{}, got none of {}", options.file,
                                options.family.empty() ? "" : " of the family " + options.family,
                                options.record.empty() ? "" : " of the record " + options.record,
                                cases.value().size())});
  }
  report::SuitePage page{
      .title = "Cases of recorded crashes",
      .lines = {fmt::format("{} of {} cases, drawn with seed {}. Each was made of a record of a "
                            "fatal crash, or of an emergency of the 100-Car study.",
                            drawn.size(), cases.value().size(), options.seed),
                "The left picture shows what happens from the trigger on when lane and speed are "
                "kept, the right one the plan that harms least over draws; both with nothing left "
                "to chance."},
      .tables = {cases_table(cases.value())},
      .gallery_heading = "Cases"};
  page.gallery.reserve(drawn.size());
  for (const CrashCase& one : drawn) {
    auto card = case_card(one, inputs.value());
    if (!card.has_value()) {
      return refused(card.error());
    }
    page.gallery.push_back(std::move(card).value());
  }
  page.footnotes = {fmt::format("saca cases show {} --count {} --seed {}{}{}", options.file,
                                options.count, options.seed,
                                options.family.empty() ? "" : " --family " + options.family,
                                options.record.empty() ? "" : " --record " + options.record)};
  if (const auto problem = long_work::write_output(options.output, report::suite_page(page))) {
    return refused(*problem);
  }
  if (options.as_json) {
    json records = json::array();
    for (const CrashCase& one : drawn) {
      records.push_back(one.record.name);
    }
    app::print_json(json{{"schema", "saca.cases_page/1"},
                         {"file", options.file},
                         {"page", options.output},
                         {"cases", cases.value().size()},
                         {"shown", records}});
  } else {
    app::print("{}: {} of {} cases\n", options.output, drawn.size(), cases.value().size());
  }
  return success;
}

}  // namespace

void add_cases_show(CLI::App& cases, int& exit_code) {
  CLI::App* const command =
      cases.add_subcommand("show", "Cases with their pictures, facts, assumptions and harms");
  const auto options = std::make_shared<CasesShowOptions>();
  command->add_option("FILE", options->file, "What `build` wrote")->required();
  command->add_option("--count", options->count, "How many are drawn")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "By which they are drawn")->capture_default_str();
  command->add_option("--family", options->family, "Only of this family");
  command->add_option("--record", options->record, "Only of this record, e.g. fars_2016_40001");
  command->add_option("--car", options->car, "That they were made for")->capture_default_str();
  command->add_option("--output,-o", options->output, "The page (HTML)")->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = show_cases(*options); });
}

}  // namespace saca::app
