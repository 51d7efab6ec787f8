#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/onboard/reflex/plan_cache.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/thinking/arbitration/check.h"
#include "saca/thinking/language_model/explanation.h"
#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/language_model/truth.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/store.h"
#include "saca/thinking/preview/situation.h"

namespace saca::arbitration {

enum class Plane : std::uint8_t { world, reflex, thinking };
[[nodiscard]] std::string_view name(Plane plane);

/// What can happen, in about the order in which it does.
enum class EventKind : std::uint8_t {
  preview,
  risk,
  intention,
  forecast,
  memory,
  ask,
  first_answer,
  answer,
  check,
  cached,
  trigger,
  match,
  execute,
  switched,
  contact,
  rest,
  fault,
};
[[nodiscard]] std::string_view name(EventKind kind);

/// One line of the story.
struct Event {
  double time = 0.0;  ///< in the scene's time [s]
  Plane plane = Plane::world;
  EventKind kind = EventKind::preview;
  std::string text;
};

/// Everything that was thought about one forecast.
struct Preview {
  std::int32_t number = 0;
  preview::Situation situation;  ///< as it was thought about
  world::Scene
      newest_scene;  ///< the same situation as last forecast: the trigger is matched with it
  std::optional<memory::Match> nearest;
  memory::Gate gate = memory::Gate::reason;
  std::string prompt;           ///< the scene part; empty when the model was not asked
  language_model::Reply reply;  ///< answer times in the scene's time
  std::optional<language_model::Truth> truth;  ///< of the reasoning; nullopt: the model wrote none
  std::optional<Check> check;                  ///< of the last policy that was chosen
  std::optional<manoeuvre::Plan> plan;         ///< what was cached in the end
  reflex::Source source = reflex::Source::model;
  bool worse_than_aeb = false;  ///< the plan, by the last forecast
  std::optional<double> ready;  ///< when it was cached [s]
  bool unheard = false;         ///< the model failed when it was asked: it may be asked again
  double missed = 0.0;          ///< the time that it had then and that was too short [s]
  std::optional<language_model::Explanation> retold;  ///< after the encounter (retold())
};

/// The one of this number; nullptr: it is forgotten.
/// @param previews  numbers ascend
[[nodiscard]] const Preview* find_preview(std::span<const Preview> previews,
                                          std::int32_t number) noexcept;

/// The case that a prompt about it tells of; nullopt: none was found.
[[nodiscard]] std::optional<memory::Case> told_case(const Preview& preview);
/// The scene part about it.
[[nodiscard]] std::string prompt_of(const Preview& preview);

/// What may be replied to it (language_model::reply_grammar): what is true of it as it was asked.
/// @param choice  what the reply has to come to; nullopt: to any that is admissible
[[nodiscard]] std::string grammar_of(const Preview& preview,
                                     const std::optional<manoeuvre::PolicyId>& choice = {});

/// Why its plan was chosen, or else what the model answered last (language_model::explanation); as
/// it was retold, where it was. Takes milliseconds.
/// @return  nullopt: there is neither, or it cannot be driven
[[nodiscard]] std::optional<language_model::Explanation> explanation(const Preview& preview);

/// The same, for which a model that was asked about the preview is asked again while the reasons
/// are not its own words (language_model::told_again): off the deadline's path. As explanation()
/// where it fails.
[[nodiscard]] std::optional<language_model::Explanation> retold(
    const Preview& preview, language_model::LanguageModel& model, const Clock& clock,
    const std::stop_token& stop = {});

/// Who set off the trigger, and why before T1 where it was.
/// @param time  to the conflict [s]
[[nodiscard]] std::string trigger_text(const world::Actor& actor, double time,
                                       const std::optional<double>& waiting_cost);
/// Why this was decided, in one line.
[[nodiscard]] std::string decision_text(const reflex::Decision& decision);
/// What is carried out.
[[nodiscard]] std::string execution_text(const manoeuvre::Plan& plan, reflex::Source source);
[[nodiscard]] std::string switch_text(const reflex::Switch& change);

/// Whoever listens was too slow: so many events, or pieces of what the model wrote, did not fit
/// into the queue to it.
[[nodiscard]] Event events_not_told(double time, Plane plane, std::size_t count);

}  // namespace saca::arbitration
