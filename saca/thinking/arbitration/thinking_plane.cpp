// Longer than 400 lines: the steps of one round of thinking, which share its state.
#include "saca/thinking/arbitration/thinking_plane.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/onboard/match/similarity.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/thinking/arbitration/facts_change.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/truth.h"
#include "saca/thinking/preview/previewed_threat.h"

namespace saca::arbitration {
namespace {

using manoeuvre::PolicyId;

constexpr double least_thinking_time = 0.15;  // [s]: a model asked later than this cannot answer
constexpr double shortest_share = 0.5;        // of the fastest answer so far: none will come sooner
constexpr double handover_margin = 0.05;  // [s] before the trigger at which the model must be done

std::string probabilities(const intent::IntentPosterior& posterior) {
  std::string text;
  for (const intent::Intention intention : intent::all_intentions) {
    const double p = posterior[static_cast<std::size_t>(intention)];
    if (p >= 0.05) {
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name(intention), 100.0 * p);
    }
  }
  return text;
}

}  // namespace

/// What one round shares among its steps.
struct ThinkingPlane::Round {
  const world::Scene& scene;
  const intent::Beliefs& beliefs;
  Clock::Time scene_at;
  const Clock& clock;
  const std::stop_token& stop;
  const NewestScene& newest;

  [[nodiscard]] double time_of(Clock::Time at) const {
    return scene.time + to_seconds(at - scene_at);
  }
  [[nodiscard]] double now() const { return time_of(clock.now()); }
  [[nodiscard]] Clock::Time clock_at(double time) const {
    return scene_at + from_seconds(time - scene.time);
  }
};

ThinkingPlane::ThinkingPlane(const ThinkingTools& tools, const reflex::Thresholds& thresholds,
                             ThinkingOutput output)
    : tools_(tools), thresholds_(thresholds), output_(std::move(output)) {
  expects(tools.forecast.car != nullptr && tools.forecast.harm != nullptr && tools.clock != nullptr,
          "car, harm and clock are given");
  if (tools_.guard == reflex::Guard::none) {
    tools_.forecast.braking =
        forecast::Braking::full;  // Algorithm 1 has the paper's eight policies
  }
  expects(output_.publish && output_.event && output_.reasoning, "every output goes somewhere");
}

void ThinkingPlane::tell(const Round& round, EventKind kind, std::string text) const {
  output_.event({round.now(), Plane::thinking, kind, std::move(text)});
}

void ThinkingPlane::describe_scene(const Round& round, const reflex::Threat& threat) const {
  const world::Scene& scene = round.scene;
  tell(round, EventKind::preview,
       fmt::format("{} may be in conflict with the ego in {:.1f} s: preview starts",
                   actor_name(scene.actors[threat.actor]), threat.time));
  const auto risks = preview::obstacle_risks(scene, tools_.forecast);
  for (std::size_t i = 0; i < risks.size(); ++i) {
    const world::Actor& actor = scene.actors[i];
    const danger::ObstacleRisk& risk = risks[i];
    tell(round, EventKind::risk,
         fmt::format("{}: risk {:.2f}, {}", actor_name(actor), risk.risk, explanation(risk)));
    tell(round, EventKind::intention,
         fmt::format("{}: {}", actor_name(actor), probabilities(round.beliefs[i].now())));
  }
}

bool ThinkingPlane::think(const world::Scene& scene, const intent::Beliefs& beliefs,
                          Clock::Time scene_at, const std::stop_token& stop,
                          const NewestScene& newest) {
  if (world::broken_rule(scene)) {
    return false;
  }
  const Round round{scene, beliefs, scene_at, *tools_.clock, stop, newest};
  const bool withdrawn = forget_what_has_passed(scene.time);
  const auto threat =
      preview::previewed_threat(scene, beliefs, tools_.forecast.motion, thresholds_);
  if (!threat) {
    if (withdrawn) {
      publish(round.now());
    }
    return false;
  }
  if (num_previews_ == 0) {
    describe_scene(round, *threat);
  }
  Pending pending = take_forecasts(round);
  for (const std::size_t i : pending.fresh) {
    tell_forecast(round, previews_[i]);
    if (!consult_memory(round, previews_[i])) {
      pending.unanswered.push_back(i);
    }
  }
  publish(round.now());
  if (tools_.model == nullptr) {
    return true;
  }
  const std::vector<std::size_t> asked = in_time(round, pending.unanswered);
  if (!asked.empty()) {
    ask_model(round, asked);
  } else if (!pending.unanswered.empty() && !pending.fresh.empty()) {
    tell(round, EventKind::ask,
         fmt::format("{:.2f} s to the trigger: too late to ask",
                     time_left(round, previews_[pending.fresh.front()].newest_scene)));
  }
  return true;
}

