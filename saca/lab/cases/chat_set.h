#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::cases {

/// What a service for the fine-tuning of chat models takes. The numbers are those that OpenAI's
/// guide to supervised fine-tuning gave in 2026-04, of the file and of gpt-4o-mini.
struct ChatLimits {
  std::size_t least_examples = 10;
  std::size_t most_bytes = std::size_t{512} << 20U;
  int most_tokens = 65'536;  ///< of one example
};

/// What there is in a set of chats.
struct ChatSetFigures {
  std::size_t examples = 0;
  long long tokens = 0;         ///< of all, at most (language_model::tokens_at_most)
  long long learnt_tokens = 0;  ///< of these, those of the assistant
  int longest = 0;              ///< tokens of the longest example, at most
};

/// Holds a set of chats, JSON Lines, against the rules: in each line the key `messages` alone, a
/// list of { "role", "content" }, each text not empty; roles are system, user and assistant; a
/// system message is the first if there is one; somebody asks, and the assistant has the last word.
///
/// @param source  name for messages, usually the path
/// @return        malformed, naming source, line and key, what was wanted and what came; or which
///                limit is broken
[[nodiscard]] Result<ChatSetFigures> check_chat_set(std::string_view text,
                                                    const std::string& source,
                                                    const ChatLimits& limits = {});

}  // namespace saca::cases
