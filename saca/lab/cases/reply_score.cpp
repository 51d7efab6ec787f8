#include "saca/lab/cases/reply_score.h"

#include <algorithm>
#include <array>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/formats/json_reader.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/thinking/language_model/conclusion.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/retelling.h"
#include "saca/thinking/language_model/truth.h"
#include "saca/thinking/memory/experience.h"

namespace saca::cases {
namespace {

using From = language_model::Explanation::From;
using manoeuvre::PolicyId;
using nlohmann::json;

constexpr std::string_view reply_schema = "saca.example_reply/2";

json probabilities_json(const std::optional<eval::Probabilities>& answer) {
  return answer ? json(*answer) : json(nullptr);
}

std::optional<eval::Probabilities> read_probabilities(formats::JsonReader& reader,
                                                      std::string_view key) {
  if (!reader.has_value(key)) {
    return std::nullopt;
  }
  eval::Probabilities answer{};
  reader.numbers(key, answer);
  return answer;
}

/// Of those for which `wanted` holds, the one of the largest value, of equals the first.
template <class Wanted, class Value>
std::optional<PolicyId> most(const Wanted& wanted, const Value& value) {
  std::optional<PolicyId> best;
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (wanted(policy) && (!best || value(policy) > value(*best))) {
      best = policy;
    }
  }
  return best;
}

bool is_admissible(const ReplyExample& example, PolicyId policy) {
  return example.admissible.test(manoeuvre::index(policy));
}

PolicyId likeliest(const std::optional<eval::Probabilities>& answer) {
  return answer ? language_model::likeliest_policy({.probability = *answer}) : PolicyId::aeb;
}

PolicyId likeliest_within(const ExampleReply& reply) {
  return *most([&](PolicyId policy) { return is_admissible(reply.example, policy); },
               [&](PolicyId policy) {
                 return reply.last ? reply.last->at(manoeuvre::index(policy))
                                   : -collision::severity(policy);
               });
}

PolicyId least_of(const memory::PolicyHarms& harms) {
  // Classes, then the mildest, as the one ordering has it as far as harms tell.
  return *most([&](PolicyId policy) { return harms.at(manoeuvre::index(policy)).has_value(); },
               [&](PolicyId policy) {
                 return std::pair(-collision::harm_class(*harms.at(manoeuvre::index(policy))),
                                  -collision::severity(policy));
               });
}

PolicyId mildest_within(const ExampleReply& reply) {
  return *most([&](PolicyId policy) { return is_admissible(reply.example, policy); },
               [](PolicyId policy) { return -collision::severity(policy); });
}

PolicyId rule_within(const ExampleReply& reply) {
  return is_admissible(reply.example, PolicyId::aeb) ? PolicyId::aeb : mildest_within(reply);
}

/// Of the admissible the one of the least of these harms.
PolicyId least_within(const ExampleReply& reply, memory::PolicyHarms harms) {
  for (std::size_t k = 0; k < harms.size(); ++k) {
    if (!reply.example.admissible.test(k)) {
      harms.at(k).reset();
    }
  }
  return least_of(harms);
}

PolicyId best_within(const ExampleReply& reply) {
  return least_within(reply, reply.example.known);
}

/// Without cues as the rule has it.
PolicyId table_within(const ExampleReply& reply) {
  return reply.example.by_table ? least_within(reply, *reply.example.by_table) : rule_within(reply);
}

struct Chooser {
  std::string_view key;
  std::string_view title;
  PolicyId (*choose)(const ExampleReply&);
};

constexpr std::array<Chooser, 10> choosers{{
    {"model_at_once", "the model, at once",
     [](const ExampleReply& one) { return likeliest(one.first); }},
    {"model", "the model, after reasoning",
     [](const ExampleReply& one) { return likeliest(one.last); }},
    {"model_within", "the model, within the admissible", likeliest_within},
    {"forecast", "the best forecast",
     [](const ExampleReply& one) { return least_of(one.example.forecast); }},
    {"rule_within", "AEB where admissible, else the mildest", rule_within},
    {"mildest_within", "the mildest of the admissible", mildest_within},
    {"table_within", "with cues the least by their table, else AEB, the mildest", table_within},
    {"expert", "the expert it was taught by",
     [](const ExampleReply& one) { return one.example.choice; }},
    {"aeb", "always AEB", [](const ExampleReply&) { return PolicyId::aeb; }},
    {"best_within", "the best of the admissible in hindsight", best_within},
}};

/// Harm of a choice; of what cannot be driven that of braking.
double harm_of(const memory::PolicyHarms& known, PolicyId policy) {
  return known.at(manoeuvre::index(policy))
      .value_or(known.at(manoeuvre::index(PolicyId::aeb)).value_or(0.0));
}

double least_harm_of(const memory::PolicyHarms& known) {
  return *known.at(manoeuvre::index(least_of(known)));
}

bool is_known(const ReplyExample& example) {
  bool all = example.known.front().has_value();
  for (std::size_t k = 0; k < example.known.size(); ++k) {
    all = all && example.known.at(k).has_value() == example.forecast.at(k).has_value();
  }
  return all;
}

ReplyChoice figures_of(std::span<const ExampleReply* const> known, const Chooser& chooser,
                       std::uint64_t seed) {
  const auto mean = [&](const auto& measure) {
    std::vector<std::optional<double>> values;
    values.reserve(known.size());
    for (const ExampleReply* one : known) {
      values.emplace_back(measure(*one, chooser.choose(*one)));
    }
    return eval::mean_over_encounters(values, seed);
  };
  return {.key = chooser.key,
          .title = chooser.title,
          .best_within = mean([](const ExampleReply& one, PolicyId choice) {
            const double best = harm_of(one.example.known, best_within(one));
            return harm_of(one.example.known, choice) <= best + memory::as_good ? 1.0 : 0.0;
          }),
          .admissible = mean([](const ExampleReply& one, PolicyId choice) {
            return is_admissible(one.example, choice) ? 1.0 : 0.0;
          }),
          .harm = mean([](const ExampleReply& one, PolicyId choice) {
            return harm_of(one.example.known, choice);
          }),
          .regret = mean([](const ExampleReply& one, PolicyId choice) {
            return harm_of(one.example.known, choice) - least_harm_of(one.example.known);
          }),
          .above_rule = mean([](const ExampleReply& one, PolicyId choice) {
            return harm_of(one.example.known, choice) -
                   harm_of(one.example.known, rule_within(one));
          })};
}

double share(
    std::span<const ExampleReply> replies, bool (*holds)(const ExampleReply&),
    bool (*counts)(const ExampleReply&) = [](const ExampleReply&) { return true; }) {
  const auto num = std::count_if(replies.begin(), replies.end(), counts);
  const auto num_held = std::count_if(replies.begin(), replies.end(),
                                      [&](const auto& one) { return counts(one) && holds(one); });
  return num == 0 ? 0.0 : static_cast<double>(num_held) / static_cast<double>(num);
}

std::optional<eval::Calibration> calibration_of(std::span<const ExampleReply* const> known) {
  std::vector<eval::JudgedAnswer> judged;
  for (const ExampleReply* one : known) {
    if (!one->last) {
      continue;
    }
    eval::JudgedAnswer answer{*one->last, {}};
    const double best = harm_of(one->example.known, best_within(*one));
    for (std::size_t k = 0; k < answer.right.size(); ++k) {
      answer.right.at(k) =
          one->example.admissible.test(k) && *one->example.known.at(k) <= best + memory::as_good;
    }
    judged.push_back(answer);
  }
  return calibrated(judged);
}

void score_texts(ReplyScore& score, std::span<const ExampleReply> replies) {
  score.ended = share(replies, [](const ExampleReply& one) { return one.ended; });
  score.agrees = share(
      replies,
      [](const ExampleReply& one) {
        return language_model::concluded(one.reasoning) == likeliest(one.last);
      },
      [](const ExampleReply& one) { return one.ended && one.last.has_value(); });
  score.true_replies = share(
      replies, [](const ExampleReply& one) { return one.false_statements == 0; },
      [](const ExampleReply& one) { return one.statements > 0; });
  score.unfounded = share(replies, [](const ExampleReply& one) { return one.unfounded; });
  score.shown = share(replies, [](const ExampleReply& one) { return one.shown == From::model; });
  score.shown_in_part =
      share(replies, [](const ExampleReply& one) { return one.shown == From::model_in_part; });
  score.shown_at_last =
      share(replies, [](const ExampleReply& one) { return one.shown_at_last != From::facts; });
  int statements = 0;
  int wrong = 0;
  for (const ExampleReply& one : replies) {
    statements += one.statements;
    wrong += one.false_statements;
    score.tokens.push_back(one.tokens);
  }
  std::sort(score.tokens.begin(), score.tokens.end());
  score.statements = static_cast<double>(statements) / static_cast<double>(replies.size());
  score.true_statements =
      statements == 0 ? 0.0 : static_cast<double>(statements - wrong) / statements;
}

/// @param written  whole sentences of a reply
language_model::Explanation shown_by(std::string_view written, const ExampleReply& reply,
                                     const preview::Situation& situation) {
  return language_model::true_part(written, reply.example.prompt, situation, likeliest(reply.last))
      .value_or(language_model::Explanation{});
}

}  // namespace

