#pragma once

#include <llama.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/thinking/language_model/grammar_walk.h"

namespace saca::model_host {

/// Chooses a reply's tokens, one after the other: the likeliest, or drawn ones, of those that a
/// grammar allows. Where it allows one text only, nobody need be asked: its tokens are all known at
/// once.
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

  /// The tokens that must come next whatever the logits are, as the tokeniser cuts the text; they
  /// count as chosen. None where the grammar leaves a choice, and where it is written in more of
  /// the notation than `GrammarWalk` knows.
  [[nodiscard]] std::vector<llama_token> forced();

  /// From here on `forced` leaves out what may be left out (GrammarWalk::Rest::brief), as long as
  /// the text can be followed. What is chosen is not narrowed: a grammar whose conclusions begin
  /// alike leaves nothing else to choose.
  void be_brief() { rest_ = language_model::GrammarWalk::Rest::brief; }

  /// Of how many tokens the rest of the text is, nearly at most, if it is brief from here on;
  /// nullopt where it cannot be followed.
  [[nodiscard]] std::optional<std::size_t> brief_tokens() const;

 private:
  using Sampler = std::unique_ptr<llama_sampler, decltype(&llama_sampler_free)>;

  explicit TokenChoice(const llama_vocab* vocab) : vocab_(vocab) {}

  void take(llama_token token);
  [[nodiscard]] bool is_allowed(llama_token token) const;
  /// nullopt: nothing is allowed.
  [[nodiscard]] std::optional<llama_token> chosen(const float* logits);

  const llama_vocab* vocab_;
  Sampler grammar_{nullptr, &llama_sampler_free};    ///< nullptr: none
  Sampler draw_{nullptr, &llama_sampler_free};       ///< nullptr: the likeliest
  std::optional<language_model::GrammarWalk> walk_;  ///< nullopt: nothing is known to be forced
  std::string text_;                                 ///< so far, where there is a walk
  std::vector<llama_token> tokens_;                  ///< of it
  language_model::GrammarWalk::Rest rest_ = language_model::GrammarWalk::Rest::any;
};

}  // namespace saca::model_host
