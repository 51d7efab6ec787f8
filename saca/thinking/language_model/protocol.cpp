#include "saca/thinking/language_model/protocol.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "saca/base/formats/json_text.h"
#include "saca/thinking/language_model/reply.h"

namespace saca::language_model::protocol {
namespace {

using Json = nlohmann::json;

constexpr double probability_rounding = 1e-3;  // of a sum of eight

// Thrown and caught in this file alone: reading is easier to follow without a check per key.
struct ParseFailure {
  std::string message;
};

[[noreturn]] void refuse(const std::string& key, const std::string& want, const Json& got) {
  std::string text = got.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 60) {
    text = text.substr(0, 60) + "...";
  }
  throw ParseFailure{key + ": want " + want + ", got " + text};
}

const Json& at(const Json& object, const std::string& key, const std::string& want) {
  const auto found = object.find(key);
  if (found == object.end()) {
    throw ParseFailure{key + ": want " + want + ", got nothing"};
  }
  return *found;
}

std::string text_at(const Json& object, const std::string& key) {
  const Json& value = at(object, key, "text");
  if (!value.is_string()) {
    refuse(key, "text", value);
  }
  return value.get<std::string>();
}

double number_at(const Json& object, const std::string& key) {
  const Json& value = at(object, key, "a number >= 0");
  const double number = value.is_number() ? value.get<double>() : -1.0;
  if (!(number >= 0.0) || !std::isfinite(number)) {
    refuse(key, "a number >= 0", value);
  }
  return number;
}

template <class Integer>
Integer count(const Json& value, const std::string& key) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<Integer>::max());
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
    refuse(key, "a whole number >= 0", value);
  }
  return static_cast<Integer>(value.get<std::uint64_t>());
}

template <class Integer>
Integer count_at(const Json& object, const std::string& key) {
  return count<Integer>(at(object, key, "a whole number >= 0"), key);
}

const Json& list_at(const Json& object, const std::string& key) {
  const Json& value = at(object, key, "a list");
  if (!value.is_array()) {
    refuse(key, "a list", value);
  }
  return value;
}

Json parsed(std::string_view line) {
  auto read = formats::parse_json(line);
  if (!read.has_value()) {
    throw ParseFailure{"line: " + read.error().message};
  }
  Json json = std::move(read).value();
  if (!json.is_object()) {
    refuse("line", "a JSON object", json);
  }
  if (const int got = count_at<int>(json, "v"); got != version) {
    refuse("v", std::to_string(version), json["v"]);
  }
  return json;
}