ExampleReply example_reply(ReplyExample example, const language_model::Reply& reply,
                           const preview::Situation& situation) {
  ExampleReply result{.example = std::move(example), .reasoning = reply.reasoning};
  for (const language_model::Answer& answer : reply.answers) {
    if (answer.kind == language_model::Answer::Kind::first) {
      result.first = answer.probability;
    }
    result.last = answer.probability;
    result.ended = answer.kind == language_model::Answer::Kind::ended;
  }
  result.tokens = reply.reply_tokens;
  if (!reply.answers.empty()) {
    const language_model::Truth truth =
        language_model::truth_of(reply, result.example.prompt, situation);
    result.statements = truth.num_checked;
    result.false_statements = static_cast<int>(truth.wrong.size());
    result.unfounded = truth.is_choice_unfounded();
    result.shown = shown_by(language_model::finished_part(reply), result, situation).from;
  }
  result.shown_at_last = result.shown;
  return result;
}

std::optional<Error> try_again(ExampleReply& reply, const preview::Situation& situation,
                               language_model::LanguageModel& model, const Clock& clock,
                               const ChoiceGrammar& grammar) {
  if (!reply.last || reply.shown != language_model::Explanation::From::facts) {
    return std::nullopt;  // there is no choice to give reasons for, or its reasons hold
  }
  const auto told = language_model::told_again(
      model, clock, reply.example.prompt, {.text = {}, .from = reply.shown},
      [&](std::string_view written) { return shown_by(written, reply, situation); },
      {.grammars = {grammar(likeliest(reply.last))}});
  if (!told.has_value()) {
    return told.error();
  }
  reply.shown_at_last = told.value().from;
  reply.tries = told.value().tries;
  return std::nullopt;
}

