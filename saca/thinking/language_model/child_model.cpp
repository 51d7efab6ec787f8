#include "saca/thinking/language_model/child_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "saca/base/core/printable.h"

namespace saca::language_model {
namespace {

constexpr std::size_t longest_reasoning = 1U << 16U;  // bytes; a reply has a few hundred
constexpr std::size_t most_answers = 16;              // of a scene; there are two
constexpr double longest_load = 60.0;                 // [s]; a minute on a very slow disk

Error malformed(const std::string& message) {
  return {Error::Code::malformed, "model process: " + message};
}

}  // namespace

/// One question and what has come back so far.
struct ChildModel::Exchange {
  int id = 0;
  const std::function<void(const Progress&)>& progress;
  std::vector<Reply> replies;
  bool done = false;
};

ChildModel::ChildModel(ChildModelSettings settings, Clock& clock)
    : settings_(std::move(settings)), clock_(clock), process_(settings_.command, clock) {
  expects(settings_.max_tokens >= 0 && settings_.margin > 0.0, "max_tokens >= 0 and margin > 0");
  (void)begin();  // what goes wrong shows at the first question
}

std::optional<Error> ChildModel::begin() {
  ready_ = false;
  if (auto error = process_.start()) {
    return error;
  }
  ++restarts_;
  begun_at_ = clock_.now();
  // The first line always fits into the connection's buffer: nothing is waited for.
  return process_.send(protocol::line(protocol::Request(protocol::Start{settings_.system})),
                       clock_.now() + from_seconds(settings_.margin));
}

void ChildModel::give_up() {
  const bool worked = ready_;
  process_.kill();
  ready_ = false;
  if (worked) {
    (void)begin();  // loads while the caller goes on; a failure shows at the next question
  }
}

Result<protocol::Event> ChildModel::next_event(Clock::Time deadline, const std::stop_token& stop) {
  const Result<std::string> line = process_.receive(deadline, stop);
  if (!line.has_value()) {
    return line.error();
  }
  return protocol::event_from(line.value());
}

std::optional<Error> ChildModel::wait_until_ready(Clock::Time deadline,
                                                  const std::stop_token& stop) {
  if (!process_.running()) {
    if (auto error = begin()) {
      return error;
    }
  }
  while (!ready_) {
    const Result<protocol::Event> event = next_event(deadline, stop);
    if (!event.has_value()) {
      const bool still_loading = event.error().code == Error::Code::too_late &&
                                 clock_.now() - begun_at_ < from_seconds(longest_load);
      if (!still_loading) {
        give_up();
      }
      return event.error();
    }
    if (const auto* failed = std::get_if<protocol::FailureMessage>(&event.value())) {
      give_up();
      return Error{Error::Code::unreadable, "model process: " + one_line(failed->message)};
    }
    if (const auto* ready = std::get_if<protocol::Ready>(&event.value())) {
      ready_ = true;
      model_description_ = one_line(ready->description);
      figures_.load_time = ready->load_time;
      figures_.system_tokens = ready->system_tokens;
    }
  }
  return std::nullopt;
}

std::optional<Error> ChildModel::take(Exchange& exchange, const protocol::Event& event) {
  const auto is_ours = [&](const auto& e) { return e.id == exchange.id; };
  const auto reply = [&](std::size_t scene) {
    return scene < exchange.replies.size() ? &exchange.replies[scene] : nullptr;
  };
  if (const auto* read = std::get_if<protocol::PromptRead>(&event); read && is_ours(*read)) {
    if (Reply* r = reply(read->scene)) {
      r->prompt_tokens = read->tokens;
    }
  } else if (const auto* text = std::get_if<protocol::Text>(&event); text && is_ours(*text)) {
    Reply* r = reply(text->scene);
    if (r == nullptr || r->reasoning.size() + text->text.size() > longest_reasoning) {
      return malformed("want text of one of the scenes, at most 64 KiB of it");
    }
    r->reasoning += text->text;
    exchange.progress({.prompt = text->scene, .text = text->text, .answer = nullptr});
  } else if (const auto* said = std::get_if<protocol::AnswerMessage>(&event);
             said && is_ours(*said)) {
    Reply* r = reply(said->scene);
    if (r == nullptr || r->answers.size() == most_answers) {
      return malformed(fmt::format("want answers to one of the scenes, at most {}", most_answers));
    }
    r->answers.push_back(
        {.time = clock_.now(), .probability = said->probability, .kind = said->kind});
    exchange.progress({.prompt = said->scene, .text = {}, .answer = &r->answers.back()});
  } else if (const auto* done = std::get_if<protocol::Done>(&event); done && is_ours(*done)) {
    for (std::size_t i = 0; i < exchange.replies.size() && i < done->reply_tokens.size(); ++i) {
      exchange.replies[i].reply_tokens = done->reply_tokens[i];
    }
    figures_.prompt_time = done->prompt_time;
    figures_.reply_time = done->reply_time;
    exchange.done = true;
    if (done->overran) {
      return Error{Error::Code::too_late, "model process: want answers in time, got none"};
    }
  } else if (const auto* failed = std::get_if<protocol::FailureMessage>(&event);
             failed && failed->id.value_or(exchange.id) == exchange.id) {
    exchange.done = true;
    return Error{failed->late ? Error::Code::too_late : Error::Code::unreadable,
                 "model process: " + one_line(failed->message)};
  }
  return std::nullopt;
}

std::optional<Error> ChildModel::collect(Exchange& exchange, Clock::Time deadline,
                                         const std::stop_token& stop) {
  while (!exchange.done) {
    const Result<protocol::Event> event = next_event(deadline, stop);
    if (!event.has_value()) {
      return event.error();
    }
    if (auto error = take(exchange, event.value())) {
      return error;
    }
  }
  return std::nullopt;
}

// The process says that it is done soon after: until then it may say what it had ready.
std::optional<Error> ChildModel::withdraw(Exchange& exchange, Clock::Time deadline) {
  const Clock::Time until = std::min(deadline, clock_.now() + from_seconds(settings_.margin));
  auto error =
      process_.send(protocol::line(protocol::Request(protocol::Cancel{exchange.id})), until);
  if (!error) {
    error = collect(exchange, until);
  }
  return exchange.done ? Error{Error::Code::too_late, "model process: the question is withdrawn"}
                       : error;
}

Result<std::vector<Reply>> ChildModel::reply_to(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const Progress&)>& progress, const AskOptions& options) {
  // The process is told to be done a margin before the deadline, and is heard for most of the
  // margin beyond that.
  const Clock::Time margin = from_seconds(settings_.margin);
  const Clock::Time listen_until = deadline - margin / 4;
  if (auto error = wait_until_ready(listen_until, options.stop)) {
    return *error;
  }
  const double budget = to_seconds(deadline - margin - clock_.now());
  if (!(budget > 0.0)) {
    return Error{Error::Code::too_late, "model process: no time is left to ask"};
  }
  Exchange exchange{.id = ++last_id_, .progress = progress, .replies = {}};
  exchange.replies.resize(scenes.size());
  const protocol::Request request = protocol::Ask{exchange.id,
                                                  scenes,
                                                  budget,
                                                  options.max_tokens.value_or(settings_.max_tokens),
                                                  options.sampling_seed,
                                                  options.grammars};
  auto error = process_.send(protocol::line(request), listen_until);
  if (!error) {
    error = collect(exchange, listen_until, options.stop);
  }
  if (error && !exchange.done && options.stop.stop_requested()) {
    error = withdraw(exchange, listen_until);
  }
  if (error && !exchange.done) {
    give_up();  // it is late, gone or mad; another one begins at once
  }
  const bool any = std::any_of(exchange.replies.begin(), exchange.replies.end(),
                               [](const Reply& reply) { return !reply.answers.empty(); });
  if (any) {
    return std::move(exchange.replies);
  }
  return error.value_or(malformed("want answers, got none"));
}

Result<protocol::Info> ChildModel::info(Clock::Time deadline) {
  auto error = wait_until_ready(deadline);
  if (!error) {
    error = process_.send(protocol::line(protocol::Request(protocol::InfoRequest{})), deadline);
  }
  while (!error) {
    const Result<protocol::Event> event = next_event(deadline);
    if (!event.has_value()) {
      error = event.error();
    } else if (const auto* info = std::get_if<protocol::Info>(&event.value())) {
      protocol::Info bounded = *info;
      bounded.description = one_line(info->description);
      bounded.file = one_line(info->file);
      return bounded;
    }
  }
  return *error;
}

std::string ChildModel::description() const {
  const std::string model = model_description_.empty() ? "not loaded" : model_description_;
  return settings_.identity.empty() ? model : settings_.identity + " (" + model + ")";
}

}  // namespace saca::language_model
