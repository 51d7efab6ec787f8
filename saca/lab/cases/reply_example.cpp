#include "saca/lab/cases/reply_example.h"

#include <random>
#include <utility>

#include "saca/base/core/fnv.h"
#include "saca/base/core/names.h"
#include "saca/base/formats/json_reader.h"
#include "saca/lab/eval/trigger_case.h"
#include "saca/thinking/language_model/expert.h"
#include "saca/thinking/language_model/expert_choice.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/preview/preview.h"

namespace saca::cases {
namespace {

using nlohmann::json;

constexpr std::string_view example_schema = "saca.reply_example/1";
constexpr std::array<std::string_view, 3> set_names{"train", "calibration", "test"};

json harms_json(const memory::PolicyHarms& harms) {
  json list = json::array();
  for (const std::optional<double>& harm : harms) {
    list.push_back(harm ? json(*harm) : json(nullptr));
  }
  return list;
}

memory::PolicyHarms read_harms(formats::JsonReader& reader, std::string_view key) {
  memory::PolicyHarms harms;
  const json* const list = reader.list(key, harms.size());
  if (list == nullptr) {
    return harms;
  }
  if (list->size() != harms.size()) {
    reader.reject(key, "want 8 harms, got " + std::to_string(list->size()));
    return harms;
  }
  for (std::size_t k = 0; k < harms.size(); ++k) {
    const json& value = (*list)[k];
    const bool is_harm = value.is_number() && value.get<double>() >= 0.0;
    if (!is_harm && !value.is_null()) {
      reader.reject(key, "want harms >= 0 or null, got " + formats::JsonReader::shown(value));
    } else if (is_harm) {
      harms[k] = value.get<double>();
    }
  }
  return harms;
}

}  // namespace

std::string_view name(ExampleSet set) {
  return name_of(set, set_names);
}

std::optional<ExampleSet> example_set_from(std::string_view name) {
  return value_from<ExampleSet>(name, set_names);
}

ExampleSet set_of_record(std::string_view record) {
  Fnv hash;
  hash.add(record);
  // The last bits of this hash of names that differ in their last digits are no lottery: the first
  // are.
  const std::uint64_t ticket = (hash.value() >> 40U) % 20U;
  return ticket < 3 ? ExampleSet::test : ticket < 6 ? ExampleSet::calibration : ExampleSet::train;
}

json to_json(const ReplyExample& example) {
  json admissible = json::array();
  for (std::size_t k = 0; k < example.admissible.size(); ++k) {
    if (example.admissible.test(k)) {
      admissible.push_back(k);
    }
  }
  json document{{"schema", example_schema},
                {"record", example.record},
                {"family", example.family},
                {"twin", example.is_twin},
                {"set", name(example.set)},
                {"prompt", example.prompt},
                {"reply", example.reply},
                {"choice", manoeuvre::index(example.choice)},
                {"admissible", std::move(admissible)},
                {"forecast", harms_json(example.forecast)},
                {"known", harms_json(example.known)}};
  if (example.by_table) {
    document["by_table"] = harms_json(*example.by_table);
  }
  return document;
}

Result<ReplyExample> reply_example_from_json(const json& document) {
  std::optional<Error> problem;
  formats::JsonReader reader(document, "", problem, "example of a reply");
  ReplyExample example;
  reader.schema(example_schema);
  example.record = reader.text("record");
  example.family = reader.text("family");
  example.is_twin = reader.flag("twin");
  example.set = reader.word("set", example_set_from, "train, calibration or test");
  example.prompt = reader.text("prompt");
  example.reply = reader.text("reply");
  constexpr std::size_t last = manoeuvre::num_policies - 1;
  example.choice = manoeuvre::policy_from(static_cast<int>(reader.integer("choice", last))).value();
  if (const json* const list = reader.list("admissible", manoeuvre::num_policies)) {
    for (const json& value : *list) {
      if (!value.is_number_unsigned() || value.get<std::size_t>() > last) {
        reader.reject("admissible",
                      "want policies from 0 to 7, got " + formats::JsonReader::shown(value));
      } else {
        example.admissible.set(value.get<std::size_t>());
      }
    }
  }
  example.forecast = read_harms(reader, "forecast");
  example.known = read_harms(reader, "known");
  if (reader.has("by_table")) {
    example.by_table = read_harms(reader, "by_table");
  }
  reader.refuse_others();
  if (problem) {
    return *problem;
  }
  return example;
}

json chat_json(const ReplyExample& example, std::string_view system) {
  return {{"messages", json::array({{{"role", "system"}, {"content", system}},
                                    {{"role", "user"}, {"content", example.prompt}},
                                    {{"role", "assistant"}, {"content", example.reply}}})}};
}

Result<std::optional<AtFirstTrigger>> at_first_trigger(const encounter::Stage& stage,
                                                       const preview::ForecastTools& tools) {
  const auto played = eval::played_to_trigger(stage);
  if (!played.has_value()) {
    return played.error();
  }
  if (!played.value()) {
    return std::optional<AtFirstTrigger>();
  }
  const encounter::ClosedLoop& now = *played.value();
  std::vector<preview::Situation> all =
      preview::situations(now.seen(), now.beliefs(), stage.thresholds, tools);
  return all.empty()
             ? std::optional<AtFirstTrigger>()
             : std::optional(AtFirstTrigger{std::move(all.front()), now.seen(), now.beliefs()});
}

std::optional<ReplyExample> reply_example(ReplyExample example, const preview::Situation& situation,
                                          const std::optional<PromptCase>& told,
                                          std::uint64_t seed) {
  example.admissible = language_model::admissible(situation.facts);
  if (example.admissible.none()) {
    return std::nullopt;
  }
  for (const preview::PolicyFacts& facts : situation.facts) {
    if (facts.drivable()) {
      example.forecast.at(manoeuvre::index(facts.plan.policy)) = facts.outcome().harm;
    }
  }
  std::optional<memory::Case> nearest;
  if (told) {
    nearest = told->found;
  }
  Fnv hash;
  hash.add(example.record);
  hash.add(example.is_twin ? "twin" : "");
  hash.add(seed);
  std::mt19937_64 random(hash.value());
  example.set = set_of_record(example.record);
  example.prompt = language_model::scene_part(situation, nearest, told ? told->similarity : 0.0);
  example.choice = language_model::expert_choice(situation.facts, example.known);
  example.reply = language_model::expert_reply(situation, example.prompt, nearest, example.choice,
                                               language_model::most_taught_tokens, random);
  return example;
}

}  // namespace saca::cases
