#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model {

/// One model for several threads that compare what depends on its answers: scenes are put to it one
/// by one, so that no reply depends on what else is asked, and what was lately answered is not
/// asked again. Where a question has several scenes this takes longer than to put them at once.
///
/// What the machine does meanwhile must not look like something that the model said. So the time
/// that a question waits for its turn does not count; a question on which the model dies, or whose
/// reply is cut before its last answer, is put once more. Where that fails as well, or the deadline
/// cuts the reply, `failure()` tells it and no question is put any more: whoever asked throws away
/// what came of it. That an answer is malformed is something that the model said.
///
/// `ask` may be called by several threads at once. Progress is reported once, with the whole reply.
class SharedModel final : public LanguageModel {
 public:
  /// @param model  outlives this; asked by one thread at a time
  /// @param clock  the one that the model's deadlines are on
  /// @param stop   every question is withdrawn when a stop is asked for
  SharedModel(LanguageModel& model, const Clock& clock, std::stop_token stop = {})
      : model_(model), clock_(clock), stop_(std::move(stop)) {}

  [[nodiscard]] std::string description() const override { return model_.description(); }

  /// Why the model cannot be asked any more; nullopt: it can.
  [[nodiscard]] std::optional<Error> failure() const;

 private:
  struct PutQuestion {
    std::string scene;
    std::optional<int> max_tokens;
    int sampling_seed = 0;
    std::string grammar;

    auto operator<=>(const PutQuestion&) const = default;
  };

  [[nodiscard]] Result<std::vector<Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time deadline,
      const std::function<void(const Progress&)>& progress, const AskOptions& options) override;
  [[nodiscard]] Result<Reply> known_or_asked(const PutQuestion& question, Clock::Time patience,
                                             const std::stop_token& stop);
  [[nodiscard]] Result<Reply> asked(const PutQuestion& question, Clock::Time patience,
                                    const std::stop_token& stop);

  LanguageModel& model_;
  const Clock& clock_;
  std::stop_token stop_;
  mutable std::mutex mutex_;  ///< of the model and of all below
  std::optional<Error> failure_;
  std::map<PutQuestion, Result<Reply>> known_;  ///< answer times count from the question
  std::deque<PutQuestion> order_;               ///< of `known_`, oldest first
};

}  // namespace saca::language_model
