#include "saca/lab/cases/crash_case.h"

#include <fmt/core.h>

#include <array>
#include <limits>
#include <utility>

#include "saca/base/core/names.h"
#include "saca/base/formats/json_lines.h"
#include "saca/base/formats/json_reader.h"
#include "saca/lab/encounter/verdict_json.h"
#include "saca/lab/families/family.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::cases {
namespace {

using nlohmann::json;
using Reader = formats::JsonReader;

constexpr std::string_view line_schema = "saca.crash_case/1";
constexpr std::string_view lines_schema = "saca.crash_cases/1";
constexpr std::size_t most_entries = 200;
constexpr auto largest_int = static_cast<std::uint64_t>(std::numeric_limits<int>::max());

template <class Value>
json or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

std::optional<collision::Face> face_named(std::string_view word) {
  for (const auto face : {collision::Face::front, collision::Face::left, collision::Face::right,
                          collision::Face::rear}) {
    if (name(face) == word) {
      return face;
    }
  }
  return std::nullopt;
}

json without_json(const std::optional<eval::WithoutAvoidance>& without) {
  if (!without) {
    return nullptr;
  }
  return {{"met", without->met},
          {"first_actor", without->first_actor},
          {"ego_face", name(without->ego_face)},
          {"other_face", name(without->other_face)},
          {"relative_speed_mps", without->relative_speed},
          {"after_s", without->after}};
}

eval::WithoutAvoidance read_without(Reader reader) {
  constexpr std::string_view faces = "front, left, right or rear";
  eval::WithoutAvoidance without{.met = reader.text("met"),
                                 .first_actor = reader.flag("first_actor"),
                                 .ego_face = reader.word("ego_face", face_named, faces),
                                 .other_face = reader.word("other_face", face_named, faces),
                                 .relative_speed = reader.number("relative_speed_mps"),
                                 .after = reader.number("after_s")};
  reader.refuse_others();
  return without;
}

manoeuvre::Plan read_plan(Reader& reader) {
  manoeuvre::Plan plan;
  plan.policy = manoeuvre::all_policies.at(reader.integer("policy", manoeuvre::num_policies - 1));
  if (reader.text("name") != name(plan.policy)) {
    reader.reject("name", "want the policy's, " + std::string(name(plan.policy)));
  }
  for (const auto& [key, value] :
       {std::pair{"target_speed_mps", &plan.target_speed}, {"strength", &plan.strength}}) {
    if (reader.has_value(key)) {
      *value = reader.number(key);
    }
  }
  return plan;
}

json record_json(const RecordId& record) {
  return {{"study", record.study},
          {"name", record.name},
          {"state", or_null(record.state)},
          {"year", or_null(record.year)},
          {"number", record.number}};
}

RecordId read_record(Reader reader) {
  RecordId record{.study = reader.text("study"), .name = reader.text("name")};
  if (reader.has_value("state")) {
    record.state = reader.text("state");
  }
  if (reader.has_value("year")) {
    record.year = static_cast<int>(reader.integer("year", largest_int));
  }
  record.number = static_cast<std::int64_t>(reader.integer("number", largest_int));
  reader.refuse_others();
  return record;
}

json judged_json(const eval::JudgedEncounter& judged, json& document) {
  json plans = json::array();
  for (const eval::VerdictPlan& plan : judged.plans) {
    json entry = encounter::plan_json(plan.plan);
    entry["harm"] = plan.harm;
    entry["contact"] = plan.contact;
    entry["admissible"] = plan.admissible;
    plans.push_back(std::move(entry));
  }
  json happened = json::array();
  for (const auto& one : judged.happened) {
    json entry;
    if (one) {
      entry = encounter::plan_json(one->plan);
      entry["harm"] = one->harm.value;
      entry["harm_lo"] = one->harm.low;
      entry["harm_hi"] = one->harm.high;
      entry["contact"] = one->contact;
    }
    happened.push_back(std::move(entry));
  }
  document["plans"] = std::move(plans);
  document["admissible_harm"] = or_null(judged.admissible_harm);
  document["speaks_for"] = encounter::plan_json(judged.speaks_for);
  document["happened"] = std::move(happened);
  if (judged.driver) {
    document["driver"] = manoeuvre::index(*judged.driver);
  }
  document["case"] = memory::to_json(judged.one);
  return document;
}

void read_plans(Reader& reader, eval::JudgedEncounter& judged) {
  const json* const plans = reader.list("plans", most_entries);
  for (std::size_t i = 0; plans != nullptr && i < plans->size(); ++i) {
    Reader entry = reader.element("plans", *plans, i);
    judged.plans.push_back({.plan = read_plan(entry),
                            .harm = entry.number("harm"),
                            .contact = entry.number("contact"),
                            .admissible = entry.flag("admissible")});
    entry.refuse_others();
  }
  if (reader.has_value("admissible_harm")) {
    judged.admissible_harm = reader.number("admissible_harm");
  }
  Reader speaks_for = reader.object("speaks_for");
  judged.speaks_for = read_plan(speaks_for);
  speaks_for.refuse_others();
}

void read_happened(Reader& reader, eval::JudgedEncounter& judged) {
  const json* const happened = reader.list("happened", manoeuvre::num_policies);
  if (happened != nullptr && happened->size() != manoeuvre::num_policies) {
    reader.reject("happened", fmt::format("want one entry per policy, {}, got {}",
                                          manoeuvre::num_policies, happened->size()));
    return;
  }
  for (std::size_t i = 0; happened != nullptr && i < happened->size(); ++i) {
    if ((*happened)[i].is_null()) {
      continue;
    }
    Reader entry = reader.element("happened", *happened, i);
    judged.happened.at(i) = eval::PolicyOverDraws{
        .plan = read_plan(entry),
        .harm = {entry.number("harm"), entry.number("harm_lo"), entry.number("harm_hi")},
        .contact = entry.number("contact")};
    entry.refuse_others();
  }
}

void read_lists(Reader& reader, CrashCase& one) {
  const json* const facts = reader.list("facts", most_entries);
  for (std::size_t i = 0; facts != nullptr && i < facts->size(); ++i) {
    Reader entry = reader.element("facts", *facts, i);
    crash_records::Fact fact{.about = entry.text("about"), .key = entry.text("key")};
    if (entry.has_value("code")) {
      fact.code = static_cast<int>(entry.integer("code", largest_int));
    }
    fact.words = entry.text("words");
    entry.refuse_others();
    one.facts.push_back(std::move(fact));
  }
  const json* const ranges = reader.list("ranges", most_entries);
  for (std::size_t i = 0; ranges != nullptr && i < ranges->size(); ++i) {
    Reader entry = reader.element("ranges", *ranges, i);
    one.ranges.push_back({.key = entry.text("key"),
                          .min = entry.number("min"),
                          .max = entry.number("max"),
                          .source = entry.text("source")});
    entry.refuse_others();
  }
}

}  // namespace

