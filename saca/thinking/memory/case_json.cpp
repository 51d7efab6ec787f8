#include "saca/thinking/memory/case_json.h"

#include <cstddef>
#include <limits>
#include <set>
#include <utility>

#include "saca/base/formats/json_lines.h"
#include "saca/base/formats/json_reader.h"
#include "saca/thinking/memory/scene_json.h"

namespace saca::memory {
namespace {

using nlohmann::json;
using Reader = formats::JsonReader;

constexpr std::string_view case_schema = "saca.case/1";
constexpr std::string_view file_schema = "saca.cases/1";
constexpr auto most_counted = static_cast<std::uint64_t>(std::numeric_limits<int>::max());

template <class Value>
json optional_json(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json harms_json(const PolicyHarms& harms) {
  json list = json::array();
  for (const std::optional<double>& harm : harms) {
    list.push_back(optional_json(harm));
  }
  return list;
}

json inputs_json(const std::vector<MadeWith>& inputs) {
  json list = json::array();
  for (const MadeWith& one : inputs) {
    list.push_back({{"what", one.what}, {"name", one.name}, {"digest", one.digest}});
  }
  return list;
}

std::optional<PolicyHarms> read_harms(Reader& reader, const char* key) {
  PolicyHarms harms;
  const json* list = reader.list(key, harms.size());
  if (list != nullptr && list->size() != harms.size()) {
    reader.reject(key, "want one entry per policy, 8, got " + std::to_string(list->size()));
    return std::nullopt;
  }
  for (std::size_t i = 0; list != nullptr && i < harms.size(); ++i) {
    const json& harm = (*list)[i];
    if (harm.is_number()) {
      harms[i] = harm.get<double>();
    } else if (!harm.is_null()) {
      reader.reject(key, "want numbers, or null, got " + Reader::shown(harm));
    }
  }
  return harms;
}

std::vector<double> read_risks(Reader& reader) {
  const json* list = reader.list("risks", world::max_actors);
  std::vector<double> risks(list == nullptr ? 0 : list->size());
  for (std::size_t i = 0; i < risks.size(); ++i) {
    if (!(*list)[i].is_number()) {
      reader.reject("risks", "want numbers, got " + Reader::shown((*list)[i]));
      break;
    }
    risks[i] = (*list)[i].get<double>();
  }
  return risks;
}

std::vector<std::string> read_lessons(Reader& reader) {
  std::vector<std::string> lessons;
  const json* list = reader.list("lessons", most_texts);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    if (!(*list)[i].is_string()) {
      reader.reject("lessons", "want texts, got " + Reader::shown((*list)[i]));
      break;
    }
    lessons.push_back((*list)[i].get<std::string>());
  }
  return lessons;
}

std::vector<MadeWith> read_inputs(Reader& reader) {
  std::vector<MadeWith> inputs;
  const json* list = reader.list("made_with", most_texts);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    Reader one = reader.element("made_with", *list, i);
    inputs.push_back({one.text("what"), one.text("name"), one.text("digest")});
    one.refuse_others();
  }
  return inputs;
}

void read_details_into(Reader& reader, Case& one) {
  if (reader.has("origin")) {
    one.origin = reader.word("origin", origin_from, "own, simulation, recording or expert");
  }
  if (reader.has("trust")) {
    one.trust = reader.word("trust", trust_from, "trusted, unchecked or quarantined");
  }
  if (reader.has("count")) {
    one.count = static_cast<int>(reader.integer("count", most_counted));
  }
  if (reader.has("worst_harm")) {
    one.worst_harm = reader.number("worst_harm");
  }
  if (reader.has("intentions")) {
    const json* list = reader.list("intentions", world::max_actors);
    one.intentions.resize(list == nullptr ? 0 : list->size());
    for (std::size_t i = 0; i < one.intentions.size(); ++i) {
      reader.numbers("intentions", *list, i, one.intentions[i]);
    }
  }
  if (reader.has("risks")) {
    one.risks = read_risks(reader);
  }
  if (reader.has("told")) {
    one.told = read_harms(reader, "told");
  }
  if (reader.has("happened")) {
    one.happened = read_harms(reader, "happened");
  }
  if (reader.has("draws")) {
    one.draws = static_cast<int>(reader.integer("draws", most_counted));
  }
  if (reader.has("lessons")) {
    one.lessons = read_lessons(reader);
  }
  if (reader.has("made_with")) {
    one.made_with = read_inputs(reader);
  }
  reader.refuse_others();
}

/// A policy is a number here: what the tables of a memory bank have.
manoeuvre::PolicyId read_policy(Reader& reader, const char* key) {
  return manoeuvre::all_policies.at(reader.integer(key, manoeuvre::num_policies - 1));
}

std::optional<double> read_optional(Reader& reader, const char* key) {
  return reader.has_value(key) ? std::optional(reader.number(key)) : std::nullopt;
}

}  // namespace