ThinkingPlane::Pending ThinkingPlane::take_forecasts(const Round& round) {
  Pending pending;
  std::vector<std::int32_t> now;
  for (preview::Situation& situation :
       preview::situations(round.scene, round.beliefs, thresholds_, tools_.forecast)) {
    if (situation.scene_at_trigger.time < round.now()) {
      continue;  // its trigger has passed while this was computed
    }
    const std::optional<std::size_t> known = provided_for(situation);
    if (!known) {
      now.push_back(num_previews_);
      pending.fresh.push_back(previews_.size());
      Preview preview;
      preview.number = num_previews_++;
      preview.newest_scene = situation.scene_at_trigger;
      preview.situation = std::move(situation);
      previews_.push_back(std::move(preview));
      continue;
    }
    const std::int32_t number = previews_[*known].number;
    if (std::find(now.begin(), now.end(), number) == now.end()) {
      now.push_back(number);
      bring_up_to_date(round, *known, situation, pending);
    }  // else it is so like a likelier one that the plan for that serves it too
  }
  current_.insert(current_.begin(), now.begin(), now.end());
  for (std::size_t i = 0; i < current_.size(); ++i) {  // newest first, each once
    current_.erase(std::remove(current_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                               current_.end(), current_[i]),
                   current_.end());
  }
  return pending;
}

void ThinkingPlane::bring_up_to_date(const Round& round, std::size_t known,
                                     preview::Situation& situation, Pending& pending) {
  Preview& preview = previews_[known];
  preview.newest_scene = situation.scene_at_trigger;
  if (refresh(round, preview, situation)) {
    pending.fresh.push_back(known);
    return;
  }
  preview.worse_than_aeb = preview.plan && !check(*preview.plan, situation, tools_.forecast).passed;
  const bool never_asked = preview.prompt.empty() && !preview.plan;
  if (preview.unheard || never_asked) {
    preview.situation = std::move(situation);
    pending.unanswered.push_back(known);
  }
}

void ThinkingPlane::tell_forecast(const Round& round, const Preview& preview) const {
  std::string combination;
  for (std::size_t k = 0; k < round.scene.actors.size(); ++k) {
    combination += fmt::format("{}{} {}", k == 0 ? "" : ", ", actor_name(round.scene.actors[k]),
                               name(preview.situation.intentions[k]));
  }
  tell(round, EventKind::forecast,
       fmt::format("forecast {} ({:.0f} %): {}; trigger at {:.2f} s", preview.number + 1,
                   100.0 * preview.situation.probability, combination,
                   preview.situation.scene_at_trigger.time));
}

void ThinkingPlane::forget() {
  previews_.clear();
  num_previews_ = 0;
  current_.clear();
  fastest_answer_ = 0.0;
  deadline_misses_ = 0;
}

bool ThinkingPlane::forget_what_has_passed(double now) {
  std::erase_if(previews_,
                [&](const Preview& one) { return one.newest_scene.time + remembered < now; });
  return std::erase_if(current_, [&](std::int32_t number) {
           return find_preview(previews_, number) == nullptr;
         }) > 0;
}

std::optional<std::size_t> ThinkingPlane::provided_for(const preview::Situation& situation) const {
  std::optional<std::size_t> found;
  double most = reflex::match_similarity;
  for (std::size_t i = 0; i < previews_.size(); ++i) {
    const double similarity =
        match::similarity(situation.scene_at_trigger, previews_[i].situation.scene_at_trigger);
    if (similarity > most) {
      most = similarity;
      found = i;
    }
  }
  return found;
}

