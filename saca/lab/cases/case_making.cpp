#include "saca/lab/cases/case_making.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "saca/base/core/fnv.h"
#include "saca/base/formats/json_reader.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/cases/case_stage.h"
#include "saca/lab/crash_records/facts.h"
#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/eval/suite.h"
#include "saca/lab/long_work/resumable_work.h"

namespace saca::cases {

std::string case_row_line(const CaseRow& row) {
  return nlohmann::json{{"family", row.family},
                        {"end", name(row.end)},
                        {"problem", row.problem},
                        {"case", row.made ? to_json(*row.made) : nlohmann::json(nullptr)}}
      .dump();
}

Result<CaseRow> case_row_from(const std::string& line) {
  const auto parsed = formats::parse_json(line);
  if (!parsed.has_value()) {
    return parsed.error();
  }
  std::optional<Error> problem;
  formats::JsonReader reader(parsed.value(), "", problem, "line");
  CaseRow row{.family = reader.text("family")};
  row.end = reader.word("end", crash_end_from, "how a search ended");
  row.problem = reader.text("problem");
  if (reader.has_value("case")) {
    auto made = crash_case_from_json(reader.any("case"));
    if (!made.has_value()) {
      return made.error();
    }
    row.made = std::move(made).value();
  }
  reader.refuse_others();
  if (problem) {
    return *problem;
  }
  return row;
}

CaseMaking::CaseMaking(const CaseMakingOptions& options, const CaseSources& sources,
                       CaseTools tools)
    : options_(options),
      sources_(sources),
      tools_(std::move(tools)),
      made_with_(encounter::made_with(tools_.forecast, *tools_.intent, tools_.car_name)) {}

CaseRow CaseMaking::row(std::size_t number) const {
  return number < sources_.prospects.size()
             ? row_of(sources_.prospects[number])
             : row_of(sources_.events[number - sources_.prospects.size()]);
}

std::uint64_t CaseMaking::digest() const {
  Fnv hash;
  for (const memory::MadeWith& one : made_with_) {
    hash.add(one.name + one.digest);
  }
  for (const CrashProspect& prospect : sources_.prospects) {
    hash.add(prospect.family.name);
    for (const auto& [key, range] : prospect.family.ranges) {
      hash.add(fmt::format("{} {} {} {}", key, range.min, range.max, range.source));
    }
  }
  for (const importers::HundredCarOutcome& event : sources_.events) {
    hash.add(scenario::write_scenario(event.rebuilt()->scenario));
  }
  return hash.value();
}

void CaseMaking::judge(CaseRow& row, CrashCase made, const scenario::Scenario& scenario) const {
  const scenario::Scenario world = case_world(scenario, options_.seed);
  const encounter::Stage stage = case_stage(world, tools_, options_.seed, made.record.name);
  eval::JudgingOptions judging = options_.judging;
  judging.seed = eval::encounter_seed(options_.seed, number_of_record(made.record.name));
  auto judged = eval::judged_encounter(stage, tools_.forecast, judging, made_with_);
  if (!judged.has_value()) {
    row.problem = made.record.name + ": " + judged.error().message;
  } else if (judged.value()) {
    made.grip = scenario.grip;
    made.judged = *std::move(judged).value();
    row.made = std::move(made);
  }
}

CaseRow CaseMaking::row_of(const CrashProspect& prospect) const {
  const crash_records::FarsCrash& crash = sources_.release.crashes[prospect.crash];
  const crash_records::FarsVehicle& ego = crash.vehicles[prospect.roles.ego];
  CaseRow row{.family = std::string(name(prospect.roles.family))};
  CrashFound found =
      find_crash(prospect.family, prospect.roles.struck, tools_.car_name, *tools_.forecast.car,
                 *tools_.forecast.harm,
                 {.seed = options_.seed, .most = static_cast<std::uint64_t>(options_.tries)});
  row.end = found.end;
  if (found.end != CrashEnd::happens) {
    return row;
  }
  const auto recorded_face = crash_records::face_of_impact(ego.impact);
  CrashCase made{.record = {.study = "FARS",
                            .name = prospect.family.name,
                            .state = sources_.codes.meaning("STATE", crash.id.state()),
                            .year = crash.id.year,
                            .number = crash.id.number},
                 .family = row.family,
                 .place = std::string(name(prospect.roles.place)),
                 .facts = crash_records::facts_of(crash, prospect.roles, sources_.codes),
                 .kind = std::string(name(prospect.family.kind)),
                 .seed = options_.seed,
                 .sample = found.sample,
                 .without = found.as_written.contact,
                 .as_recorded = true,
                 .impact_agrees = recorded_face ? std::optional(*recorded_face ==
                                                                found.as_written.contact->ego_face)
                                                : std::nullopt};
  made.ranges.reserve(prospect.family.ranges.size());
  for (const auto& [key, range] : prospect.family.ranges) {
    made.ranges.push_back({key, range.min, range.max, range.source});
  }
  judge(row, std::move(made), found.scenario);
  return row;
}

CaseRow CaseMaking::row_of(const importers::HundredCarOutcome& event) const {
  scenario::Scenario scenario = event.rebuilt()->scenario;
  scenario.car = tools_.car_name;
  const auto as_written =
      eval::trigger_as_written(scenario, *tools_.forecast.car, *tools_.forecast.harm);
  CaseRow row{.family = "100car",
              .end = !as_written           ? CrashEnd::never_triggers
                     : as_written->contact ? CrashEnd::happens
                                           : CrashEnd::does_not_happen};
  CrashCase made{.record = {.study = "100-Car", .name = scenario.name, .number = event.event},
                 .family = row.family,
                 .facts = {{"crash", "severity", std::nullopt, event.severity},
                           {"ego", "driver", std::nullopt, scenario.driver},
                           {"crash", "notes", std::nullopt, scenario.notes}},
                 .without = as_written ? as_written->contact : std::nullopt,
                 .as_recorded = as_written && as_written->contact.has_value()};
  judge(row, std::move(made), scenario);
  return row;
}

Result<std::optional<std::vector<CaseRow>>> case_rows(const CaseMaking& making,
                                                      const CaseWork& work) {
  return long_work::rows_of<CaseRow>(
      {.journal = work.journal,
       .title = fmt::format("{} ({:016x})", work.title, making.digest()),
       .progress = "cases of crashes",
       .unit = "records",
       .count = making.size(),
       .display = work.display,
       .threads = work.threads,
       .row = [&](std::size_t number) { return making.row(number); },
       .line_of = case_row_line,
       .row_from = case_row_from});
}

}  // namespace saca::cases
