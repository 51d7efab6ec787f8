#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "saca/thinking/language_model/child_process.h"
#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/language_model/protocol.h"

namespace saca::language_model {

struct ChildModelSettings {
  std::vector<std::string> command;  ///< the model's program and its arguments
  std::string system;                ///< system part of the prompt
  std::string identity;              ///< of the weights, for records: file name, hash
  int max_tokens = 112;              ///< of reasoning per scene: the form needs about 80
  /// Of each deadline, kept for the way between the processes [s], > 0. Processes that share two
  /// cores wait for each other this long.
  double margin = 0.06;
};

/// Figures of the last ask, as the model's process measured them.
struct ChildModelFigures {
  double load_time = 0.0;    ///< from the process's start until it was ready [s]
  int system_tokens = 0;     ///< of the system part
  double prompt_time = 0.0;  ///< [s]
  double reply_time = 0.0;   ///< [s]
};

/// The model in a process of its own, speaking the protocol of `protocol.h`.
///
/// `ask` returns before its deadline whatever that process does: dies, stops, is silent, late, or
/// talks nonsense. Then the process is killed, and begun again if it had worked before. A question
/// that is withdrawn ends within the step under way; the process that does not end it within
/// `margin` is killed, too.
class ChildModel final : public LanguageModel {
 public:
  /// Begins the process, which loads the weights while the caller goes on.
  ChildModel(ChildModelSettings settings, Clock& clock);

  /// Waits until the process is ready for questions.
  /// @return  nullopt, or why it is not (too_late, unreadable, malformed)
  [[nodiscard]] std::optional<Error> wait_until_ready(Clock::Time deadline,
                                                      const std::stop_token& stop = {});

  [[nodiscard]] std::string description() const override;

  /// What the process says of itself.
  [[nodiscard]] Result<protocol::Info> info(Clock::Time deadline);

  /// Ends the process at once; an ask under way returns. May be called from any thread. The next
  /// ask begins it again.
  void kill() noexcept { process_.kill(); }

  [[nodiscard]] std::optional<pid_t> pid() const { return process_.pid(); }
  [[nodiscard]] const ChildModelFigures& figures() const { return figures_; }
  /// How often the process was begun again.
  [[nodiscard]] int restarts() const { return restarts_; }

 private:
  [[nodiscard]] Result<std::vector<Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time deadline,
      const std::function<void(const Progress&)>& progress, const AskOptions& options) override;

  struct Exchange;

  [[nodiscard]] std::optional<Error> begin();
  [[nodiscard]] Result<protocol::Event> next_event(Clock::Time deadline,
                                                   const std::stop_token& stop = {});
  [[nodiscard]] std::optional<Error> collect(Exchange& exchange, Clock::Time deadline,
                                             const std::stop_token& stop = {});
  [[nodiscard]] std::optional<Error> withdraw(Exchange& exchange, Clock::Time deadline);
  [[nodiscard]] std::optional<Error> take(Exchange& exchange, const protocol::Event& event);
  void give_up();

  ChildModelSettings settings_;
  Clock& clock_;
  ChildProcess process_;
  bool ready_ = false;  ///< the system part is evaluated in the process that runs
  Clock::Time begun_at_{0};
  int last_id_ = 0;
  int restarts_ = -1;
  std::string model_description_;
  ChildModelFigures figures_;
};

}  // namespace saca::language_model
