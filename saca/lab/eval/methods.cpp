#include "saca/lab/eval/methods.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/lab/encounter/saca_method.h"
#include "saca/lab/eval/at_trigger.h"
#include "saca/lab/eval/driver_models.h"
#include "saca/lab/eval/rss.h"
#include "saca/lab/eval/trigger_choices.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/arbitration/forecaster.h"
#include "saca/thinking/arbitration/verdict_memo.h"
#include "saca/thinking/preview/preview.h"

namespace saca::eval {
namespace {

using encounter::Action;
using encounter::Method;
using encounter::View;
using manoeuvre::full_braking;
using manoeuvre::PolicyId;

constexpr std::array<MethodInfo, 42> infos{{
    {"saca", "SACA",
     "The shipped planes: a cached plan that matches and is admissible, else what the verdict "
     "speaks "
     "for; supervised to the end."},
    {"saca_no_memory", "SACA without memory", "As SACA; no stored case is asked.", false,
     Needs::memory},
    {"saca_no_model", "SACA without model", "As SACA; the language model is not asked.", false,
     Needs::model},
    {"saca_untuned", "SACA with a model without fine-tuning",
     "As SACA; the language model is asked as it was before it was taught.", false, Needs::untuned},
    {"saca_unaware", "SACA without scenario awareness",
     "As SACA; no intention is recognised, so that all are taken to go on as they do, and no risk "
     "(V_h) stands in prompts."},
    {"saca_no_reach", "SACA without reachability",
     "As SACA; the language model is not told how dangerous each road user is (V_h), which nothing "
     "else that SACA decides by asks.",
     false, Needs::model},
    {"saca_no_cues", "SACA, cues not reckoned with",
     "As SACA; it reckons only with who is seen, whatever the place."},
    {"saca_at_t1", "SACA, never before T1",
     "As SACA; it waits for T1 even where waiting is expected to cost harm."},
    {"saca_full_braking", "SACA, braking with one strength",
     "As SACA; who brakes does so with all the grip."},
    {"saca_reflex", "SACA, the reflex plane alone",
     "As SACA by its interface for C: neither forecaster, memory nor model; the atlas judges."},
    {"saca_paper", "SACA, as in the paper",
     "Algorithm 1: a cached plan above 90 %, else emergency braking at T1, and nothing is held "
     "against braking. Unlike it: memory's confidence is that of many cases, a plan is given up "
     "when its facts have changed against it, and of a reply that comes late its first answer "
     "counts."},
    {"saca_paper_at_once", "The same, first answers only",
     "As saca_paper; the language model's answer right after the prompt, before it writes a word.",
     false, Needs::model},
    {"saca_paper_untuned", "Algorithm 1, model without fine-tuning",
     "As saca_paper; the language model is asked as it was before it was taught.", false,
     Needs::untuned},
    {"saca_paper_unaware", "Algorithm 1 without scenario awareness",
     "As saca_paper; no intention is recognised, and no risk (V_h) stands in prompts."},
    {"saca_paper_no_facts", "The same, without our facts",
     "As saca_paper; nothing that was computed about the manoeuvres stands in the prompt.", false,
     Needs::model},
    {"saca_paper_no_facts_at_once", "The same, first answers only",
     "As saca_paper_no_facts; the answer right after the prompt.", false, Needs::model},
    {"nothing", "No intervention", "Lane and speed are kept, whatever comes."},
    {"aeb", "AEB at T1", "Full braking as soon as the conflict is within T1 = 1.3 s."},
    {"r157", "Braking rule of UN R157",
     "Brakes with 6 m/s2, 0.35 s after the time to collision falls below what UN R157, 5.2.5.2, "
     "asks for."},
    {"cc_driver", "Competent driver of UN R157",
     "The careful driver of UN R157, Annex 3: sees at 2 s to collision, brakes 0.75 s later with "
     "up to 0.774 g."},
    {"fsm", "Fuzzy safety model",
     "JRC's fuzzy safety model: brakes as hard as its two fuzzy distances say, 0.75 s after they "
     "call for it."},
    {"rss", "RSS, braking",
     "Brakes as long as the distances of responsibility-sensitive safety are not kept."},
    {"rss_steering", "RSS, braking or steering",
     "As RSS; where braking comes too late, changes to a neighbouring lane in which the distances "
     "are kept."},
    {"imitation", "Imitation learning",
     "At T1, what a small network says that was shown scenes of the tuning split and what was best "
     "in them, with the compact car; it forecasts nothing.",
     false, Needs::imitator},
    {"imitation_drivers", "Imitation of drivers",
     "As imitation; the network was shown what the drivers of the 100-Car study did in 87 "
     "emergencies.",
     false, Needs::imitator},
    {"random", "Any of the eight", "One of the eight at T1, all alike likely."},
    {"first_forecast", "Best of the first forecast",
     "The best plan of the forecast made when somebody first threatens, some 4 s before T1."},
    {"newest_forecast", "Best of the newest forecast",
     "The best plan of that forecast, of those made last before T1, which is most like the scene "
     "at T1."},
    {"going_on_atlas", "Best of eight, others going on",
     "At T1, by the atlas, as if all others went on as they do."},
    {"beliefs_atlas", "Best of eight in expectation, atlas",
     "At T1, by the atlas: least expected harm over what the others are believed to intend."},
    {"beliefs_rolled_out", "Best of eight in expectation, rolled out",
     "The same with full dynamics and all that follows a contact."},
    {"beliefs_drawn", "Best of eight in expectation over draws",
     "The same over draws of what the others intend, how far they drift and how well they are "
     "seen."},
    {"least_danger", "The least Q_h",
     "At T1, the plan after half a second of which V_h, learnt, is least: the highest of all who "
     "are "
     "ahead, each by itself, going on as they do.",
     false, Needs::danger},
    {"least_joint_danger", "The least Q_h beside all",
     "As least_danger, by V_h beside the three most dangerous together.", false, Needs::danger},
    {"beliefs_and_danger", "Best of eight in expectation, ties by Q_h",
     "As beliefs_atlas; of those that harm as little by all that forecasts can tell, the plan of "
     "the least joint Q_h.",
     false, Needs::danger},
    {"beliefs_and_experience", "The same, corrected by what was met",
     "As beliefs_drawn; what happened in like cases, minus what had been expected of them, is "
     "added.",
     false, Needs::memory},
    {"beliefs_and_grip", "The same, told the grip and the car",
     "As beliefs_rolled_out, told the true grip and how the real car differs.", true},
    {"beliefs_and_followers", "The same, told how followers react",
     "As beliefs_rolled_out, told how those behind will truly react.", true},
    {"beliefs_and_hidden", "The same, seeing everybody",
     "As beliefs_rolled_out, from the true scene: without noise and latency, hidden road users "
     "included.",
     true},
    {"true_atlas", "Best of eight, true motion, atlas",
     "At T1, by the atlas, told how the others will truly move.", true},
    {"true_rolled_out", "Best of eight, true motion, rolled out",
     "At T1, with full dynamics, told how the others will truly move; not the grip, nor the real "
     "car.",
     true},
    {"oracle", "Best in hindsight", "At T1, told everything.", true},
}};

/// The situations forecast at one instant, and which of them is most like the scene now.
Action best_of_forecast(const world::Scene& then, const intent::Beliefs& beliefs, const View& now,
                        const runtime::PlanesSetup& setup) {
  const auto situations = preview::situations(then, beliefs, setup.thresholds, setup.forecast);
  if (situations.empty()) {
    return {.plan = full_braking, .source = "fallback", .reason = "nothing was forecast"};
  }
  const auto likeness = [&](const preview::Situation& one) {
    return match::similarity(one.scene_at_trigger, now.scene);
  };
  const auto most_alike =
      std::max_element(situations.begin(), situations.end(),
                       [&](const auto& a, const auto& b) { return likeness(a) < likeness(b); });
  const PolicyId best = preview::best_by_forecast(most_alike->facts);
  return {.plan = most_alike->facts[manoeuvre::index(best)].plan, .source = "forecast"};
}

/// Keeps the scene of the first or the newest round of forecasts, and asks for its forecasts when
/// they are needed: they depend on nothing that comes later.
class ByForecast final : public Method {
 public:
  enum class Which : std::uint8_t { first, newest };
  ByForecast(const runtime::PlanesSetup& setup, Which which)
      : setup_(setup),
        which_(which),
        at_trigger_(setup.thresholds, [this](const View& view) { return choose(view); }) {}