json to_json(const ExampleReply& reply) {
  return {{"schema", reply_schema},
          {"example", to_json(reply.example)},
          {"reasoning", reply.reasoning},
          {"first", probabilities_json(reply.first)},
          {"last", probabilities_json(reply.last)},
          {"ended", reply.ended},
          {"tokens", static_cast<std::uint64_t>(reply.tokens)},
          {"statements", static_cast<std::uint64_t>(reply.statements)},
          {"false_statements", static_cast<std::uint64_t>(reply.false_statements)},
          {"unfounded", reply.unfounded},
          {"shown", name(reply.shown)},
          {"shown_at_last", name(reply.shown_at_last)},
          {"tries", static_cast<std::uint64_t>(reply.tries)}};
}

Result<ExampleReply> example_reply_from_json(const json& document) {
  std::optional<Error> problem;
  formats::JsonReader reader(document, "", problem, "reply to an example");
  ExampleReply reply;
  reader.schema(reply_schema);
  const auto example = reply_example_from_json(reader.any("example"));
  reply.reasoning = reader.text("reasoning");
  reply.first = read_probabilities(reader, "first");
  reply.last = read_probabilities(reader, "last");
  reply.ended = reader.flag("ended");
  constexpr std::uint64_t many = 1'000'000;
  for (const auto& [key, part] : {std::pair{"tokens", &ExampleReply::tokens},
                                  std::pair{"statements", &ExampleReply::statements},
                                  std::pair{"false_statements", &ExampleReply::false_statements},
                                  std::pair{"tries", &ExampleReply::tries}}) {
    reply.*part = static_cast<int>(reader.integer(key, many));
  }
  reply.unfounded = reader.flag("unfounded");
  for (const auto& [key, part] : {std::pair{"shown", &ExampleReply::shown},
                                  std::pair{"shown_at_last", &ExampleReply::shown_at_last}}) {
    reply.*part =
        reader.word(key, language_model::explanation_from, "model, model_in_part or facts");
  }
  reader.refuse_others();
  if (problem) {
    return *problem;
  }
  if (!example.has_value()) {
    return example.error();
  }
  reply.example = example.value();
  return reply;
}

ReplyScore reply_score(std::span<const ExampleReply> replies, std::uint64_t seed) {
  expects(!replies.empty(), "replies to score");
  ReplyScore score{.examples = static_cast<int>(replies.size())};
  std::vector<const ExampleReply*> known;
  std::vector<std::optional<double>> needless;
  for (const ExampleReply& one : replies) {
    expects(one.example.admissible.any(), "something admissible");
    if (!one.example.is_twin && is_known(one.example)) {
      known.push_back(&one);
    }
    if (one.example.is_twin && is_admissible(one.example, PolicyId::no_intervention)) {
      needless.emplace_back(likeliest_within(one) == PolicyId::no_intervention ? 0.0 : 1.0);
    }
  }
  score.known = static_cast<int>(known.size());
  for (const Chooser& chooser : choosers) {
    score.choices.push_back(figures_of(known, chooser, seed));
  }
  score.needless = eval::mean_over_encounters(needless, seed);
  score.calibration = calibration_of(known);
  score_texts(score, replies);
  return score;
}

}  // namespace saca::cases
