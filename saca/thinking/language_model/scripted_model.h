#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model {

/// Something that a scripted model says.
struct ScriptedLine {
  Clock::Time after{0};                ///< the question, >= 0
  std::string text;                    ///< may be empty
  std::optional<Answer::Kind> answer;  ///< of an answer, after the text
  manoeuvre::PolicyId policy{};        ///< that it chooses
  double probability = 1.0;            ///< of that one; the others share the rest
};

/// All that it says about one scene, in the order of time.
struct ScriptedReply {
  std::vector<ScriptedLine> lines;  ///< none: never a word
  int prompt_tokens = 0;
  int reply_tokens = 0;
  std::optional<Error> error;  ///< the question fails with it at once
};

/// Says what the code that made it tells it to, on its clock: for tests of what asks a model. Waits
/// for each line; where the last answer is missing, until 1 ms before the deadline.
class ScriptedModel final : public LanguageModel {
 public:
  using Script = std::function<ScriptedReply(const std::string& scene)>;

  ScriptedModel(Script script, Clock& clock) : script_(std::move(script)), clock_(clock) {}
  /// The same about every scene.
  ScriptedModel(ScriptedReply reply, Clock& clock)
      : ScriptedModel([reply = std::move(reply)](const std::string&) { return reply; }, clock) {}
  /// One answer at once, certain.
  ScriptedModel(manoeuvre::PolicyId policy, Clock& clock)
      : ScriptedModel(ScriptedReply{.lines = {{.answer = Answer::Kind::first, .policy = policy}}},
                      clock) {}

  [[nodiscard]] std::string description() const override { return "script"; }

  /// How often it was asked, and what the last time.
  [[nodiscard]] int num_asked() const { return num_asked_; }
  [[nodiscard]] const std::vector<std::string>& last_scenes() const { return last_scenes_; }
  [[nodiscard]] const std::vector<std::string>& last_grammars() const { return last_grammars_; }
  [[nodiscard]] Clock::Time last_deadline() const { return last_deadline_; }

 private:
  [[nodiscard]] Result<std::vector<Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time deadline,
      const std::function<void(const Progress&)>& progress, const AskOptions& options) override;

  Script script_;
  Clock& clock_;
  int num_asked_ = 0;
  std::vector<std::string> last_scenes_;
  std::vector<std::string> last_grammars_;
  Clock::Time last_deadline_{0};
};

}  // namespace saca::language_model
