#include "saca/lab/banks/case_build.h"

#include <fmt/core.h>

#include <array>
#include <utility>

#include "saca/lab/eval/trigger_case.h"
#include "saca/lab/long_work/resumable_work.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::banks {
namespace {

void add_case_at_trigger(EncounterCases& gained, const encounter::Stage& stage,
                         const CaseTools& tools) {
  auto one = eval::case_at_trigger(stage, tools.forecast, tools.draws, tools.made_with);
  if (!one.has_value()) {
    gained.problem = one.error().message;
  } else if (one.value()) {
    gained.items.push_back(*std::move(one).value());
  }
}

/// Of how many cases each policy is the best, by PolicyId.
std::array<int, manoeuvre::num_policies> best_of(const CaseBuild& build) {
  std::array<int, manoeuvre::num_policies> best{};
  for (const memory::Case& one : build.cases) {
    ++best.at(manoeuvre::index(one.best));
  }
  return best;
}

}  // namespace

EncounterCases cases_of(const suites::PlayedEncounter& encounter, const CaseTools& tools,
                        TwinCases twins) {
  const suites::Perceiver perceiver{tools.forecast.car, tools.forecast.harm, tools.intent};
  EncounterCases gained;
  add_case_at_trigger(gained, encounter.stage(perceiver), tools);
  if (encounter.twin && twins == TwinCases::made) {
    add_case_at_trigger(gained, encounter.twin_stage(perceiver), tools);
  }
  return gained;
}

Result<std::optional<CaseBuild>> build_cases(const CaseSource& source, const CaseTools& tools,
                                             const CaseWork& work) {
  const auto row_of = [&](std::size_t number) {
    const auto played = suites::played_encounter(source.at, source.play, number);
    return played.has_value() ? cases_of(played.value(), tools, source.twins)
                              : EncounterCases{{}, played.error().message};
  };
  auto rows = long_work::rows_of<EncounterCases>({.journal = work.journal,
                                                  .title = work.title,
                                                  .progress = work.progress,
                                                  .unit = "encounters",
                                                  .count = source.count,
                                                  .display = work.display,
                                                  .threads = work.threads,
                                                  .row = row_of,
                                                  .line_of = long_work::items_line<memory::Case>,
                                                  .row_from = [](const std::string& line) {
                                                    return long_work::items_row<memory::Case>(
                                                        line, memory::case_from_json);
                                                  }});
  if (!rows.has_value()) {
    return rows.error();
  }
  if (!rows.value()) {
    return std::optional<CaseBuild>();
  }
  CaseBuild build{.num_encounters = rows.value()->size(), .cases = {}, .problems = {}};
  auto [cases, problems] = long_work::all_items(*std::move(rows).value());
  build.cases = std::move(cases);
  build.problems = std::move(problems);
  for (std::size_t i = 0; i < build.cases.size(); ++i) {
    build.cases[i].id = static_cast<match::CaseId>(i + 1);
  }
  return std::optional(std::move(build));
}

nlohmann::json json_of(const CaseBuild& build, const std::string& command,
                       const std::string& version) {
  nlohmann::json out{{"meta.command", "saca " + command},
                     {"meta.version", version},
                     {"memory.num_encounters", build.num_encounters},
                     {"memory.num_cases", build.cases.size()},
                     {"memory.num_failed", build.problems.size()}};
  const auto best = best_of(build);
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    out[fmt::format("memory.best.{}", name(policy))] = best.at(manoeuvre::index(policy));
  }
  return out;
}

std::string text_of(const CaseBuild& build, const std::string& file) {
  std::string text = fmt::format("{}: {} cases of {} encounters; best", file, build.cases.size(),
                                 build.num_encounters);
  const auto best = best_of(build);
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    text += fmt::format(" {} {}", name(policy), best.at(manoeuvre::index(policy)));
  }
  return text + "\n";
}

}  // namespace saca::banks
