#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::model_host {

/// How the weights are run.
struct EngineSettings {
  std::string model_path;    ///< a GGUF file whose chat form is <|im_start|> ... <|im_end|>
  int threads = 2;           ///< > 0
  int context = 1536;        ///< room for the tokens of the system part, one scene and its reply
  double temperature = 1.0;  ///< by which the logits of the answers are divided, > 0
  /// At real pace: one thread where others want the cores (thread_choice.h), brief replies where
  /// time is short. Without, only the deadline itself decides what a reply is.
  bool gives_way = false;
  /// Prompts are read faster on some processors, tokens of a reply made at half the speed on all
  /// that were measured: which is worth it is measured at set-up.
  bool flash_attention = false;
};

using AnswerKind = language_model::Answer::Kind;

/// What happens while scenes are thought about; called on the asking thread.
struct EngineEvents {
  std::function<void(std::size_t scene, int tokens)> prompt_read;
  std::function<void(std::size_t scene, std::string_view text)> text;  ///< whole UTF-8 characters
  std::function<void(std::size_t scene, AnswerKind kind, const std::vector<double>& log_weight)>
      answer;  ///< one logit for each digit 0 to 7
  /// Looked at many times in each step; true ends the ask as if its deadline had come. May be
  /// empty.
  std::function<bool()> is_cancelled = {};
};

/// What the replies are to be like.
struct ReplyForm {
  int max_tokens = 0;                      ///< of reasoning, >= 0
  int sampling_seed = 0;                   ///< as language_model::AskOptions has it
  std::vector<std::string> grammars = {};  ///< as language_model::AskOptions has them
};

/// Figures of one `ask`.
struct AskFigures {
  std::vector<int> prompt_tokens;  ///< one per scene, 0 where the prompt was not evaluated
  std::vector<int> reply_tokens;   ///< one per scene
  double prompt_seconds = 0.0;     ///< spent in evaluating prompts [s]
  double reply_seconds = 0.0;      ///< spent in steps of reasoning [s]
  bool overran = false;            ///< the deadline passed before the last answer was there
};

constexpr std::size_t max_scenes = language_model::most_scenes;
constexpr std::size_t num_answers = manoeuvre::num_policies;

/// A language model in this process, through llama.cpp. The same weights, system part, scenes,
/// grammars, sampling seed and order of calls give the same text; the deadline decides only where
/// it is cut. Where it gives way, it decides also from where on a reply is brief, and the last bits
/// of a probability may differ.
class Engine {
 public:
  /// @return  Error::Code::unreadable or malformed, naming the file
  [[nodiscard]] static Result<std::shared_ptr<Engine>> load(const EngineSettings& settings);

  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine();

  /// Evaluates the part of the prompt that all scenes share; it stays evaluated. Then rehearses a
  /// short ask, so that the first real one knows what its steps cost.
  /// @return  its number of tokens, or an error when it does not fit
  [[nodiscard]] Result<int> set_system(std::string_view text, Clock& clock);

  /// Thinks about up to three scenes until each reply has ended, its tokens are used up, or the
  /// deadline leaves just the time to read the final answers: that reserve follows what the last
  /// steps cost.
  ///
  /// For each scene in turn the prompt is evaluated and, with it, its first answer read; then all
  /// reason together; each final answer is read from the eight digits' logits after what was
  /// generated. Where it gives way and there is no time for a further statement, replies that are
  /// held to a grammar leave out what it lets them (GrammarWalk::Rest::brief).
  ///
  /// @return  malformed when a prompt does not fit, a grammar cannot be read or no system part is
  ///          set
  [[nodiscard]] Result<AskFigures> ask(const std::vector<std::string>& scenes, Clock::Time deadline,
                                       const ReplyForm& form, Clock& clock,
                                       const EngineEvents& events);

  /// What the file says of itself: name and type of weights, e.g. "SmolLM2 135M, Q8_0".
  [[nodiscard]] std::string description() const;
  /// Bytes of the weights [B].
  [[nodiscard]] std::uint64_t weight_bytes() const;

 private:
  struct State;
  explicit Engine(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace saca::model_host
