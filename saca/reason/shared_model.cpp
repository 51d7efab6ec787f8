#include "saca/reason/shared_model.h"

#include <algorithm>

namespace saca::reason {
namespace {

constexpr std::size_t most_known = 256;  // questions; methods that part ask the same within seconds

/// It began to answer and never came to its last word.
bool is_cut(const Reply& reply) {
  return !reply.answers.empty() &&
         std::all_of(reply.answers.begin(), reply.answers.end(),
                     [](const Answer& answer) { return answer.kind == Answer::Kind::first; });
}

bool is_whole(const Result<std::vector<Reply>>& replies) {
  return replies.has_value() &&
         std::none_of(replies.value().begin(), replies.value().end(), is_cut);
}

void tell(const std::vector<Reply>& replies, const std::function<void(const Progress&)>& progress) {
  for (std::size_t i = 0; i < replies.size(); ++i) {
    if (!replies[i].reasoning.empty()) {
      progress({.prompt = i, .text = replies[i].reasoning});
    }
    for (const Answer& answer : replies[i].answers) {
      progress({.prompt = i, .text = {}, .answer = &answer});
    }
  }
}

}  // namespace

std::optional<Error> SharedModel::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

Result<std::vector<Reply>> SharedModel::reply_to(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const Progress&)>& progress, const AskLimits& limits) {
  const Clock::Time patience = deadline - clock_.now();
  std::stop_source either;
  const std::stop_callback by_all(stop_, [&either] { either.request_stop(); });
  const std::stop_callback by_this(limits.stop, [&either] { either.request_stop(); });
  Result<std::vector<Reply>> replies = [&] {
    const std::lock_guard lock(mutex_);
    return known_or_asked({scenes, limits.max_tokens}, patience, either.get_token());
  }();
  if (replies.has_value()) {
    tell(replies.value(), progress);
  }
  return replies;
}

Result<std::vector<Reply>> SharedModel::known_or_asked(const Question& question,
                                                       Clock::Time patience,
                                                       const std::stop_token& stop) {
  if (stop.stop_requested()) {
    return Error{Error::Code::too_late, "the question is withdrawn"};
  }
  if (failure_) {
    return *failure_;
  }
  const Clock::Time now = clock_.now();
  if (const auto found = known_.find(question); found != known_.end()) {
    std::vector<Reply> replies = found->second;
    for (Reply& reply : replies) {
      for (Answer& answer : reply.answers) {
        answer.time += now;
      }
    }
    return replies;
  }
  const auto ask = [&] {
    return model_.ask(question.scenes, clock_.now() + patience, [](const Progress&) {},
                      {.stop = stop, .max_tokens = question.max_tokens});
  };
  const auto said = [](const Result<std::vector<Reply>>& replies) {
    return replies.has_value() || replies.error().code == Error::Code::malformed;
  };
  Clock::Time begin = now;
  auto replies = ask();
  const bool again = replies.has_value() ? !is_whole(replies) : !said(replies);
  if (again && !stop.stop_requested() && clock_.now() < begin + patience) {
    begin = clock_.now();
    replies = ask();
  }
  if (stop.stop_requested()) {  // what was said may be cut
    return Error{Error::Code::too_late, "the question is withdrawn"};
  }
  if (!said(replies)) {
    failure_ = replies.error();
    return *failure_;
  }
  if (replies.has_value()) {
    std::vector<Reply> dated = replies.value();
    for (Reply& reply : dated) {
      for (Answer& answer : reply.answers) {
        answer.time -= begin;
      }
    }
    remember(question, dated);
  }
  return replies;
}

void SharedModel::remember(const Question& question, const std::vector<Reply>& replies) {
  if (order_.size() == most_known) {
    known_.erase(order_.front());
    order_.pop_front();
  }
  known_.emplace(question, replies);
  order_.push_back(question);
}

}  // namespace saca::reason
