#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/cases/reply_example.h"
#include "saca/lab/eval/calibration.h"
#include "saca/lab/eval/model_score.h"
#include "saca/lab/eval/suite_figures.h"
#include "saca/thinking/language_model/explanation.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::cases {

/// What a language model replied to an example's prompt, and how far that is true. One line of a
/// file of them: schema "saca.example_reply/2".
struct ExampleReply {
  ReplyExample example;
  std::string reasoning;                     ///< as written, without the answer
  std::optional<eval::Probabilities> first;  ///< of its answer at once; nullopt: there was none
  std::optional<eval::Probabilities>
      last;                  ///< of its answer after reasoning; nullopt: there was none
  bool ended = false;        ///< the reply came to its end by itself
  int tokens = 0;            ///< of the reasoning
  int statements = 0;        ///< that can be checked
  int false_statements = 0;  ///< of these
  bool unfounded = false;    ///< the choice rests on one of them
  /// Whose words would be shown as the reason of its last answer (language_model::explanation).
  language_model::Explanation::From shown = language_model::Explanation::From::facts;
  /// The same, where the model may try again (language_model::told_again), and after how many
  /// tries.
  language_model::Explanation::From shown_at_last = language_model::Explanation::From::facts;
  int tries = 1;
};

/// @param situation  that the example's prompt is about
[[nodiscard]] ExampleReply example_reply(ReplyExample example, const language_model::Reply& reply,
                                         const preview::Situation& situation);

/// The grammar of texts that end with this policy (language_model::reply_grammar); empty: none.
using ChoiceGrammar = std::function<std::string(manoeuvre::PolicyId)>;

/// Asks the model again where its words would not be shown: sets `shown_at_last` and `tries`.
/// Without a last answer there is nothing to be shown.
/// @param situation  that the example's prompt is about
/// @param grammar    of what it may write (AskOptions)
/// @return           the model's error
[[nodiscard]] std::optional<Error> try_again(ExampleReply& reply,
                                             const preview::Situation& situation,
                                             language_model::LanguageModel& model,
                                             const Clock& clock, const ChoiceGrammar& grammar);

[[nodiscard]] nlohmann::json to_json(const ExampleReply& reply);
/// Strict.
/// @return  Error::Code::malformed, naming the key, what was wanted, what came
[[nodiscard]] Result<ExampleReply> example_reply_from_json(const nlohmann::json& document);

/// A way to choose, and how well it does over examples of which the harm of every policy that can
/// be driven is known. Who chooses what cannot be driven brakes.
struct ReplyChoice {
  std::string_view key;        ///< as files have it
  std::string_view title;      ///< for readers
  eval::Estimate best_within;  ///< share: of the admissible as good as the best (memory::as_good)
  eval::Estimate admissible;   ///< share: chosen from the admissible
  eval::Estimate harm;         ///< known, of what is chosen
  eval::Estimate regret;       ///< above the least of all
  eval::Estimate above_rule;   ///< harm above that of the rule within the admissible, paired
};

/// How well a model replies.
struct ReplyScore {
  int examples = 0;
  int known = 0;  ///< of them harm is known
  std::vector<ReplyChoice> choices;
  eval::Estimate needless;  ///< of the twins: the model's choice, within the admissible, intervenes
                            ///< though nothing has to be done
  // Of all replies:
  double ended = 0.0;            ///< share that came to their end by themselves
  double agrees = 0.0;           ///< share whose text names the choice that its answer then makes
  double true_statements = 0.0;  ///< share of those that can be checked
  double true_replies = 0.0;     ///< share in which nothing is false, of those with statements
  double unfounded = 0.0;        ///< share whose choice rests on something false
  double statements = 0.0;       ///< that can be checked, in a reply, mean
  double shown = 0.0;            ///< share whose words are shown as they are
  double shown_in_part = 0.0;    ///< share of which what is true is shown; of the rest the figures
  double shown_at_last = 0.0;    ///< share whose words are shown, in part or not, after most_tries
  std::vector<int> tokens;       ///< of each reply, ascending
  std::optional<eval::Calibration>
      calibration;  ///< of the last answers: as good as the best within
};

/// @param replies  at least one
/// @param seed     of the intervals
[[nodiscard]] ReplyScore reply_score(std::span<const ExampleReply> replies, std::uint64_t seed);

}  // namespace saca::cases