std::string dumped(Json json) {
  json["v"] = version;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json json_of(const Start& start) {
  return {{"cmd", "start"}, {"system", start.system}};
}
Json json_of(const Ask& ask) {
  return {{"cmd", "ask"},
          {"id", ask.id},
          {"scenes", ask.scenes},
          {"budget_s", ask.budget},
          {"max_tokens", ask.max_tokens},
          {"sampling_seed", ask.sampling_seed},
          {"grammars", ask.grammars}};
}
Json json_of(const Cancel& cancel) {
  return {{"cmd", "cancel"}, {"id", cancel.id}};
}
Json json_of(const InfoRequest&) {
  return {{"cmd", "info"}};
}
Json json_of(const Ready& ready) {
  return {{"event", "ready"},
          {"description", ready.description},
          {"system_tokens", ready.system_tokens},
          {"load_s", ready.load_time}};
}
Json json_of(const PromptRead& read) {
  return {{"event", "prompt"}, {"id", read.id}, {"scene", read.scene}, {"tokens", read.tokens}};
}
Json json_of(const Text& text) {
  return {{"event", "text"}, {"id", text.id}, {"scene", text.scene}, {"text", text.text}};
}
Json json_of(const AnswerMessage& answer) {
  return {{"event", "answer"},
          {"id", answer.id},
          {"scene", answer.scene},
          {"kind", name(answer.kind)},
          {"probability", answer.probability}};
}
Json json_of(const Done& done) {
  return {{"event", "done"},
          {"id", done.id},
          {"reply_tokens", done.reply_tokens},
          {"prompt_s", done.prompt_time},
          {"reply_s", done.reply_time},
          {"overran", done.overran}};
}
Json json_of(const Info& info) {
  return {{"event", "info"},
          {"description", info.description},
          {"file", info.file},
          {"weight_bytes", info.weight_bytes},
          {"resident_bytes", info.resident_bytes},
          {"threads", info.threads}};
}
Json json_of(const FailureMessage& failed) {
  Json json{{"event", "error"}, {"message", failed.message}};
  if (failed.id) {
    json["id"] = *failed.id;
  }
  if (failed.late) {
    json["late"] = true;
  }
  return json;
}

std::vector<std::string> texts_at(const Json& json, const std::string& key) {
  std::vector<std::string> texts;
  for (const Json& text : list_at(json, key)) {
    if (!text.is_string()) {
      refuse(key, "texts", text);
    }
    texts.push_back(text.get<std::string>());
  }
  return texts;
}

Ask ask_from(const Json& json) {
  Ask ask{.id = count_at<int>(json, "id"),
          .scenes = texts_at(json, "scenes"),
          .budget = number_at(json, "budget_s"),
          .max_tokens = count_at<int>(json, "max_tokens")};
  if (json.contains("sampling_seed")) {
    ask.sampling_seed = count_at<int>(json, "sampling_seed");
  }
  if (json.contains("grammars")) {
    ask.grammars = texts_at(json, "grammars");
  }
  return ask;
}

bool flag_at(const Json& json, const std::string& key) {
  const Json& flag = at(json, key, "true or false");
  if (!flag.is_boolean()) {
    refuse(key, "true or false", flag);
  }
  return flag.get<bool>();
}

AnswerMessage answer_from(const Json& json) {
  AnswerMessage answer{.id = count_at<int>(json, "id"),
                       .scene = count_at<std::size_t>(json, "scene")};
  const std::string kind = text_at(json, "kind");
  const auto found = answer_kind_from(kind);
  if (!found) {
    refuse("kind", "first, ended or forced", json["kind"]);
  }
  answer.kind = *found;
  const Json& list = list_at(json, "probability");
  double sum = 0.0;
  for (std::size_t i = 0; i < list.size() && i < answer.probability.size(); ++i) {
    if (!list[i].is_number() || !(list[i].get<double>() >= 0.0)) {
      refuse("probability", "numbers >= 0", list);
    }
    answer.probability[i] = list[i].get<double>();
    sum += answer.probability[i];
  }
  if (list.size() != answer.probability.size() || !(std::abs(sum - 1.0) < probability_rounding)) {
    refuse("probability", "eight that sum to 1", list);
  }
  return answer;
}

Done done_from(const Json& json) {
  Done done{.id = count_at<int>(json, "id"),
            .reply_tokens = {},
            .prompt_time = number_at(json, "prompt_s"),
            .reply_time = number_at(json, "reply_s")};
  for (const Json& tokens : list_at(json, "reply_tokens")) {
    done.reply_tokens.push_back(count<int>(tokens, "reply_tokens"));
  }
  done.overran = flag_at(json, "overran");
  return done;
}

Event read_event(const Json& json) {
  const std::string event = text_at(json, "event");
  if (event == "ready") {
    return Ready{text_at(json, "description"), count_at<int>(json, "system_tokens"),
                 number_at(json, "load_s")};
  }
  if (event == "prompt") {
    return PromptRead{count_at<int>(json, "id"), count_at<std::size_t>(json, "scene"),
                      count_at<int>(json, "tokens")};
  }
  if (event == "text") {
    return Text{count_at<int>(json, "id"), count_at<std::size_t>(json, "scene"),
                text_at(json, "text")};
  }
  if (event == "answer") {
    return answer_from(json);
  }
  if (event == "done") {
    return done_from(json);
  }
  if (event == "info") {
    return Info{text_at(json, "description"), text_at(json, "file"),
                count_at<std::uint64_t>(json, "weight_bytes"),
                count_at<std::uint64_t>(json, "resident_bytes"), count_at<int>(json, "threads")};
  }
  if (event == "error") {
    FailureMessage failed{.id = std::nullopt, .message = text_at(json, "message")};
    if (json.contains("id")) {
      failed.id = count_at<int>(json, "id");
    }
    if (json.contains("late")) {
      failed.late = flag_at(json, "late");
    }
    return failed;
  }
  refuse("event", "ready, prompt, text, answer, done, info or error", json["event"]);
}

Request read_request(const Json& json) {
  const std::string command = text_at(json, "cmd");
  if (command == "start") {
    return Start{text_at(json, "system")};
  }
  if (command == "ask") {
    return ask_from(json);
  }
  if (command == "cancel") {
    return Cancel{count_at<int>(json, "id")};
  }
  if (command == "info") {
    return InfoRequest{};
  }
  refuse("cmd", "start, ask, cancel or info", json["cmd"]);
}

}  // namespace

std::string line(const Request& request) {
  return std::visit([](const auto& r) { return dumped(json_of(r)); }, request);
}

std::string line(const Event& event) {
  return std::visit([](const auto& e) { return dumped(json_of(e)); }, event);
}

Result<Request> request_from(std::string_view line) {
  try {
    return read_request(parsed(line));
  } catch (const ParseFailure& bad) {
    return Error{Error::Code::malformed, "request: " + bad.message};
  }
}

Result<Event> event_from(std::string_view line) {
  try {
    return read_event(parsed(line));
  } catch (const ParseFailure& bad) {
    return Error{Error::Code::malformed, "event: " + bad.message};
  }
}

}  // namespace saca::language_model::protocol