Result<families::FamilySample> drawn_again(const CrashCase& one, std::string_view car,
                                           const world::Footprint& ego,
                                           const std::optional<families::FamilyCues>& cues) {
  const auto kind = one.kind ? families::family_kind_from(*one.kind) : std::nullopt;
  if (!kind) {
    return Error{Error::Code::out_of_range,
                 one.record.name + ": want an encounter that was drawn from a family, got " +
                     (one.kind ? "one of the unknown kind " + *one.kind : "a recording")};
  }
  families::Family family{.name = one.record.name, .kind = *kind};
  family.cues = cues;
  for (const RecordRange& range : one.ranges) {
    family.ranges[range.key] = {range.min, range.max, range.source};
  }
  for (const auto& keys : {families::own_keys(*kind), families::surroundings_keys()}) {
    for (const std::string_view key : keys) {
      if (family.ranges.find(key) == family.ranges.end()) {
        return Error{Error::Code::malformed,
                     fmt::format("{}: ranges: want one for {}, got none", one.record.name, key)};
      }
    }
  }
  return families::sample(family, one.seed, one.sample, car, ego);
}

json to_json(const CrashCase& one) {
  json facts = json::array();
  for (const crash_records::Fact& fact : one.facts) {
    facts.push_back({{"about", fact.about},
                     {"key", fact.key},
                     {"code", or_null(fact.code)},
                     {"words", fact.words}});
  }
  json ranges = json::array();
  for (const RecordRange& range : one.ranges) {
    ranges.push_back(
        {{"key", range.key}, {"min", range.min}, {"max", range.max}, {"source", range.source}});
  }
  json document{{"schema", line_schema},
                {"record", record_json(one.record)},
                {"family", one.family},
                {"place", or_null(one.place)},
                {"facts", std::move(facts)},
                {"kind", or_null(one.kind)},
                {"ranges", std::move(ranges)},
                {"seed", one.seed},
                {"sample", one.sample},
                {"grip", one.grip},
                {"without_avoidance", without_json(one.without)},
                {"as_recorded", one.as_recorded},
                {"impact_agrees", or_null(one.impact_agrees)}};
  return judged_json(one.judged, document);
}

Result<CrashCase> crash_case_from_json(const json& document) {
  std::optional<Error> problem;
  Reader reader(document, "", problem, "case of a crash");
  CrashCase one;
  reader.schema(line_schema);
  one.record = read_record(reader.object("record"));
  one.family = reader.text("family");
  if (reader.has_value("place")) {
    one.place = reader.text("place");
  }
  read_lists(reader, one);
  if (reader.has_value("kind")) {
    one.kind = reader.text("kind");
  }
  one.seed = reader.integer("seed");
  one.sample = reader.integer("sample");
  one.grip = reader.number("grip");
  if (reader.has_value("without_avoidance")) {
    one.without = read_without(reader.object("without_avoidance"));
  }
  one.as_recorded = reader.flag("as_recorded");
  if (reader.has_value("impact_agrees")) {
    one.impact_agrees = reader.flag("impact_agrees");
  }
  read_plans(reader, one.judged);
  read_happened(reader, one.judged);
  if (reader.has("driver")) {
    one.judged.driver = manoeuvre::policy_from(
        static_cast<int>(reader.integer("driver", manoeuvre::num_policies - 1)));
  }
  const json& its_case = reader.any("case");
  reader.refuse_others();
  if (!problem) {
    auto read = memory::case_from_json(its_case);
    if (!read.has_value()) {
      reader.reject("case", read.error().message);
    } else {
      one.judged.one = std::move(read).value();
    }
  }
  if (problem) {
    return *problem;
  }
  return one;
}

std::string crash_cases_text(std::span<const CrashCase> cases) {
  std::string text = formats::first_json_line(lines_schema, "cases", cases.size());
  for (const CrashCase& one : cases) {
    text += to_json(one).dump() + '\n';
  }
  return text;
}

Result<std::vector<CrashCase>> crash_cases_from_text(std::string_view text,
                                                     const std::string& name) {
  std::vector<CrashCase> cases;
  const auto problem = formats::read_json_lines(
      text, name, lines_schema, "cases", [&](const json& document) -> std::optional<std::string> {
        auto one = crash_case_from_json(document);
        if (!one.has_value()) {
          return one.error().message;
        }
        cases.push_back(std::move(one).value());
        return std::nullopt;
      });
  if (problem) {
    return *problem;
  }
  return cases;
}

}  // namespace saca::cases
