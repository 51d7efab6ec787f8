#include "saca/thinking/language_model/replay_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/printable.h"
#include "saca/base/formats/json_text.h"
#include "saca/thinking/language_model/reply.h"

namespace saca::language_model {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view schema = "saca.replies/1";
constexpr Clock::Time longest_reply = std::chrono::hours(24);

Json json_of(const RecordedReply& recorded) {
  Json answers = Json::array();
  for (const Answer& answer : recorded.reply.answers) {
    answers.push_back({{"after_ns", answer.time.count()},
                       {"kind", name(answer.kind)},
                       {"probability", answer.probability}});
  }
  Json json{{"prompt", recorded.prompt},
            {"reasoning", recorded.reply.reasoning},
            {"prompt_tokens", recorded.reply.prompt_tokens},
            {"reply_tokens", recorded.reply.reply_tokens},
            {"answers", answers}};
  if (recorded.sampling_seed != 0) {
    json["sampling_seed"] = recorded.sampling_seed;
  }
  return json;
}

Answer answer_from(const Json& json) {
  Answer answer;
  answer.time = Clock::Time(json.at("after_ns").get<Clock::Time::rep>());
  answer.kind = answer_kind_from(json.at("kind").get<std::string>()).value();
  answer.probability = json.at("probability").get<decltype(answer.probability)>();
  return answer;
}

RecordedReply reply_from(const Json& json) {
  RecordedReply recorded;
  recorded.prompt = json.at("prompt").get<std::string>();
  recorded.sampling_seed = json.value("sampling_seed", 0);
  recorded.reply.reasoning = json.at("reasoning").get<std::string>();
  recorded.reply.prompt_tokens = json.at("prompt_tokens").get<int>();
  recorded.reply.reply_tokens = json.at("reply_tokens").get<int>();
  for (const Json& answer : json.at("answers")) {
    recorded.reply.answers.push_back(answer_from(answer));
  }
  return recorded;
}

// The first rule that a reply breaks, in words; nullptr when it can be used.
const char* broken_rule(const std::string& key, const RecordedReply& recorded) {
  if (recorded.sampling_seed < 0) {
    return "a sampling_seed >= 0";
  }
  if (prompt_key(recorded.prompt, recorded.sampling_seed) != key) {
    return "the key of its prompt";
  }
  Clock::Time last{0};
  for (const Answer& answer : recorded.reply.answers) {
    double sum = 0.0;
    for (const double p : answer.probability) {
      if (!(p >= 0.0)) {
        return "probabilities >= 0";
      }
      sum += p;
    }
    if (!(std::abs(sum - 1.0) < 1e-3)) {  // rounding of eight numbers
      return "probabilities that sum to 1";
    }
    if (answer.time < last || answer.time > longest_reply) {
      return "answers in the order of time, from 0 on, within a day";
    }
    last = answer.time;
  }
  return recorded.reply.answers.empty() ? "at least one answer" : nullptr;
}

}  // namespace

std::string prompt_key(std::string_view prompt, int sampling_seed) {
  Fnv hash;
  hash.add(prompt);
  if (sampling_seed != 0) {
    hash.add(fmt::format("\n{}", sampling_seed));
  }
  return fmt::format("{:016x}", hash.value());
}

