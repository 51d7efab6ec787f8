#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "saca/base/core/clock.h"
#include "saca/onboard/reflex/plan_cache.h"
#include "saca/onboard/reflex/trigger.h"
#include "saca/thinking/arbitration/event.h"
#include "saca/thinking/intent/observer.h"
#include "saca/thinking/language_model/language_model.h"
#include "saca/thinking/memory/store.h"
#include "saca/thinking/preview/preview.h"

namespace saca::arbitration {

/// What the language model is shown, and what of its reply counts: with less than all, it is found
/// out what each is worth.
struct Asking {
  bool facts = true;      ///< what was computed about each manoeuvre stands in the prompt
  bool risks = true;      ///< so does how dangerous each road user is
  bool reasoning = true;  ///< what it writes counts, and what it answers after that; else only its
                          ///< first answer does
};

/// What the thinking plane works with. Whatever it points to outlives the plane.
struct ThinkingTools {
  preview::ForecastTools forecast;
  memory::Store* memory = nullptr;                 ///< nullptr: without memory
  language_model::LanguageModel* model = nullptr;  ///< nullptr: without language model
  Clock* clock = nullptr;                          ///< the one that the model's deadlines are on
  reflex::Guard guard = reflex::Guard::never_worse_than_braking;
  Asking asking;
};

/// Where what was thought goes; called on the thread that thinks.
struct ThinkingOutput {
  std::function<void(const reflex::PlanCache&, double ready)>
      publish;  ///< plans, and since when [s]
  std::function<void(const Event&)> event;
  std::function<void(std::int32_t preview, std::string_view text)> reasoning;  ///< streamed
};

/// A scene that has come since a round began, and what is believed of its actors' intentions, one
/// for each.
struct NewerScene {
  world::Scene scene;
  intent::Beliefs beliefs;
  bool encounter_is_over = false;  ///< the scene is one of the next: nothing asked is of use
};
/// The newest that there is; nullopt: none has come since it was last asked.
using NewestScene = std::function<std::optional<NewerScene>()>;

/// The plane that may be slow and may fail. Each round looks at the newest scene, forecasts the
/// likely situations at the trigger, and finds a plan for each that is not yet provided for: from
/// memory, or by asking the language model. A forecast that is more than 90 % like one that is
/// known is that one, as it looks now; of several in one round the likeliest. Where a policy that
/// was as good as the best is materially worse now, or the other way round, it is thought about
/// anew; a question to the model about it that is under way is withdrawn where there is time for
/// another. The model is asked about what it can answer before the trigger, as far as is known.
///
/// Algorithm 1 of the paper, its first half. Not thread-safe: one thread thinks.
class ThinkingPlane {
 public:
  ThinkingPlane(const ThinkingTools& tools, const reflex::Thresholds& thresholds,
                ThinkingOutput output);

  /// One round.
  ///
  /// @param scene     the newest one
  /// @param beliefs   about its actors' intentions, one for each
  /// @param scene_at  when, on the clock, scene.time was
  /// @param stop      a question to the model under way is withdrawn when a stop is asked for
  /// @param newest    looked at every `looked_again` while the model writes; empty: what is asked
  ///                  stays asked
  /// @return          false when nothing threatens within T2: nothing was done, but that plans for
  ///                  what has long passed are withdrawn
  bool think(const world::Scene& scene, const intent::Beliefs& beliefs, Clock::Time scene_at,
             const std::stop_token& stop = {}, const NewestScene& newest = {});

  /// Between two looks at newer facts while the model writes [s]: each costs as much as a round of
  /// forecasts, and that slows the model down.
  static constexpr double looked_again = 0.5;

  /// How long a forecast is kept after its trigger has passed [s]: an encounter that lasts for
  /// hours, as in dense traffic, stays small.
  static constexpr double remembered = 30.0;

  /// The encounter is over: forgets what was thought.
  void forget();

  /// What was thought since the last `forget` and is remembered; numbers ascend.
  [[nodiscard]] const std::vector<Preview>& previews() const { return previews_; }

