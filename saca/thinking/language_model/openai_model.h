#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model {

struct OpenAiModelSettings {
  std::string url;          ///< of the server: "https://api.openai.com/v1"
  std::string model;        ///< its name there
  std::string key;          ///< sent as bearer token, shown nowhere; empty: none
  std::string system;       ///< system part of the prompt
  int max_tokens = 160;     ///< of text per scene, > 0
  std::string authorities;  ///< file of certificates (PEM) to trust; empty: the system's
  /// Of each deadline, kept for the way back [s], > 0: the last packet is read, connections end.
  double margin = 0.06;
};

/// A model behind `/v1/chat/completions`: OpenAI, vLLM, llama-server, Ollama and others.
///
/// One streamed request per scene, all at once, on the thread that asks; names of hosts are looked
/// up by a thread of libcurl's, which nobody waits for. Connections are kept for the next question.
///
/// There are no logits: the answer is the policy that the text names in its last
/// "Response to user: N", with probability 1. That is no measure of certainty. Its kind is `ended`
/// where the text came to its end, `forced` where deadline or `max_tokens` cut it. A text that
/// breaks off otherwise has no answer.
///
/// A server that refuses `max_tokens` or a temperature, as OpenAI's newer models do, is asked
/// without them, at once and from then on.
///
/// Asked again, after 50 ms, then after twice as long each time, or when the server says: busy
/// servers (429, 500, 502 to 504) and connections that failed before any text. A server that took
/// no connection in seven tries is given up until the next question. Neither redirects nor proxies
/// are followed: the key goes to the named host only. No environment is read.
///
/// Settings that cannot be used make every question fail (malformed). Messages are one line and
/// hold neither key nor password.
class OpenAiModel final : public LanguageModel {
 public:
  OpenAiModel(OpenAiModelSettings settings, Clock& clock);
  ~OpenAiModel() override;

  /// "MODEL at URL"
  [[nodiscard]] std::string description() const override;

 private:
  [[nodiscard]] Result<std::vector<Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time deadline,
      const std::function<void(const Progress&)>& progress, const AskOptions& options) override;

  struct Connections;
  struct Call;
  class Exchange;

  OpenAiModelSettings settings_;
  Clock& clock_;
  std::string address_;           ///< where questions go; empty when `refusal_` is there
  std::string shown_;             ///< likewise, for messages
  std::optional<Error> refusal_;  ///< why these settings cannot be used
  std::unique_ptr<Connections> connections_;
};

}  // namespace saca::language_model
