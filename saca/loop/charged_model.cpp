#include "saca/loop/charged_model.h"

#include "saca/config/config.h"

namespace saca::loop {
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
                            .prompt_token = root.number("prompt_token_s", {0.0, 1.0}),
                            .reply_token = root.number("reply_token_s", {0.0, 1.0})};
  if (const auto error = document.value().error()) {
    return *error;
  }
  return costs;
}

Result<std::vector<reason::Reply>> ChargedModel::ask(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const reason::Progress&)>& progress) {
  auto replies = model_.ask(scenes, real_.now() + patience, [](const reason::Progress&) {});
  if (!replies.has_value()) {
    return replies;
  }
  const auto seconds = [](double s) {
    return std::chrono::duration_cast<Clock::Time>(std::chrono::duration<double>(s));
  };
  int prompt_tokens = 0;
  for (const reason::Reply& reply : replies.value()) {
    prompt_tokens += reply.prompt_tokens;
  }
  const Clock::Time read = clock_.now() + seconds(costs_.prompt_token * prompt_tokens);
  std::vector<reason::Reply> in_time;
  bool any = false;
  for (std::size_t i = 0; i < replies.value().size(); ++i) {
    reason::Reply reply = replies.value()[i];
    progress({.prompt = i, .text = reply.reasoning});
    std::vector<reason::Answer> answers;
    for (reason::Answer answer : reply.answers) {
      const bool first = answer.kind == reason::Answer::Kind::first;
      answer.time =
          read + (first ? Clock::Time(0) : seconds(costs_.reply_token * reply.reply_tokens));
      if (answer.time <= deadline) {
        answers.push_back(answer);
        progress({.prompt = i, .text = {}, .answer = &answer});
        any = true;
      }
    }
    reply.answers = answers;
    in_time.push_back(std::move(reply));
  }
  if (!any) {
    return Error{Error::Code::too_late, "no answer before the deadline, by the charged tokens"};
  }
  return in_time;
}

}  // namespace saca::loop
