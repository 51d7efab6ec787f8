#include "saca/thinking/language_model/chat_stream.h"

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "saca/base/formats/json_text.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model {
namespace {

using ChatJson = nlohmann::ordered_json;

constexpr std::size_t longest_text = 1U << 16U;         // bytes; a reply has a few hundred
constexpr std::size_t longest_stream_line = 1U << 18U;  // bytes; an event has a few hundred
constexpr std::size_t longest_head = 1U << 12U;         // bytes; a message shows 200 characters

// Objects lack keys, and keys are null: both say nothing.
const ChatJson* member(const ChatJson& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  return found == json.end() || found->is_null() ? nullptr : &*found;
}

// @return  nullopt where the key is there and no text; empty where it is not there
std::optional<std::string> text_at(const ChatJson& json, const char* key) {
  const ChatJson* value = member(json, key);
  if (value == nullptr) {
    return std::string();
  }
  return value->is_string() ? std::optional(value->get<std::string>()) : std::nullopt;
}

// @return  nullopt where the key is there and no count; 0 where it is not there
std::optional<int> count_at(const ChatJson& json, const char* key) {
  const ChatJson* value = member(json, key);
  if (value == nullptr) {
    return 0;
  }
  if (!value->is_number_unsigned() ||
      value->get<std::uint64_t>() > std::uint64_t{std::numeric_limits<int>::max()}) {
    return std::nullopt;
  }
  return value->get<int>();
}

// As OpenAI, vLLM, llama-server, Ollama and FastAPI send it.
std::optional<std::string> message_in(const ChatJson& json) {
  for (const char* key : {"error", "message", "detail"}) {
    if (const ChatJson* value = member(json, key)) {
      return value->is_string()   ? value->get<std::string>()
             : value->is_object() ? message_in(*value)
                                  : std::nullopt;
    }
  }
  return std::nullopt;
}

std::string without_spaces(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  return begin == std::string_view::npos
             ? std::string()
             : std::string(text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1));
}

}  // namespace

std::string json_text(const ChatQuestion& question) {
  ChatJson body{{"model", question.model},
                {"messages",
                 {{{"role", "system"}, {"content", question.system}},
                  {{"role", "user"}, {"content", question.scene}}}},
                {question.newer ? "max_completion_tokens" : "max_tokens", question.max_tokens},
                {"stream", true},
                {"stream_options", {{"include_usage", true}}}};
  const bool sampled = question.sampling_seed != 0;
  if (sampled) {
    body["seed"] = question.sampling_seed;
  }
  if (!question.newer) {
    body["temperature"] = sampled ? ChatJson(sampling_temperature) : ChatJson(0);
  }
  return body.dump(-1, ' ', false, ChatJson::error_handler_t::replace);
}

std::string server_message(std::string_view body) {
  const auto json = formats::parse_json<ChatJson>(body);
  return (json.has_value() ? message_in(json.value()) : std::nullopt).value_or(std::string(body));
}

// Takes one event.
// @return  what is wrong with it; empty when nothing is
std::string ChatStream::problem_in(std::string_view data) {
  const auto read = formats::parse_json<ChatJson>(data);
  if (!read.has_value() || !read.value().is_object()) {
    return "want a JSON object in each event, got " + std::string(data);
  }
  const ChatJson& event = read.value();
  if (member(event, "error") != nullptr) {
    return "want text, got " + server_message(data);
  }
  const ChatJson* choices = member(event, "choices");
  if (choices == nullptr || !choices->is_array()) {
    return "choices: want a list, got " + std::string(data);
  }
  if (const ChatJson* usage = member(event, "usage")) {
    const auto prompt = count_at(*usage, "prompt_tokens");
    const auto reply = count_at(*usage, "completion_tokens");
    if (!usage->is_object() || !prompt || !reply) {
      return "usage: want counts, got " + std::string(data);
    }
    prompt_tokens_ = *prompt;
    reply_tokens_ = *reply;
  }
  if (choices->empty()) {
    return {};  // counts come alone
  }
  const ChatJson& choice = choices->front();
  const ChatJson* delta = member(choice, "delta");
  if (!choice.is_object() || (delta != nullptr && !delta->is_object())) {
    return "choices[0].delta: want an object, got " + std::string(data);
  }
  const auto content = delta == nullptr ? std::string() : text_at(*delta, "content");
  const auto reason = text_at(choice, "finish_reason");
  if (!content || !reason) {
    return "delta.content and finish_reason: want texts, got " + std::string(data);
  }
  if (text_.size() + content->size() > longest_text) {
    return "want at most 64 KiB of text, got more";
  }
  text_ += *content;
  finished_ = finished_ || !reason->empty();
  cut_ = cut_ || *reason == "length";
  return {};
}

Result<std::string> ChatStream::take(std::string_view bytes) {
  head_ += bytes.substr(0, longest_head - head_.size());
  const std::size_t known = text_.size();
  while (!bytes.empty() && !done_) {
    const std::size_t end = bytes.find('\n');
    line_ += bytes.substr(0, end);
    if (line_.size() > longest_stream_line) {
      return Error{Error::Code::unreadable, "want lines of at most 256 KiB, got a longer one"};
    }
    if (end == std::string_view::npos) {
      break;
    }
    bytes.remove_prefix(end + 1);
    if (line_.starts_with("data:")) {
      const std::string data = without_spaces(std::string_view(line_).substr(5));
      done_ = data == "[DONE]";
      finished_ = finished_ || done_;
      const std::string problem = done_ || data.empty() ? std::string() : problem_in(data);
      if (!problem.empty()) {
        return Error{Error::Code::unreadable, problem};
      }
    }
    line_.clear();
  }
  return text_.substr(known);
}

}  // namespace saca::language_model
