#pragma once

#include <llama.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace saca::model_host {

/// @param with_special  whether markers of the chat form are read as such, not as plain text
[[nodiscard]] inline std::vector<llama_token> tokens_of(const llama_vocab* vocab,
                                                        std::string_view text, bool with_special) {
  std::vector<llama_token> tokens(text.size() + 8);
  const int n =
      llama_tokenize(vocab, text.data(), static_cast<std::int32_t>(text.size()), tokens.data(),
                     static_cast<std::int32_t>(tokens.size()), false, with_special);
  tokens.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  return tokens;
}

/// A token's bytes; they may end within a character.
[[nodiscard]] inline std::string piece_of(const llama_vocab* vocab, llama_token token) {
  std::array<char, 256> buffer{};
  const int n = llama_token_to_piece(vocab, token, buffer.data(),
                                     static_cast<std::int32_t>(buffer.size()), 0, false);
  return n > 0 ? std::string(buffer.data(), static_cast<std::size_t>(n)) : std::string();
}

[[nodiscard]] inline std::string text_of(const llama_vocab* vocab,
                                         const std::vector<llama_token>& tokens) {
  std::string text;
  for (const llama_token token : tokens) {
    text += piece_of(vocab, token);
  }
  return text;
}

}  // namespace saca::model_host
