#include "saca/lab/cases/chat_set.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "saca/base/formats/json_reader.h"
#include "saca/thinking/language_model/token_bound.h"

namespace saca::cases {
namespace {

using formats::JsonReader;
using nlohmann::json;

/// One message, read.
struct Message {
  std::string role;
  int tokens = 0;
};

Message message_from(JsonReader reader, std::size_t number) {
  Message message{.role = reader.text("role"), .tokens = 0};
  const std::string content = reader.text("content");
  if (message.role != "system" && message.role != "user" && message.role != "assistant") {
    reader.reject("role", "want system, user or assistant, got \"" + message.role + "\"");
  }
  if (message.role == "system" && number > 0) {
    reader.reject("role", "want the system's message first");
  }
  if (content.find_first_not_of(" \t\r\n") == std::string::npos) {
    reader.reject("content", "want a text, got none");
  }
  reader.refuse_others();
  message.tokens = language_model::tokens_at_most(content);
  return message;
}

/// Adds one example to the figures.
std::optional<Error> add(ChatSetFigures& figures, const json& line, int most_tokens) {
  std::optional<Error> problem;
  JsonReader reader(line, "", problem, "example");
  const json* const list = reader.list("messages");
  int tokens = 0;
  bool somebody_asks = false;
  std::string last;
  for (std::size_t i = 0; list != nullptr && i < list->size() && !problem; ++i) {
    const Message message = message_from(reader.element("messages", *list, i), i);
    tokens += message.tokens;
    figures.learnt_tokens += message.role == "assistant" ? message.tokens : 0;
    somebody_asks = somebody_asks || message.role == "user";
    last = message.role;
  }
  reader.refuse_others();
  if (list != nullptr && !somebody_asks) {
    reader.reject("messages", "want one of the user");
  }
  if (list != nullptr && last != "assistant") {
    reader.reject("messages", "want the assistant's at the end");
  }
  if (tokens > most_tokens) {
    reader.reject("messages",
                  fmt::format("want at most {} tokens, got up to {}", most_tokens, tokens));
  }
  ++figures.examples;
  figures.tokens += tokens;
  figures.longest = std::max(figures.longest, tokens);
  return problem;
}

}  // namespace

Result<ChatSetFigures> check_chat_set(std::string_view text, const std::string& source,
                                      const ChatLimits& limits) {
  if (text.size() > limits.most_bytes) {
    return Error{Error::Code::malformed, fmt::format("{}: want at most {} bytes, got {}", source,
                                                     limits.most_bytes, text.size())};
  }
  ChatSetFigures figures;
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    const json document = json::parse(line, nullptr, false);
    if (!document.is_object()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: want an object of JSON", source, number)};
    }
    if (const auto problem = add(figures, document, limits.most_tokens)) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: {}", source, number, problem->message)};
    }
  }
  if (figures.examples < limits.least_examples) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want at least {} examples, got {}", source, limits.least_examples,
                             figures.examples)};
  }
  return figures;
}

}  // namespace saca::cases
