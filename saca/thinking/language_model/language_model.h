#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/base/core/contract.h"
#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::language_model {

/// One look at the eight answer tokens while a reply grows.
struct Answer {
  Clock::Time time{0};  ///< when it was there
  std::array<double, manoeuvre::num_policies>
      probability{};  ///< over the eight policies; sums to 1
  enum class Kind : std::uint8_t {
    first,   ///< right after the prompt
    ended,   ///< the reply came to its end by itself
    forced,  ///< the deadline cut the reasoning short
  } kind = Kind::first;
};

/// What a model said about one prompt.
struct Reply {
  std::string reasoning;        ///< text generated before the answer, possibly cut
  std::vector<Answer> answers;  ///< over time, at least one when there was any answer
  int prompt_tokens = 0;
  int reply_tokens = 0;
};

/// Progress as it happens; called on the thread that asks.
struct Progress {
  std::size_t prompt = 0;          ///< which prompt
  std::string_view text;           ///< newly generated text, may be empty
  const Answer* answer = nullptr;  ///< a new answer, or none
};

/// Where tokens are drawn: what the logits are divided by.
constexpr double sampling_temperature = 0.7;

/// How a question is put.
struct AskOptions {
  /// When a stop is asked for the question is withdrawn: the call returns soon, as if its deadline
  /// had come, and the model can be asked again.
  std::stop_token stop;
  std::optional<int> max_tokens;  ///< of text per scene, > 0; nullopt: as the model is set up
  /// >= 0. 0: the likeliest token at every place (greedy). Any other: tokens are drawn, likelier
  /// ones more often (`sampling_temperature`), for the same seed the same.
  int sampling_seed = 0;
  /// What each reply may say, from its first character on (GBNF, llama.cpp's notation, with a rule
  /// `root`): one per scene, of which an empty one allows anything; or an empty list. A model that
  /// cannot be held to a grammar replies without.
  std::vector<std::string> grammars = {};
};

constexpr std::size_t most_scenes = 3;  ///< of one question

/// What is put to a model at once.
struct Question {
  std::vector<std::string> scenes;    ///< scene parts of the prompt
  std::vector<std::string> grammars;  ///< as AskOptions has them
};

/// Something that reads prompts and chooses among the policies. May be slow, may fail.
class LanguageModel {
 public:
  LanguageModel() = default;
  LanguageModel(const LanguageModel&) = delete;
  LanguageModel& operator=(const LanguageModel&) = delete;
  virtual ~LanguageModel() = default;

  /// Asks about several scenes at once, all done by `deadline`. Each answer is told by `progress`
  /// as soon as it is there.
  ///
  /// @param scenes    scene parts of the prompt, one to three; the system part is fixed
  /// @param deadline  on the model's clock; the call returns before it, whatever the model does
  /// @return          one reply per scene, with the answers that were there in time; an error when
  ///                  there was none (too_late; unreadable when the model cannot be reached;
  ///                  malformed when what it says holds no answer)
  [[nodiscard]] Result<std::vector<Reply>> ask(const std::vector<std::string>& scenes,
                                               Clock::Time deadline,
                                               const std::function<void(const Progress&)>& progress,
                                               const AskOptions& options = {}) {
    expects(!scenes.empty() && scenes.size() <= most_scenes, "1 to 3 scenes");
    expects(!options.max_tokens || *options.max_tokens > 0, "max_tokens > 0");
    expects(options.sampling_seed >= 0, "sampling_seed >= 0");
    expects(options.grammars.empty() || options.grammars.size() == scenes.size(),
            "a grammar for each scene");
    return reply_to(scenes, deadline, progress, options);
  }

  /// What it is, for records: name, file hash.
  [[nodiscard]] virtual std::string description() const = 0;

 private:
  /// As ask().
  [[nodiscard]] virtual Result<std::vector<Reply>> reply_to(
      const std::vector<std::string>& scenes, Clock::Time deadline,
      const std::function<void(const Progress&)>& progress, const AskOptions& options) = 0;
};

}  // namespace saca::language_model
