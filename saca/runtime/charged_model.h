#pragma once

#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::runtime {

/// What thinking costs in simulated time when the world waits for it (pace `lockstep`). From
/// data/thinking_costs.toml, measured.
struct ThinkingCosts {
  double preview = 0.0;       ///< forecasts and their rollouts, once per round [s], >= 0
  double verdict = 0.0;       ///< of one verdict [s], >= 0
  double prompt_token = 0.0;  ///< [s], >= 0
  double reply_token = 0.0;   ///< of one reply, all replies growing together [s], >= 0
};

/// @return  what is wrong, naming source, line and key
[[nodiscard]] Result<ThinkingCosts> read_thinking_costs(std::string_view text,
                                                        std::string_view source);

/// A language model whose thinking is charged by its tokens instead of by the time it takes: each
/// answer is dated by the tokens before it. The same model gives the same dates on any machine. An
/// answer that would have come after the deadline is dropped, and the text before it, as if they
/// had not come.
class ChargedModel final : public language_model::LanguageModel {
 public:
  /// @param model  the one that thinks, with deadlines on `real`
  /// @param clock  simulated; its time is the start of an ask, and is not moved
  ChargedModel(language_model::LanguageModel& model, const ThinkingCosts& costs, const Clock& real,
               const Clock& clock)
      : model_(model), costs_(costs), real_(real), clock_(clock) {}

  [[nodiscard]] std::string description() const override { return model_.description(); }

 private:
  [[nodiscard]] Result<std::vector<language_model::Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time deadline,
      const std::function<void(const language_model::Progress&)>& progress,
      const language_model::AskOptions& options) override;

  language_model::LanguageModel& model_;
  ThinkingCosts costs_;
  const Clock& real_;
  const Clock& clock_;
};

}  // namespace saca::runtime
