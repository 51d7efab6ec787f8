#include "saca/runtime/charged_model.h"

#include <algorithm>
#include <utility>

#include "saca/base/config/config.h"

namespace saca::runtime {
namespace {

constexpr Clock::Time patience = std::chrono::minutes(2);  // the world waits, but not for ever

}  // namespace

Result<ThinkingCosts> read_thinking_costs(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  config::Table root = document.value().root();
  const ThinkingCosts costs{.preview = root.number("preview_s", {0.0, 10.0}),
                            .verdict = root.number("verdict_s", {0.0, 10.0}),
                            .prompt_token = root.number("prompt_token_s", {0.0, 1.0}),
                            .reply_token = root.number("reply_token_s", {0.0, 1.0})};
  if (const auto error = document.value().error()) {
    return *error;
  }
  return costs;
}

Result<std::vector<language_model::Reply>> ChargedModel::reply_to(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const language_model::Progress&)>& progress,
    const language_model::AskOptions& options) {
  auto replies = model_.ask(
      scenes, real_.now() + patience, [](const language_model::Progress&) {}, options);
  if (!replies.has_value()) {
    return replies;
  }
  int prompt_tokens = 0;
  for (const language_model::Reply& reply : replies.value()) {
    prompt_tokens += reply.prompt_tokens;
  }
  const Clock::Time read = clock_.now() + from_seconds(costs_.prompt_token * prompt_tokens);
  std::vector<std::pair<std::size_t, language_model::Answer>>
      answers;  // of all prompts, by their dates
  std::vector<language_model::Reply> in_time;
  for (std::size_t i = 0; i < replies.value().size(); ++i) {
    language_model::Reply reply = replies.value()[i];
    const auto late = [&](language_model::Answer& answer) {
      const bool first = answer.kind == language_model::Answer::Kind::first;
      answer.time =
          read + (first ? Clock::Time(0) : from_seconds(costs_.reply_token * reply.reply_tokens));
      return answer.time > deadline;
    };
    if (std::erase_if(reply.answers, late) > 0) {
      reply.reasoning.clear();  // the last answer comes after it
      reply.reply_tokens = 0;
    }
    if (!reply.reasoning.empty()) {
      progress({.prompt = i, .text = reply.reasoning});
    }
    for (const language_model::Answer& answer : reply.answers) {
      answers.emplace_back(i, answer);
    }
    in_time.push_back(std::move(reply));
  }
  std::stable_sort(answers.begin(), answers.end(),
                   [](const auto& a, const auto& b) { return a.second.time < b.second.time; });
  for (const auto& [prompt, answer] : answers) {
    progress({.prompt = prompt, .text = {}, .answer = &answer});
  }
  if (answers.empty()) {
    return Error{Error::Code::too_late, "no answer before the deadline, by the charged tokens"};
  }
  return in_time;
}

}  // namespace saca::runtime