json details_json(const Case& one) {
  json details = json::object();
  if (one.origin != Origin::own) {
    details["origin"] = name(one.origin);
  }
  if (one.trust != Trust::trusted) {
    details["trust"] = name(one.trust);
  }
  if (one.count != 1) {
    details["count"] = one.count;
  }
  if (one.worst_harm) {
    details["worst_harm"] = *one.worst_harm;
  }
  if (!one.intentions.empty()) {
    details["intentions"] = one.intentions;
  }
  if (!one.risks.empty()) {
    details["risks"] = one.risks;
  }
  if (one.told) {
    details["told"] = harms_json(*one.told);
  }
  if (one.happened) {
    details["happened"] = harms_json(*one.happened);
  }
  if (one.draws != 1) {
    details["draws"] = one.draws;
  }
  if (!one.lessons.empty()) {
    details["lessons"] = one.lessons;
  }
  if (!one.made_with.empty()) {
    details["made_with"] = inputs_json(one.made_with);
  }
  return details;
}

std::optional<Error> read_details(const json& details, Case& one) {
  std::optional<Error> problem;
  Reader reader(details, "", problem, "details");
  read_details_into(reader, one);
  return problem;
}

json to_json(const Case& one) {
  return {{"schema", case_schema},
          {"id", one.id},
          {"policy", manoeuvre::index(one.plan.policy)},
          {"target_speed_mps", optional_json(one.plan.target_speed)},
          {"strength", optional_json(one.plan.strength)},
          {"best_policy", manoeuvre::index(one.best)},
          {"harm", one.harm},
          {"best_harm", one.best_harm},
          {"collision_loss", one.collision_loss},
          {"review", one.review},
          {"source", one.source},
          {"details", details_json(one)},
          {"scene", to_json(one.scene)}};
}

Result<Case> case_from_json(const json& document) {
  std::optional<Error> problem;
  Reader reader(document, "", problem, "case");
  Case one;
  reader.schema(case_schema);
  one.id = static_cast<match::CaseId>(
      reader.integer("id", static_cast<std::uint64_t>(std::numeric_limits<match::CaseId>::max())));
  one.plan.policy = read_policy(reader, "policy");
  one.plan.target_speed = read_optional(reader, "target_speed_mps");
  one.plan.strength = read_optional(reader, "strength");
  one.best = read_policy(reader, "best_policy");
  one.harm = reader.number("harm");
  one.best_harm = reader.number("best_harm");
  one.collision_loss = reader.number("collision_loss");
  one.review = reader.text("review");
  one.source = reader.text("source");
  const json& scene = reader.any("scene");
  if (!problem) {
    Result<world::Scene> read = scene_from_json(scene);
    if (read.has_value()) {
      one.scene = std::move(read).value();
    } else {
      reader.reject("scene", read.error().message);
    }
  }
  Reader details = reader.object("details");
  read_details_into(details, one);
  reader.refuse_others();
  if (!problem) {
    if (const auto broken = broken_rule(one)) {
      reader.reject(broken->key, broken->why);
    }
  }
  if (problem) {
    return *problem;
  }
  return one;
}

std::string cases_text(std::span<const Case> cases) {
  std::string text = formats::first_json_line(file_schema, "cases", cases.size());
  for (const Case& one : cases) {
    text += to_json(one).dump() + '\n';
  }
  return text;
}

Result<std::vector<Case>> cases_from_text(std::string_view text, const std::string& name) {
  std::vector<Case> cases;
  std::set<match::CaseId> ids;
  const auto problem = formats::read_json_lines(
      text, name, file_schema, "cases", [&](const json& document) -> std::optional<std::string> {
        Result<Case> one = case_from_json(document);
        if (!one.has_value()) {
          return one.error().message;
        }
        if (!ids.insert(one.value().id).second) {
          return "id: want each once, got " + std::to_string(one.value().id) + " a second time";
        }
        cases.push_back(std::move(one).value());
        return std::nullopt;
      });
  if (problem) {
    return *problem;
  }
  return cases;
}

}  // namespace saca::memory
