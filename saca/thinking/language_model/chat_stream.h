#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::language_model {

/// A question to a server with `/chat/completions`.
struct ChatQuestion {
  std::string_view model;
  std::string_view system;
  std::string_view scene;
  int max_tokens = 0;
  int sampling_seed = 0;  ///< as AskOptions has it
  /// As OpenAI's newer models want it: `max_completion_tokens`, and no temperature.
  bool newer = false;
};

/// The request's body: streamed, with its token counts. Without chance (temperature 0), or with
/// `sampling_temperature` and the seed; in the newer form without a temperature.
[[nodiscard]] std::string json_text(const ChatQuestion& question);

/// What a server says in the body of a refusal: its message where the body is JSON that has one,
/// else the body.
[[nodiscard]] std::string server_message(std::string_view body);

/// What a server sends to a question, read while it comes: lines `data: {...}`, at the end
/// `data: [DONE]`; comments and other fields are skipped, unknown keys too.
class ChatStream {
 public:
  /// @param bytes  the next ones, cut anywhere
  /// @return       the text in them, whole characters; unreadable, saying what was wanted and what
  ///               came, when a line has over 256 KiB, the whole text over 64 KiB, an event is no
  ///               JSON of this kind or reports a failure. Nothing more is taken then.
  [[nodiscard]] Result<std::string> take(std::string_view bytes);

  /// Everything said so far.
  [[nodiscard]] const std::string& text() const { return text_; }
  /// The text has come to its end, by the server's own word.
  [[nodiscard]] bool finished() const { return finished_; }
  /// It has, and nothing follows.
  [[nodiscard]] bool done() const { return done_; }
  /// `max_tokens` cut the text.
  [[nodiscard]] bool cut() const { return cut_; }
  /// Of the question and of the text, where the server counts them, else 0.
  [[nodiscard]] int prompt_tokens() const { return prompt_tokens_; }
  [[nodiscard]] int reply_tokens() const { return reply_tokens_; }
  /// The first bytes that came, for messages.
  [[nodiscard]] const std::string& head() const { return head_; }

 private:
  [[nodiscard]] std::string problem_in(std::string_view data);

  std::string line_;  ///< begun, without its end
  std::string head_;
  std::string text_;
  bool finished_ = false;
  bool done_ = false;
  bool cut_ = false;
  int prompt_tokens_ = 0;
  int reply_tokens_ = 0;
};

}  // namespace saca::language_model
