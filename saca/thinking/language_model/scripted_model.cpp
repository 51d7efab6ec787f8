#include "saca/thinking/language_model/scripted_model.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace saca::language_model {
namespace {

constexpr Clock::Time way_back = std::chrono::milliseconds(1);

Answer answer_of(const ScriptedLine& line, Clock::Time time) {
  Answer answer{.time = time, .kind = *line.answer};
  answer.probability.fill((1.0 - line.probability) / (manoeuvre::num_policies - 1));
  answer.probability[manoeuvre::index(line.policy)] = line.probability;
  return answer;
}

/// What is said in time.
struct Said {
  std::vector<Reply> replies;                               ///< still without what is said
  std::vector<std::pair<std::size_t, ScriptedLine>> lines;  ///< of all scenes, by their times
  bool cut = false;  ///< somebody says nothing, or more than there is time for
};

/// @param left  the time that there is
Result<Said> said_in_time(const ScriptedModel::Script& script,
                          const std::vector<std::string>& scenes, Clock::Time left) {
  Said said;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const ScriptedReply reply = script(scenes[i]);
    if (reply.error) {
      return *reply.error;
    }
    said.replies.push_back(
        {.prompt_tokens = reply.prompt_tokens, .reply_tokens = reply.reply_tokens});
    said.cut = said.cut || reply.lines.empty();
    for (const ScriptedLine& line : reply.lines) {
      if (line.after < left) {
        said.lines.emplace_back(i, line);
      } else {
        said.cut = true;
      }
    }
  }
  std::stable_sort(said.lines.begin(), said.lines.end(),
                   [](const auto& a, const auto& b) { return a.second.after < b.second.after; });
  return said;
}

}  // namespace

Result<std::vector<Reply>> ScriptedModel::reply_to(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const Progress&)>& progress, const AskOptions& options) {
  ++num_asked_;
  last_scenes_ = scenes;
  last_grammars_ = options.grammars;
  last_deadline_ = deadline;
  const Clock::Time begin = clock_.now();
  auto said = said_in_time(script_, scenes, deadline - way_back - begin);
  if (!said.has_value()) {
    return said.error();
  }
  auto [replies, lines, cut] = std::move(said).value();
  bool any = false;
  for (const auto& [scene, line] : lines) {
    clock_.wait_until_or_stop(begin + line.after, options.stop);
    if (options.stop.stop_requested()) {
      break;
    }
    Reply& reply = replies[scene];
    if (!line.text.empty()) {
      reply.reasoning += line.text;
      progress({.prompt = scene, .text = line.text, .answer = nullptr});
    }
    if (line.answer) {
      any = true;
      reply.answers.push_back(answer_of(line, begin + line.after));
      progress({.prompt = scene, .text = {}, .answer = &reply.answers.back()});
    }
  }
  if (cut) {
    clock_.wait_until_or_stop(deadline - way_back, options.stop);
  }
  if (!any) {
    return Error{Error::Code::too_late, "script: no answer in time"};
  }
  return std::move(replies);
}

}  // namespace saca::language_model
