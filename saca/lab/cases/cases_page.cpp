#include "saca/lab/cases/cases_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <random>
#include <utility>

#include "saca/lab/cases/case_card.h"
#include "saca/lab/scenario/chance.h"

namespace saca::cases {

using manoeuvre::PolicyId;

Result<std::vector<CrashCase>> shown_cases(const std::vector<CrashCase>& cases,
                                           const ShownOptions& options) {
  std::vector<CrashCase> asked_for;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(asked_for), [&](const auto& one) {
    return (options.family.empty() || one.family == options.family) &&
           (options.record.empty() || one.record.name == options.record);
  });
  std::mt19937_64 rng = scenario::generator(options.seed, asked_for.size());
  std::vector<CrashCase> drawn;
  drawn.reserve(static_cast<std::size_t>(options.count));
  std::sample(asked_for.begin(), asked_for.end(), std::back_inserter(drawn), options.count, rng);
  if (drawn.empty()) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want cases{}{}, got none of {}", options.file,
                             options.family.empty() ? "" : " of the family " + options.family,
                             options.record.empty() ? "" : " of the record " + options.record,
                             cases.size())};
  }
  return drawn;
}

Result<report::SuitePage> cases_page(const std::vector<CrashCase>& shown,
                                     const std::vector<CrashCase>& all, const ShownOptions& options,
                                     const CaseTools& tools) {
  report::SuitePage page{
      .title = "Cases of recorded crashes",
      .lines = {fmt::format("{} of {} cases, drawn with seed {}. Each was made of a record of a "
                            "fatal crash, or of an emergency of the 100-Car study.",
                            shown.size(), all.size(), options.seed),
                "The left picture shows what happens from the trigger on when lane and speed are "
                "kept, the right one the plan that harms least over draws; both with nothing left "
                "to chance."},
      .tables = {cases_table(all)},
      .gallery_heading = "Cases"};
  page.gallery.reserve(shown.size());
  for (const CrashCase& one : shown) {
    auto card = case_card(one, tools);
    if (!card.has_value()) {
      return card.error();
    }
    page.gallery.push_back(std::move(card).value());
  }
  page.footnotes = {fmt::format("saca cases show {} --count {} --seed {}{}{}", options.file,
                                options.count, options.seed,
                                options.family.empty() ? "" : " --family " + options.family,
                                options.record.empty() ? "" : " --record " + options.record)};
  return page;
}

report::PageTable cases_table(const std::vector<CrashCase>& cases) {
  std::map<std::string, std::map<PolicyId, int>> best;
  std::map<std::string, int> counts;
  for (const CrashCase& one : cases) {
    ++counts[one.family];
    ++best[one.family][one.judged.one.best];
  }
  report::PageTable table{.heading = "Families, and which policy is the best in them"};
  table.columns = {"cases"};
  for (const PolicyId policy : manoeuvre::all_policies) {
    table.columns.emplace_back(name(policy));
  }
  for (const auto& [family, count] : counts) {
    report::PageTable::Row row{.name = family, .cells = {fmt::format("{}", count)}};
    for (const PolicyId policy : manoeuvre::all_policies) {
      row.cells.push_back(fmt::format("{}", best[family][policy]));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

nlohmann::json cases_page_json(const std::vector<CrashCase>& shown, const std::string& file,
                               const std::string& page, std::size_t all) {
  nlohmann::json records = nlohmann::json::array();
  for (const CrashCase& one : shown) {
    records.push_back(one.record.name);
  }
  return {{"schema", "saca.cases_page/1"},
          {"file", file},
          {"page", page},
          {"cases", all},
          {"shown", std::move(records)}};
}

}  // namespace saca::cases
