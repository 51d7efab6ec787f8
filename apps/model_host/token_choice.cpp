#include "token_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "saca/thinking/language_model/language_model.h"

namespace saca::model_host {
namespace {

// Of the likeliest tokens that make up this much of the probability one is drawn: the rest is what
// nobody would write.
constexpr float nucleus = 0.95F;

llama_sampler* drawing(int seed) {
  llama_sampler* const chain = llama_sampler_chain_init(llama_sampler_chain_default_params());
  const auto temperature = static_cast<float>(language_model::sampling_temperature);
  llama_sampler_chain_add(chain, llama_sampler_init_top_p(nucleus, 1));
  llama_sampler_chain_add(chain, llama_sampler_init_temp(temperature));
  llama_sampler_chain_add(chain, llama_sampler_init_dist(static_cast<std::uint32_t>(seed)));
  return chain;
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
  }
  if (seed != 0) {
    choice.draw_.reset(drawing(seed));
  }
  return choice;
}

llama_token TokenChoice::next(const float* logits) {
  const std::optional<llama_token> token = chosen(logits);
  for (llama_sampler* const one : {draw_.get(), grammar_.get()}) {
    if (token && one != nullptr) {
      llama_sampler_accept(one, *token);
    }
  }
  return token.value_or(llama_vocab_eos(vocab_));
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
