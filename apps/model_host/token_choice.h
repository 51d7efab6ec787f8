#pragma once

#include <llama.h>

#include <memory>
#include <optional>
#include <string>

#include "saca/base/core/result.h"

namespace saca::model_host {

/// Chooses a reply's tokens, one after the other: the likeliest, or drawn ones, of those that a
/// grammar allows.
class TokenChoice {
 public:
  /// @param grammar  in llama.cpp's notation (GBNF), its first rule `root`; empty: anything may be
  ///                 written
  /// @param seed     0: the likeliest token at every place; else as AskOptions has it
  /// @return         malformed where the grammar cannot be read
  [[nodiscard]] static Result<TokenChoice> make(const llama_vocab* vocab,
                                                const std::string& grammar, int seed);

  /// The next token of the text.
  /// @param logits  of every token
  /// @return        the end of the text where the grammar allows nothing
  [[nodiscard]] llama_token next(const float* logits);

 private:
  using Sampler = std::unique_ptr<llama_sampler, decltype(&llama_sampler_free)>;

  explicit TokenChoice(const llama_vocab* vocab) : vocab_(vocab) {}

  [[nodiscard]] bool is_allowed(llama_token token) const;
  /// nullopt: nothing is allowed.
  [[nodiscard]] std::optional<llama_token> chosen(const float* logits);

  const llama_vocab* vocab_;
  Sampler grammar_{nullptr, &llama_sampler_free};  ///< nullptr: none
  Sampler draw_{nullptr, &llama_sampler_free};     ///< nullptr: the likeliest
};

}  // namespace saca::model_host
