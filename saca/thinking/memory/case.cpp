#include "saca/thinking/memory/case.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/names.h"
#include "saca/base/core/printable.h"

namespace saca::memory {
namespace {

constexpr std::array<std::string_view, 4> origin_names{"own", "simulation", "recording", "expert"};
constexpr std::array<std::string_view, 3> trust_names{"trusted", "unchecked", "quarantined"};

bool is_amount(double number) {
  return std::isfinite(number) && number >= 0.0;
}

bool is_share(double number) {
  return number >= 0.0 && number <= 1.0;
}

bool are_harms(const std::optional<PolicyHarms>& harms) {
  return !harms || std::all_of(harms->begin(), harms->end(), [](const std::optional<double>& one) {
    return !one || is_amount(*one);
  });
}

bool is_posterior(const intent::IntentPosterior& one) {
  return std::all_of(one.begin(), one.end(), is_share);
}

}  // namespace

std::string_view name(Origin origin) {
  return name_of(origin, origin_names);
}

std::optional<Origin> origin_from(std::string_view name) {
  return value_from<Origin>(name, origin_names);
}

std::string_view name(Trust trust) {
  return name_of(trust, trust_names);
}

std::optional<Trust> trust_from(std::string_view name) {
  return value_from<Trust>(name, trust_names);
}

std::string car_and_harm(std::span<const MadeWith> made_with) {
  const auto digest = [&](const char* what) {
    const auto found = std::find_if(made_with.begin(), made_with.end(),
                                    [what](const MadeWith& one) { return one.what == what; });
    return found == made_with.end() ? std::string() : found->digest;
  };
  const std::string car = digest("car");
  const std::string harm = digest("harm");
  return car.empty() || harm.empty() ? std::string() : car + '\n' + harm;
}

bool same_car_and_harm(std::span<const MadeWith> then, std::span<const MadeWith> now) {
  const std::string known = car_and_harm(then);
  return !known.empty() && known == car_and_harm(now);
}

bool may_be_the_same_car(std::span<const MadeWith> a, std::span<const MadeWith> b) {
  return a.empty() || b.empty() || same_car_and_harm(a, b);
}

bool is_hearsay(const Case& one) noexcept {
  return one.origin == Origin::expert && !one.happened;
}

bool is_trusted_by(std::span<const MadeWith> car, const Case& one) {
  return one.trust == Trust::trusted && (car.empty() || same_car_and_harm(one.made_with, car));
}

bool is_trusted_by_another(std::span<const MadeWith> car, const Case& one) {
  return one.trust == Trust::trusted && !car_and_harm(one.made_with).empty() &&
         !is_trusted_by(car, one);
}

std::optional<CaseProblem> broken_rule(const Case& one) {
  constexpr const char* amount = "want a finite number >= 0";
  constexpr const char* harms = "want 8 numbers >= 0, or null where a policy cannot be driven";
  constexpr const char* few = "want at most 100";
  constexpr const char* shares = "want shares from 0 to 1";
  constexpr const char* utf8 = "want UTF-8";
  constexpr const char* per_actor = "want one per actor of the scene, or none";
  const std::size_t actors = one.scene.actors.size();
  const auto per_actor_or_none = [&](std::size_t size) { return size == 0 || size == actors; };
  const struct {
    bool holds;
    const char* key;
    const char* why;
  } rules[] = {
      {is_amount(one.harm), "harm", amount},
      {is_amount(one.best_harm), "best_harm", amount},
      {is_amount(one.collision_loss), "collision_loss", amount},
      {!one.worst_harm || is_amount(*one.worst_harm), "worst_harm", amount},
      {!one.plan.target_speed || is_amount(*one.plan.target_speed), "target_speed_mps", amount},
      {!one.plan.target_speed || manoeuvre::brakes_to_speed(one.plan.policy), "target_speed_mps",
       "only policies 3 and 4 have one"},
      {!one.plan.strength || (manoeuvre::takes_strength(one.plan.policy) &&
                              *one.plan.strength > 0.0 && *one.plan.strength <= 1.0),
       "strength", "only policy 0 has one, of at most 1"},
      {one.count >= 1, "count", "want a whole number >= 1"},
      {one.draws >= 1, "draws", "want a whole number >= 1"},
      {per_actor_or_none(one.intentions.size()), "intentions", per_actor},
      {std::all_of(one.intentions.begin(), one.intentions.end(), is_posterior), "intentions",
       shares},
      {per_actor_or_none(one.risks.size()), "risks", per_actor},
      {std::all_of(one.risks.begin(), one.risks.end(), is_share), "risks", shares},
      {is_utf8(one.review), "review", utf8},
      {is_utf8(one.source), "source", utf8},
      {std::all_of(one.lessons.begin(), one.lessons.end(), is_utf8), "lessons", utf8},
      {one.lessons.size() <= most_texts, "lessons", few},
      {one.made_with.size() <= most_texts, "made_with", few},
      {are_harms(one.told), "told", harms},
      {are_harms(one.happened), "happened", harms},
  };
  for (const auto& rule : rules) {
    if (!rule.holds) {
      return CaseProblem{rule.key, rule.why};
    }
  }
  return std::nullopt;
}

}  // namespace saca::memory
