#include "saca/thinking/language_model/explanation.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "saca/base/core/contract.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/names.h"
#include "saca/thinking/language_model/conclusion.h"
#include "saca/thinking/language_model/expert.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/truth.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::language_model {
namespace {

using manoeuvre::PolicyId;

constexpr std::array<std::string_view, 3> from_names{"model", "model_in_part", "facts"};

/// Of what is composed from facts: nobody waits for it, all that applies may be said.
constexpr int most_shown_tokens = 170;

/// The numbered statements of a reply, without numbers.
std::vector<std::string_view> numbered_statements(std::string_view text) {
  std::vector<std::string_view> all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t digits = line.find_first_not_of("0123456789");
    if (digits != std::string_view::npos && digits > 0 && line.substr(digits).starts_with(". ")) {
      all.push_back(line.substr(digits + 2));
    }
  }
  return all;
}

std::string numbered(const std::vector<std::string_view>& statements) {
  std::string text;
  for (std::size_t i = 0; i < statements.size(); ++i) {
    text += fmt::format("{}. {}\n", i + 1, statements[i]);
  }
  return text;
}

/// Of a policy that is not admissible.
std::string facts_beside_the_best(const preview::Situation& situation, PolicyId chosen) {
  const auto line = [&](const preview::PolicyFacts& facts) {
    return prompt_policy(facts, situation.scene_at_trigger);
  };
  return fmt::format(
      "1. {}\n2. The best forecast is that of {}\n",
      line(situation.facts[manoeuvre::index(chosen)]),
      line(situation.facts[manoeuvre::index(preview::best_by_forecast(situation.facts))]));
}

}  // namespace

std::string_view name(Explanation::From from) {
  return name_of(from, from_names);
}

std::optional<Explanation::From> explanation_from(std::string_view name) {
  return value_from<Explanation::From>(name, from_names);
}

std::optional<Explanation> true_part(std::string_view written, std::string_view prompt,
                                     const preview::Situation& situation,
                                     const std::optional<PolicyId>& choice) {
  const std::vector<std::string_view> all = numbered_statements(written);
  std::vector<std::string_view> kept;
  for (const std::string_view statement : all) {
    const Truth truth = truth_of(statement, prompt, situation, choice);
    if (truth.num_checked > 0 && truth.wrong.empty()) {
      kept.push_back(statement);
    }
  }
  if (kept.empty() || kept.back().data() != all.back().data() ||
      (choice && first_named(kept.back()) != choice)) {
    return std::nullopt;
  }
  return Explanation{numbered(kept), kept.size() == all.size() ? Explanation::From::model
                                                               : Explanation::From::model_in_part};
}

Explanation explanation(std::string_view reasoning, std::string_view prompt,
                        const preview::Situation& situation,
                        const std::optional<memory::Case>& nearest, PolicyId chosen) {
  expects(situation.facts[manoeuvre::index(chosen)].drivable(), "a policy that can be driven");
  if (auto held = true_part(reasoning, prompt, situation, chosen)) {
    return *std::move(held);
  }
  if (!admissible(situation.facts).test(manoeuvre::index(chosen))) {
    return {facts_beside_the_best(situation, chosen), Explanation::From::facts};
  }
  Fnv hash;  // the same words for the same prompt
  hash.add(prompt);
  std::mt19937_64 random(hash.value());
  return {numbered(numbered_statements(
              expert_reply(situation, prompt, nearest, chosen, most_shown_tokens, random))),
          Explanation::From::facts};
}

}  // namespace saca::language_model