std::string json_text(const RecordedReplies& replies) {
  Json list = Json::object();
  for (const auto& [key, recorded] : replies.replies) {
    list[key] = json_of(recorded);
  }
  const Json file{{"schema", schema}, {"model", replies.model}, {"replies", list}};
  return file.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Result<RecordedReplies> parse_replies(std::string_view text, std::string_view source) {
  const auto refuse = [&](std::string_view what) {
    return Error{Error::Code::malformed, fmt::format("{}: {}", source, what)};
  };
  try {
    const auto read = formats::parse_json<Json>(text);
    if (!read.has_value()) {
      return refuse(read.error().message);
    }
    const Json& file = read.value();
    if (const auto got = file.at("schema").get<std::string>(); got != schema) {
      return refuse(fmt::format("schema: want {}, got {}", schema, one_line(got)));
    }
    RecordedReplies replies{.model = file.at("model").get<std::string>(), .replies = {}};
    for (const auto& [key, json] : file.at("replies").items()) {
      RecordedReply recorded;
      try {
        recorded = reply_from(json);
      } catch (const std::exception& problem) {
        return refuse(fmt::format("replies.{}: {}", one_line(key), one_line(problem.what())));
      }
      if (const char* rule = broken_rule(key, recorded)) {
        return refuse(fmt::format("replies.{}: want {}", one_line(key), rule));
      }
      replies.replies.emplace(key, std::move(recorded));
    }
    return replies;
  } catch (const Json::exception& problem) {
    return refuse(one_line(problem.what()));
  }
}

Result<std::vector<Reply>> RecordingModel::reply_to(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const Progress&)>& progress, const AskOptions& options) {
  const Clock::Time begin = clock_.now();
  auto replies = model_.ask(scenes, deadline, progress, options);
  for (std::size_t i = 0; replies.has_value() && i < scenes.size(); ++i) {
    RecordedReply recorded{
        .prompt = scenes[i], .sampling_seed = options.sampling_seed, .reply = replies.value()[i]};
    for (Answer& answer : recorded.reply.answers) {
      answer.time -= begin;
    }
    if (!recorded.reply.answers.empty()) {
      replies_.insert_or_assign(prompt_key(scenes[i], options.sampling_seed), std::move(recorded));
    }
  }
  return replies;
}

RecordedReplies RecordingModel::recorded() const {
  return {.model = model_.description(), .replies = replies_};
}

std::optional<Error> RecordingModel::write(const std::filesystem::path& path) const {
  return write_file(path, json_text(recorded()));
}

/// What was recorded of the replies to some scenes.
struct ReplayModel::Recalled {
  struct RecordedAnswer {
    std::size_t scene = 0;
    const Reply* reply = nullptr;  ///< that it belongs to
    Answer answer;                 ///< at a time of this clock
  };
  std::vector<Reply> replies;           ///< still without what was answered
  std::vector<RecordedAnswer> answers;  ///< before the deadline, in the order of time
  bool any_known = false;               ///< one of the scenes was asked about
};

ReplayModel::Recalled ReplayModel::recall(const std::vector<std::string>& scenes, Clock::Time begin,
                                          Clock::Time deadline, int sampling_seed) const {
  Recalled recalled;
  recalled.replies.resize(scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto found = replies_.replies.find(prompt_key(scenes[i], sampling_seed));
    if (found == replies_.replies.end() || found->second.prompt != scenes[i]) {
      continue;
    }
    const Reply& reply = found->second.reply;
    recalled.any_known = true;
    recalled.replies[i].prompt_tokens = reply.prompt_tokens;
    for (Answer answer : reply.answers) {
      answer.time += begin;
      if (answer.time < deadline) {
        recalled.answers.push_back({i, &reply, answer});
      }
    }
  }
  std::stable_sort(recalled.answers.begin(), recalled.answers.end(),
                   [](const auto& a, const auto& b) { return a.answer.time < b.answer.time; });
  return recalled;
}

Result<std::vector<Reply>> ReplayModel::reply_to(
    const std::vector<std::string>& scenes, Clock::Time deadline,
    const std::function<void(const Progress&)>& progress, const AskOptions& options) {
  auto [replies, recorded_answers, any_known] =
      recall(scenes, clock_.now(), deadline, options.sampling_seed);
  bool any_answer = false;
  for (const Recalled::RecordedAnswer& next : recorded_answers) {
    if (pace_ == ReplayPace::as_recorded) {
      clock_.wait_until_or_stop(next.answer.time, options.stop);
    }
    if (options.stop.stop_requested()) {
      break;
    }
    Reply& reply = replies[next.scene];
    if (next.answer.kind != Answer::Kind::first && reply.reasoning.empty()) {
      reply.reasoning = next.reply->reasoning;
      reply.reply_tokens = next.reply->reply_tokens;
      if (!reply.reasoning.empty()) {
        progress({.prompt = next.scene, .text = reply.reasoning, .answer = nullptr});
      }
    }
    reply.answers.push_back(next.answer);
    any_answer = true;
    progress({.prompt = next.scene, .text = {}, .answer = &reply.answers.back()});
  }
  if (any_answer) {
    return std::move(replies);
  }
  return any_known ? Error{Error::Code::too_late, "replay: the recorded answers come too late"}
                   : Error{Error::Code::unreadable,
                           "replay: want a recorded prompt, got one that was never asked (key " +
                               prompt_key(scenes.front(), options.sampling_seed) + ")"};
}

}  // namespace saca::language_model