bool ThinkingPlane::refresh(const Round& round, Preview& preview, preview::Situation& situation) {
  const auto changed = changed_policy(preview.situation.facts, situation.facts);
  if (!changed) {
    return false;
  }
  const bool worse = regret(situation.facts, *changed) >= reflex::material_harm;
  tell(round, EventKind::forecast,
       fmt::format("forecast {}: its facts have changed, {} {} is {}", preview.number + 1,
                   manoeuvre::index(*changed), name(*changed),
                   worse ? "not as good as the best any more" : "now as good as the best"));
  preview.situation = std::move(situation);
  preview.reply = {};
  preview.truth.reset();
  preview.unheard = false;
  if (!preview.plan) {
    return true;
  }
  if (regret(preview.situation.facts, preview.plan->policy) >= reflex::material_harm) {
    preview.plan.reset();
    preview.ready.reset();
  }
  preview.worse_than_aeb =
      preview.plan && !check(*preview.plan, preview.situation, tools_.forecast).passed;
  return true;
}

bool ThinkingPlane::consult_memory(const Round& round, Preview& preview) {
  if (tools_.memory == nullptr) {
    return false;
  }
  const auto nearest = tools_.memory->recall(preview.situation.scene_at_trigger);
  if (!nearest.has_value()) {
    tell(round, EventKind::fault, "memory: " + nearest.error().message);
    return false;
  }
  if (!nearest.value()) {
    tell(round, EventKind::memory, "memory is empty");
    return false;
  }
  preview.nearest = *nearest.value();
  preview.gate = memory::gate(*preview.nearest);
  const PolicyId policy = preview.nearest->policy;
  tell(round, EventKind::memory,
       fmt::format("cases like {}, which is {:.0f} % alike, speak for {} {}: confidence {:.0f} %",
                   preview.nearest->found.id, 100.0 * preview.nearest->similarity,
                   manoeuvre::index(policy), name(policy), 100.0 * preview.nearest->confidence));
  return preview.gate != memory::Gate::reason &&
         settle(preview, policy, reflex::Source::memory, round.now(),
                preview.gate == memory::Gate::check);
}

double ThinkingPlane::time_left(const Round& round, const world::Scene& at_trigger) {
  return at_trigger.time - handover_margin - round.now();
}

double ThinkingPlane::least_time(std::size_t count) const {
  return std::max(least_thinking_time,
                  shortest_share * fastest_answer_ * static_cast<double>(count));
}

std::vector<std::size_t> ThinkingPlane::in_time(const Round& round,
                                                std::vector<std::size_t> which) const {
  std::stable_sort(which.begin(), which.end(), [&](std::size_t a, std::size_t b) {
    return previews_[a].situation.probability > previews_[b].situation.probability;
  });
  std::vector<std::size_t> asked;
  for (const std::size_t i : which) {
    const double left = time_left(round, previews_[i].newest_scene);
    double left_to_all = left;
    for (const std::size_t other : asked) {
      left_to_all = std::min(left_to_all, time_left(round, previews_[other].newest_scene));
    }
    const bool new_chance = !previews_[i].unheard || left > previews_[i].missed;
    if (new_chance && left_to_all >= least_time(asked.size() + 1)) {
      asked.push_back(i);
    }
  }
  return asked;
}

bool ThinkingPlane::is_outdated(const Round& round, const std::vector<std::size_t>& which) const {
  const std::optional<NewerScene> newer = round.newest();
  if (!newer || world::broken_rule(newer->scene)) {
    return false;
  }
  if (newer->encounter_is_over) {
    tell(round, EventKind::ask, "the encounter is over, the question is withdrawn");
    return true;
  }
  std::vector<std::size_t> served;  // by the plan for a likelier one
  std::optional<std::size_t> changed;
  double left = std::numeric_limits<double>::infinity();
  for (const preview::Situation& situation :
       preview::situations(newer->scene, newer->beliefs, thresholds_, tools_.forecast)) {
    const std::optional<std::size_t> known = provided_for(situation);
    if (situation.scene_at_trigger.time < round.now() || !known ||
        std::find(which.begin(), which.end(), *known) == which.end() ||
        std::find(served.begin(), served.end(), *known) != served.end()) {
      continue;
    }
    served.push_back(*known);
    left = std::min(left, time_left(round, situation.scene_at_trigger));
    if (!changed && changed_policy(previews_[*known].situation.facts, situation.facts)) {
      changed = *known;
    }
  }
  if (!changed || left < least_time(which.size())) {
    return false;
  }
  tell(round, EventKind::ask,
       fmt::format("forecast {}: its facts have changed, the question is withdrawn",
                   previews_[*changed].number + 1));
  return true;
}

