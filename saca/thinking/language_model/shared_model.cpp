#include "saca/thinking/language_model/shared_model.h"

#include <fmt/core.h>

#include <algorithm>

namespace saca::language_model {
namespace {

constexpr std::size_t most_known = 256;  // scenes; methods that part ask the same within seconds

/// It began to answer and never came to its last word.
bool is_cut(const Reply& reply) {
  return !reply.answers.empty() &&
         std::all_of(reply.answers.begin(), reply.answers.end(),
                     [](const Answer& answer) { return answer.kind == Answer::Kind::first; });
}

/// Something that the model said, and not what became of it.
bool is_said(const Result<Reply>& reply) {
  return reply.has_value() || reply.error().code == Error::Code::malformed;
}

Reply later_by(Reply reply, Clock::Time time) {
  for (Answer& answer : reply.answers) {
    answer.time += time;
  }
  return reply;
}

void tell(std::size_t prompt, const Reply& reply,
          const std::function<void(const Progress&)>& progress) {
  if (!reply.reasoning.empty()) {
    progress({.prompt = prompt, .text = reply.reasoning});
  }
  for (const Answer& answer : reply.answers) {
    progress({.prompt = prompt, .text = {}, .answer = &answer});
  }
}

}  // namespace

std::optional<Error> SharedModel::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

Result<std::vector<Reply>> SharedModel::reply_to(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const Progress&)>& progress, const AskOptions& options) {
  const Clock::Time patience = deadline - clock_.now();
  std::stop_source either;
  const std::stop_callback by_all(stop_, [&either] { either.request_stop(); });
  const std::stop_callback by_this(options.stop, [&either] { either.request_stop(); });
  std::vector<Reply> replies(scenes.size());
  std::optional<Error> unanswered;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto reply = [&] {
      const std::lock_guard lock(mutex_);
      return known_or_asked({scenes[i], options.max_tokens, options.sampling_seed,
                             options.grammars.empty() ? "" : options.grammars[i]},
                            patience, either.get_token());
    }();
    if (!is_said(reply)) {
      return reply.error();
    }
    if (reply.has_value()) {
      replies[i] = reply.value();
      tell(i, replies[i], progress);
    } else {
      unanswered = reply.error();
    }
  }
  const bool any = std::any_of(replies.begin(), replies.end(),
                               [](const Reply& reply) { return !reply.answers.empty(); });
  return any || !unanswered ? Result(std::move(replies)) : *unanswered;
}

Result<Reply> SharedModel::known_or_asked(const PutQuestion& question, Clock::Time patience,
                                          const std::stop_token& stop) {
  if (stop.stop_requested()) {
    return Error{Error::Code::too_late, "the question is withdrawn"};
  }
  if (failure_) {
    return *failure_;
  }
  const Clock::Time now = clock_.now();
  auto found = known_.find(question);
  if (found == known_.end()) {
    Result<Reply> reply = asked(question, patience, stop);
    if (!is_said(reply)) {
      return reply;
    }
    if (order_.size() == most_known) {
      known_.erase(order_.front());
      order_.pop_front();
    }
    found = known_.emplace(question, std::move(reply)).first;
    order_.push_back(question);
  }
  return found->second.has_value() ? Result(later_by(found->second.value(), now)) : found->second;
}

Result<Reply> SharedModel::asked(const PutQuestion& question, Clock::Time patience,
                                 const std::stop_token& stop) {
  Clock::Time begin{0};
  const auto ask = [&]() -> Result<Reply> {
    begin = clock_.now();
    const auto replies = model_.ask({question.scene}, begin + patience, [](const Progress&) {},
                                    {.stop = stop,
                                     .max_tokens = question.max_tokens,
                                     .sampling_seed = question.sampling_seed,
                                     .grammars = {question.grammar}});
    return replies.has_value() ? Result(later_by(replies.value().front(), -begin))
                               : replies.error();
  };
  // A model that knows its deadline ends a little before it.
  const auto is_out_of_time = [&] { return clock_.now() - begin > patience / 10 * 9; };
  Result<Reply> reply = ask();
  const bool again = reply.has_value() ? is_cut(reply.value()) : !is_said(reply);
  if (again && !stop.stop_requested() && !is_out_of_time()) {
    reply = ask();
  }
  if (stop.stop_requested()) {  // what was said may be cut
    return Error{Error::Code::too_late, "the question is withdrawn"};
  }
  if (is_said(reply) && is_out_of_time()) {
    reply = Error{Error::Code::too_late,
                  fmt::format("{}: want a reply within {:.0f} s, got none or a part",
                              model_.description(), to_seconds(patience))};
  }
  if (!is_said(reply)) {
    failure_ = reply.error();
  }
  return reply;
}

}  // namespace saca::language_model