  /// How often since then the model, when asked, gave no answer in time, for whatever reason.
  [[nodiscard]] int deadline_misses() const { return deadline_misses_; }

 private:
  struct Round;
  /// To the model, about several previews.
  struct OpenQuestion {
    const Round& round;
    const std::vector<std::size_t>& which;  ///< indices into previews_
    double asked_at = 0.0;                  ///< [s]
    double left = 0.0;                      ///< the time that the model had then [s]
  };
  /// What a round has to find plans for: indices into previews_.
  struct Pending {
    std::vector<std::size_t> fresh;       ///< not thought about as they are now
    std::vector<std::size_t> unanswered;  ///< to be asked about
  };

  /// @return  whether anything was that was current
  bool forget_what_has_passed(double now);
  void tell(const Round& round, EventKind kind, std::string text) const;
  void describe_scene(const Round& round, const reflex::Threat& threat) const;
  /// The likely situations at the trigger by this scene, but those whose trigger has passed: each
  /// is a new preview, or brings the known one that is like it up to date, where no likelier one
  /// did. They are current from then on.
  Pending take_forecasts(const Round& round);
  /// @param known  index into previews_ of what is like the situation, which may be moved from
  void bring_up_to_date(const Round& round, std::size_t known, preview::Situation& situation,
                        Pending& pending);
  void tell_forecast(const Round& round, const Preview& preview) const;
  /// The known forecast that is most like this one, if like enough: index into previews_.
  [[nodiscard]] std::optional<std::size_t> provided_for(const preview::Situation& situation) const;
  /// Takes over newer facts where they ask for another choice (`situation` is moved from): what was
  /// chosen by the old ones is withdrawn where it is materially worse than the best now.
  /// @return  whether it has to be thought about anew
  bool refresh(const Round& round, Preview& preview, preview::Situation& situation);
  /// @return  whether memory provided a plan
  bool consult_memory(const Round& round, Preview& preview);
  /// To the instant at which the model must be done [s].
  [[nodiscard]] static double time_left(const Round& round, const world::Scene& at_trigger);
  /// Those that can be answered in one question, the likeliest first.
  [[nodiscard]] std::vector<std::size_t> in_time(const Round& round,
                                                 std::vector<std::size_t> which) const;
  /// The shortest time in which the model may answer about so many forecasts [s].
  [[nodiscard]] double least_time(std::size_t count) const;
  /// By the newest scene, the facts of one of these forecasts have changed, and there is time to
  /// ask about all of them anew; or the encounter is over.
  [[nodiscard]] bool is_outdated(const Round& round, const std::vector<std::size_t>& which) const;
  void ask_model(const Round& round, const std::vector<std::size_t>& which);
  /// Of these previews, as they are asked about.
  [[nodiscard]] language_model::Question write_question(const std::vector<std::size_t>& which);
  void hear(const OpenQuestion& question, const language_model::Progress& news);
  /// Of whom there is no answer and no plan may be asked about again, where there is more time.
  void take_replies(const OpenQuestion& question,
                    const std::vector<language_model::Reply>& replies);
  /// Those of it that have no plan.
  /// @param missed  the time that there was and that was too short [s]; 0: that was not why
  void ask_again_later(const OpenQuestion& question, double missed);
  void take_answer(const Round& round, Preview& preview, const language_model::Answer& answer);
  void judge_reasoning(const Round& round, Preview& preview);
  /// @return  whether the policy is what the forecast is provided with now
  bool settle(Preview& preview, manoeuvre::PolicyId policy, reflex::Source source, double ready,
              bool needs_check);
  void publish(double ready) const;

  ThinkingTools tools_;
  reflex::Thresholds thresholds_;
  ThinkingOutput output_;
  std::vector<Preview> previews_;
  std::int32_t num_previews_ = 0;      ///< forgotten ones included
  std::vector<std::int32_t> current_;  ///< numbers of previews, newest forecast first
  double fastest_answer_ = 0.0;  ///< to a question of this encounter, per forecast that it was
                                 ///< about [s]; 0: there was none
  int deadline_misses_ = 0;
};

}  // namespace saca::arbitration