language_model::Question ThinkingPlane::write_question(const std::vector<std::size_t>& which) {
  language_model::Question question;
  for (const std::size_t i : which) {
    Preview& preview = previews_[i];
    preview.prompt = prompt_of(preview);
    if (!tools_.asking.facts) {
      preview.prompt = language_model::without_facts(preview.prompt);
    }
    if (!tools_.asking.risks) {
      preview.prompt = language_model::without_risks(preview.prompt);
    }
    question.scenes.push_back(preview.prompt);
    question.grammars.push_back(grammar_of(preview));
  }
  return question;
}

void ThinkingPlane::hear(const OpenQuestion& question, const language_model::Progress& news) {
  Preview& preview = previews_[question.which[news.prompt]];
  if (!tools_.asking.reasoning && !preview.reply.answers.empty()) {
    return;  // the first answer stands
  }
  if (!news.text.empty()) {
    output_.reasoning(preview.number, news.text);
  }
  if (news.answer != nullptr) {
    const double each = (question.round.time_of(news.answer->time) - question.asked_at) /
                        static_cast<double>(question.which.size());
    fastest_answer_ = fastest_answer_ > 0.0 ? std::min(fastest_answer_, each) : each;
    take_answer(question.round, preview, *news.answer);
  }
}

void ThinkingPlane::take_replies(const OpenQuestion& question,
                                 const std::vector<language_model::Reply>& replies) {
  for (std::size_t k = 0; k < replies.size() && k < question.which.size(); ++k) {
    Preview& preview = previews_[question.which[k]];
    preview.unheard = replies[k].answers.empty() && !preview.plan;
    if (preview.unheard) {
      preview.missed = question.left;
    }
    preview.reply.prompt_tokens = replies[k].prompt_tokens;
    if (!tools_.asking.reasoning) {
      continue;
    }
    preview.reply.reasoning = replies[k].reasoning;
    preview.reply.reply_tokens = replies[k].reply_tokens;
    judge_reasoning(question.round, preview);
  }
}

void ThinkingPlane::ask_again_later(const OpenQuestion& question, double missed) {
  for (const std::size_t i : question.which) {
    previews_[i].unheard = !previews_[i].plan;
    previews_[i].missed = missed;
  }
}

void ThinkingPlane::ask_model(const Round& round, const std::vector<std::size_t>& which) {
  const language_model::Question asked = write_question(which);
  double left = std::numeric_limits<double>::infinity();
  for (const std::size_t i : which) {
    left = std::min(left, time_left(round, previews_[i].newest_scene));
  }
  const OpenQuestion question{round, which, round.now(), left};
  tell(round, EventKind::ask,
       fmt::format("the model is asked about {} forecast{}, {:.1f} s left", which.size(),
                   which.size() == 1 ? "" : "s", left));
  std::stop_source withdrawn;
  const std::stop_callback withdraw(round.stop, [&] { withdrawn.request_stop(); });
  bool outdated = false;
  double looked_at = question.asked_at;
  const auto progress = [&](const language_model::Progress& news) {
    if (round.newest && !outdated && round.now() >= looked_at + looked_again) {
      outdated = is_outdated(round, which);
      looked_at = round.now();
      if (outdated) {
        withdrawn.request_stop();
      }
    }
    if (!outdated && news.prompt < which.size()) {
      hear(question, news);
    }
  };
  const auto replies =
      tools_.model->ask(asked.scenes, round.clock_at(question.asked_at + left), progress,
                        {.stop = withdrawn.get_token(), .grammars = asked.grammars});
  if (!replies.has_value() && round.stop.stop_requested()) {
    return;  // nobody waits for it any more
  }
  if (replies.has_value()) {
    take_replies(question, replies.value());
  } else if (!outdated) {
    ++deadline_misses_;
    ask_again_later(question, replies.error().code == Error::Code::too_late ? left : 0.0);
    tell(round, EventKind::fault, "model: " + replies.error().message);
  }
  if (outdated) {  // the next round asks about all that have no plan
    ask_again_later(question, 0.0);
  }
}

