#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"
#include "saca/lab/encounter/closed_loop.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/preview/forecast_facts.h"

namespace saca::cases {

/// What an example is for. All examples of one record are of one set.
enum class ExampleSet : std::uint8_t {
  train,
  calibration,  ///< when to stop, temperatures
  test,         ///< figures
};
inline constexpr std::array all_example_sets{ExampleSet::train, ExampleSet::calibration,
                                             ExampleSet::test};
[[nodiscard]] std::string_view name(ExampleSet set);
[[nodiscard]] std::optional<ExampleSet> example_set_from(std::string_view name);

/// 70 % train, 15 % each of the others, by the record's name alone.
[[nodiscard]] ExampleSet set_of_record(std::string_view record);

/// What a language model is taught with: a prompt as it is asked, and what an expert replies
/// (language_model::expert_reply). One line of a file of them: schema "saca.reply_example/1".
struct ReplyExample {
  std::string record;  ///< of the encounter
  std::string family;
  bool is_twin = false;  ///< the same encounter without risk
  ExampleSet set = ExampleSet::train;
  std::string prompt;  ///< language_model::scene_part
  std::string reply;
  manoeuvre::PolicyId choice = manoeuvre::PolicyId::aeb;
  memory::Policies admissible;
  memory::PolicyHarms forecast;  ///< of the prompt's facts; nullopt: cannot be driven
  memory::PolicyHarms known;     ///< a mean over draws of what happened, in scenes with cues what
                                 ///< is expected by the law they are drawn by; nullopt: not known
  std::optional<memory::PolicyHarms> by_table;  ///< likewise by what SACA reckons with
                                                ///< (data/cues.toml); nullopt: without cues
};

[[nodiscard]] nlohmann::json to_json(const ReplyExample& example);
/// Strict.
/// @return  Error::Code::malformed, naming the key, what was wanted, what came
[[nodiscard]] Result<ReplyExample> reply_example_from_json(const nlohmann::json& document);

/// An example as chat fine-tuning takes it: {"messages": [system, user, assistant]}.
/// @param system  language_model::system_part
[[nodiscard]] nlohmann::json chat_json(const ReplyExample& example, std::string_view system);

/// When SACA's trigger first fires.
struct AtFirstTrigger {
  preview::Situation situation;  ///< the likeliest of those that it would prepare for
  world::Scene seen;             ///< as perceived
  intent::Beliefs beliefs;       ///< one per actor
};

/// Nobody has acted before.
/// @return  nullopt: the trigger never fires, or no hypothesis leads to a conflict; out_of_range:
///          the encounter cannot be played
[[nodiscard]] Result<std::optional<AtFirstTrigger>> at_first_trigger(
    const encounter::Stage& stage, const preview::ForecastTools& tools);

/// The case that a prompt tells of.
struct PromptCase {
  memory::Case found;
  double similarity = 0.0;  ///< in [0, 1]
};

/// Completes an example: prompt, choice and reply.
/// @param example  record, family, twin and `known` are set
/// @param seed     of the reply's words, together with the record's name
/// @return         nullopt where nothing can be driven
[[nodiscard]] std::optional<ReplyExample> reply_example(ReplyExample example,
                                                        const preview::Situation& situation,
                                                        const std::optional<PromptCase>& told,
                                                        std::uint64_t seed);

}  // namespace saca::cases
