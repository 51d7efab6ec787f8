#include "token_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "saca/thinking/language_model/language_model.h"
#include "tokens.h"
#include "utf8.h"

namespace saca::model_host {
namespace {

// Of the likeliest tokens that make up this much of the probability one is drawn: the rest is what
// nobody would write.
constexpr float nucleus = 0.95F;

// Figures, hyphens and stops are tokens by themselves: statements have 2.2 to 2.6 bytes a token.
constexpr std::size_t bytes_a_token = 2;

llama_sampler* drawing(int seed) {
  llama_sampler* const chain = llama_sampler_chain_init(llama_sampler_chain_default_params());
  const auto temperature = static_cast<float>(language_model::sampling_temperature);
  llama_sampler_chain_add(chain, llama_sampler_init_top_p(nucleus, 1));
  llama_sampler_chain_add(chain, llama_sampler_init_temp(temperature));
  llama_sampler_chain_add(chain, llama_sampler_init_dist(static_cast<std::uint32_t>(seed)));
  return chain;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Whether a token that ends with this byte may be a longer one with one of those behind it. The
// tokeniser of SmolLM2 never joins a digit, or letters with what is none; a space it joins with
// what follows. Of another one this may be false: then a text is cut in a way that the model would
// not have chosen, and is what the grammar forces all the same.
bool may_grow(char last, std::string_view next) {
  return !is_digit(last) && std::any_of(next.begin(), next.end(), [last](char c) {
    return is_letter(last) == is_letter(c) || last == ' ';
  });
}

llama_token likeliest(const float* logits, int count) {
  return static_cast<llama_token>(std::max_element(logits, logits + count) - logits);
}

}  // namespace

Result<TokenChoice> TokenChoice::make(const llama_vocab* vocab, const std::string& grammar,
                                      int seed) {
  TokenChoice choice(vocab);
  if (!grammar.empty()) {
    choice.grammar_.reset(llama_sampler_init_grammar(vocab, grammar.c_str(), "root"));
    if (choice.grammar_ == nullptr) {
      return Error{Error::Code::malformed, "grammar: want GBNF with a rule root, cannot read it"};
    }
    choice.walk_ = language_model::GrammarWalk::make(grammar);
  }
  if (seed != 0) {
    choice.draw_.reset(drawing(seed));
  }
  return choice;
}

llama_token TokenChoice::next(const float* logits) {
  const std::optional<llama_token> token = chosen(logits);
  if (token) {
    take(*token);
  }
  return token.value_or(llama_vocab_eos(vocab_));
}

void TokenChoice::take(llama_token token) {
  for (llama_sampler* const one : {draw_.get(), grammar_.get()}) {
    if (one != nullptr) {
      llama_sampler_accept(one, token);
    }
  }
  if (walk_) {
    const std::string piece = piece_of(vocab_, token);
    walk_->take(piece);
    text_ += piece;
    tokens_.push_back(token);
  }
}

std::vector<llama_token> TokenChoice::forced() {
  const std::string text = walk_ ? text_ + walk_->forced(rest_) : "";
  // Up to the last whole character: no tokeniser has a part of one.
  const std::string whole = Utf8Splitter().take(text);
  if (whole.size() <= text_.size()) {
    return {};
  }
  std::vector<llama_token> all = tokens_of(vocab_, whole, false);
  language_model::GrammarWalk behind = *walk_;
  behind.take(std::string_view(whole).substr(text_.size()));
  // Who chose tokens in another way than the tokeniser would goes on alone.
  if (all.size() <= tokens_.size() || !std::equal(tokens_.begin(), tokens_.end(), all.begin()) ||
      text_of(vocab_, all) != whole) {
    return {};
  }
  const std::ptrdiff_t kept = may_grow(whole.back(), behind.possible(rest_)) ? 1 : 0;
  std::vector<llama_token> tokens(all.begin() + static_cast<std::ptrdiff_t>(tokens_.size()),
                                  all.end() - kept);
  for (const llama_token token : tokens) {
    take(token);
  }
  return tokens;
}

std::optional<std::size_t> TokenChoice::brief_tokens() const {
  return walk_ ? std::optional((walk_->longest_brief() + bytes_a_token - 1) / bytes_a_token)
               : std::nullopt;
}

bool TokenChoice::is_allowed(llama_token token) const {
  llama_token_data one{token, 0.0F, 0.0F};
  llama_token_data_array alone{&one, 1, -1, false};
  llama_sampler_apply(grammar_.get(), &alone);
  return std::isfinite(one.logit);
}

std::optional<llama_token> TokenChoice::chosen(const float* logits) {
  const int count = llama_vocab_n_tokens(vocab_);
  if (draw_ == nullptr) {
    const llama_token best = likeliest(logits, count);
    if (grammar_ == nullptr || is_allowed(best)) {
      return best;
    }
  }
  std::vector<llama_token_data> all(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    all[static_cast<std::size_t>(i)] = {i, logits[i], 0.0F};
  }
  llama_token_data_array candidates{all.data(), all.size(), -1, false};
  if (grammar_ != nullptr) {
    llama_sampler_apply(grammar_.get(), &candidates);
  }
  const auto* const best =
      std::max_element(all.data(), all.data() + all.size(),
                       [](const auto& a, const auto& b) { return a.logit < b.logit; });
  if (!std::isfinite(best->logit)) {
    return std::nullopt;
  }
  if (draw_ == nullptr) {
    return best->id;
  }
  llama_sampler_apply(draw_.get(), &candidates);
  return candidates.data[candidates.selected].id;
}

}  // namespace saca::model_host