void ThinkingPlane::take_answer(const Round& round, Preview& preview,
                                const language_model::Answer& answer) {
  const PolicyId policy = language_model::likeliest_policy(answer);
  const double time = round.time_of(answer.time);
  preview.reply.answers.push_back(answer);
  preview.reply.answers.back().time = from_seconds(time);
  output_.event({time, Plane::thinking,
                 answer.kind == language_model::Answer::Kind::first ? EventKind::first_answer
                                                                    : EventKind::answer,
                 fmt::format("forecast {}: the model says {} {} ({:.0f} %)", preview.number + 1,
                             manoeuvre::index(policy), name(policy),
                             100.0 * answer.probability[manoeuvre::index(policy)])});
  settle(preview, policy, reflex::Source::model, time, tools_.guard != reflex::Guard::none);
}

// What an ordinary check let pass is withdrawn where it rests on false reasons and is not the best.
void ThinkingPlane::judge_reasoning(const Round& round, Preview& preview) {
  if (preview.reply.reasoning.empty() || preview.reply.answers.empty()) {
    return;
  }
  const PolicyId chosen = language_model::likeliest_policy(preview.reply.answers.back());
  preview.truth = language_model::truth_of(preview.reply, preview.prompt, preview.situation);
  if (!preview.truth->is_choice_unfounded() || tools_.guard == reflex::Guard::none) {
    return;
  }
  Check strict = check_unfounded(chosen, preview.situation);
  tell(round, EventKind::check,
       fmt::format("forecast {}: truth check failed: {}; {}", preview.number + 1,
                   preview.truth->wrong_reason(), strict.text));
  if (strict.passed) {
    return;
  }
  if (preview.check && preview.check->passed) {
    preview.check = std::move(strict);
  }
  if (preview.plan && preview.source == reflex::Source::model && preview.plan->policy == chosen) {
    preview.plan.reset();
    preview.ready.reset();
    publish(round.now());
  }
}

bool ThinkingPlane::settle(Preview& preview, PolicyId policy, reflex::Source source, double ready,
                           bool needs_check) {
  const preview::PolicyFacts& fact = preview.situation.facts[manoeuvre::index(policy)];
  preview.check = check(fact.plan, preview.situation, tools_.forecast);
  if (needs_check || !preview.check->passed) {
    output_.event({ready, Plane::thinking, EventKind::check,
                   fmt::format("rollout check {}: {}", preview.check->passed ? "passed" : "failed",
                               preview.check->text)});
  }
  if (!fact.drivable() || (needs_check && !preview.check->passed)) {
    return false;  // what was checked before stands
  }
  if (preview.plan != fact.plan) {
    output_.event({ready, Plane::thinking, EventKind::cached,
                   fmt::format("forecast {}: {} {} is ready", preview.number + 1,
                               manoeuvre::index(policy), name(policy))});
  }
  preview.plan = fact.plan;
  preview.worse_than_aeb = !preview.check->passed;
  preview.source = source;
  preview.ready = ready;
  publish(ready);
  return true;
}

void ThinkingPlane::publish(double ready) const {
  reflex::PlanCache cache;
  for (const std::int32_t number : current_) {
    const Preview& preview = *find_preview(previews_, number);
    if (!preview.plan || cache.full()) {
      continue;
    }
    cache.push_back({.at_trigger = match::features(preview.newest_scene),
                     .trigger = preview.newest_scene.time,
                     .plan = *preview.plan,
                     .source = preview.source,
                     .worse_than_aeb = preview.worse_than_aeb,
                     .preview = preview.number});
  }
  output_.publish(cache, ready);
}

}  // namespace saca::arbitration