  [[nodiscard]] std::optional<Action> step(const View& view) override {
    auto action = at_trigger_.step(view);
    if (!action && view.driven) {
      remember(view);
    }
    return action;
  }

 private:
  [[nodiscard]] Action choose(const View& view) const {
    return scene_
               ? best_of_forecast(*scene_, beliefs_, view, setup_)
               : Action{
                     .plan = full_braking, .source = "fallback", .reason = "no time to forecast"};
  }
  void remember(const View& view) {
    constexpr double round = 0.2;  // [s], as the thinking plane's
    if (!scene_ || (which_ == Which::newest && view.scene.time >= scene_->time + round)) {
      scene_ = view.scene;
      beliefs_ = view.beliefs;
    }
  }

  runtime::PlanesSetup setup_;
  Which which_;
  AtTrigger at_trigger_;
  std::optional<world::Scene> scene_;
  intent::Beliefs beliefs_;
};

class Nothing final : public Method {
  [[nodiscard]] std::optional<Action> step(const View&) override { return std::nullopt; }
};

/// The planes of one of SACA's rows.
runtime::PlanesSetup planes_of(std::string_view name, const MethodTools& tools) {
  runtime::PlanesSetup planes = tools.saca;
  planes.guard = name.starts_with("saca_paper") ? reflex::Guard::none
                                                : reflex::Guard::never_worse_than_braking;
  planes.asking = {.facts = name.find("_no_facts") == std::string_view::npos,
                   .risks = !name.ends_with("_unaware") && name != "saca_no_reach",
                   .reasoning = !name.ends_with("_at_once")};
  if (name == "saca_full_braking") {
    planes.forecast.braking = forecast::Braking::full;
    planes.judge = {};  // that of `tools` judges other plans
  }
  if (name == "saca_no_cues") {
    planes.forecast.cues = nullptr;
    planes.judge = {};  // that of `tools` reckons with them
  }
  if (name == "saca_at_t1") {
    planes.thresholds.waiting_cost.reset();
  }
  const bool is_alone = name == "saca_reflex";
  if (is_alone) {
    planes.judge = [](const auto&...) {  // as if it came too late, always
      return reflex::Verdict{.time = -std::numeric_limits<double>::infinity()};
    };
  }
  planes.memory = is_alone || name == "saca_no_memory" ? nullptr : planes.memory;
  planes.model = is_alone || name == "saca_no_model" ? nullptr : planes.model;
  if (find_method(name)->needs == Needs::untuned) {
    planes.model = tools.untuned;
  }
  return planes;
}

/// Who recognises no intentions: nothing was learnt.
const intent::Model& intentions_of(std::string_view name, const MethodTools& tools) {
  static const intent::Model none;
  return name.ends_with("_unaware") ? none : *tools.intent;
}

}  // namespace

std::span<const MethodInfo> methods() {
  return infos;
}

const MethodInfo* find_method(std::string_view name) {
  const auto* const found = std::find_if(infos.begin(), infos.end(),
                                         [&](const MethodInfo& info) { return info.name == name; });
  return found == infos.end() ? nullptr : found;
}

runtime::PlanesSetup with_shared_verdicts(runtime::PlanesSetup saca) {
  saca.judge = arbitration::memoised(saca.judge ? std::move(saca.judge)
                                                : arbitration::judge_with(saca.forecast));
  return saca;
}

std::unique_ptr<Method> make_method(std::string_view name, const MethodTools& tools) {
  expects(find_method(name) != nullptr, "a method of methods()");
  expects(tools.hindsight != nullptr && tools.intent != nullptr, "hindsight and intent are given");
  expects(find_method(name)->needs != Needs::danger || tools.danger != nullptr,
          "V_h is given to who chooses by it");
  expects(find_method(name)->needs != Needs::imitator ||
              (tools.imitators != nullptr && tools.imitators->contains(name)),
          "the network is given to who asks it");
  expects(find_method(name)->needs != Needs::untuned || tools.untuned != nullptr,
          "a model is given to who asks another one");
  expects(name != "beliefs_and_experience" || tools.experience != nullptr,
          "experience is given to who is corrected by it");
  const runtime::PlanesSetup& setup = tools.saca;
  if (name.starts_with("saca")) {
    return std::make_unique<encounter::SacaMethod>(planes_of(name, tools),
                                                   intentions_of(name, tools));
  }
  if (name == "nothing") {
    return std::make_unique<Nothing>();
  }
  if (name == "first_forecast" || name == "newest_forecast") {
    return std::make_unique<ByForecast>(
        setup, name == "first_forecast" ? ByForecast::Which::first : ByForecast::Which::newest);
  }
  if (name == "r157") {
    return std::make_unique<R157Braking>();
  }
  if (name == "cc_driver") {
    return std::make_unique<CompetentDriver>();
  }
  if (name == "fsm") {
    return std::make_unique<FuzzySafety>();
  }
  if (name == "rss" || name == "rss_steering") {
    return std::make_unique<Rss>(name == "rss" ? Rss::Response::braking
                                               : Rss::Response::braking_or_steering);
  }
  AtTrigger::Choose choose = trigger_choice(name, tools);
  expects(choose != nullptr, "every method has a way to choose");
  return std::make_unique<AtTrigger>(setup.thresholds, std::move(choose));
}

}  // namespace saca::eval
