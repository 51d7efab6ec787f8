#include "saca/lab/paper_comparison/reply_clock.h"

#include <fmt/core.h>

#include <cstdint>

#include "saca/lab/long_work/interrupt.h"

namespace saca::paper_comparison {
namespace {

using eval::PaperTable;

/// The first questions in about ten draws of a table, as many of each condition.
Result<std::vector<FirstQuestion>> questions_of(const PaperTable& table, const ReplyClock& clock,
                                                std::uint64_t seed) {
  const auto conditions = eval::encounters_of(table, clock.scenarios, *clock.car);
  if (!conditions.has_value()) {
    return conditions.error();
  }
  const std::size_t num = conditions.value().size();
  std::vector<eval::SuiteEncounter> draws;
  for (std::size_t k = 0; k < (few_draws + num - 1) / num * num; ++k) {
    draws.push_back(conditions.value()[k % num]);
    draws.back().number = k;
  }
  return first_questions(draws, {.methods = {}, .seed = seed}, *clock.setup, *clock.intent);
}

}  // namespace

std::vector<AskedModel> asked_models(const suites::ThinkingOptions& thinking) {
  std::vector<AskedModel> models;
  if (thinking.model != "off") {
    models.push_back({thinking.model, "--llm", "the model", "model"});
  }
  if (!thinking.untuned.empty()) {
    models.push_back({thinking.untuned, "--untuned", "the model without fine-tuning", "untuned"});
  }
  return models;
}

Result<std::vector<TimedModel>> timed_models(const ReplyClock& clock, const TableRequest& request) {
  constexpr double patience = 60.0;  // [s]
  const long_work::InterruptStop interrupt;
  std::vector<TimedModel> timed;
  for (const eval::PublishedReplies& published : eval::published_replies()) {
    const PaperTable& table = *eval::find_paper_table(published.table);
    if (!is_wanted(table, request) || long_work::interrupted()) {
      continue;
    }
    const auto questions = questions_of(table, clock, request.seed);
    if (!questions.has_value()) {
      return questions.error();
    }
    for (const AskedModel& asked : asked_models(request.thinking)) {
      const auto model = clock.open(asked);
      if (!model.has_value()) {
        return model.error();
      }
      const auto times = timed_replies(*model.value(), *clock.setup->clock, questions.value(),
                                       patience, interrupt.token());
      if (!times.has_value()) {
        return Error{times.error().code,
                     fmt::format("{}: {}", asked.option, times.error().message)};
      }
      timed.push_back({std::string(table.name), asked.title, asked.key, times.value()});
    }
  }
  return timed;
}

}  // namespace saca::paper_comparison
