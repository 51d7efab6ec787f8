#include "saca/lab/eval/comparison.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "saca/onboard/reflex/trigger.h"
#include "saca/thinking/rollout/describe.h"

namespace saca::eval {
namespace {

using encounter::Action;
using encounter::ClosedLoop;
using manoeuvre::PolicyId;

/// A simulation, and who has done the same in it so far.
struct Branch {
  ClosedLoop loop;
  std::vector<std::size_t> methods;  ///< none: it only looks for T1
  Avoider* avoider = nullptr;        ///< who drives; nullptr: the loop itself
  bool untouched = true;             ///< nobody has acted in it
  bool decided = false;              ///< at this instant everybody has been asked
  double time = 0.0;                 ///< of the look before [s]
  double ego_speed = 0.0;            ///< then [m/s]
  double peak_deceleration = 0.0;    ///< so far [m/s^2]
};

/// What some methods do now alike.
struct Group {
  std::optional<Action> action;
  std::vector<std::size_t> methods;
  Avoider* avoider = nullptr;  ///< who does it, for one method alone; nullptr: the loop does
};

/// Of the ego, between the last look at which nobody was touched and now [m/s].
double speed_at(const Branch& branch, double time) {
  const double now = norm(branch.loop.truth().ego().v_B);
  const double since = branch.loop.time() - branch.time;
  const double share = since > 0.0 ? std::clamp((time - branch.time) / since, 0.0, 1.0) : 1.0;
  return branch.ego_speed + share * (now - branch.ego_speed);
}

bool alike(const std::optional<Action>& a, const std::optional<Action>& b) {
  return a.has_value() == b.has_value() &&
         (!a || (a->plan == b->plan && a->deceleration == b->deceleration));
}

class Play {
 public:
  Play(const encounter::Stage& stage,
       const std::vector<std::unique_ptr<encounter::Method>>& methods, Hindsight& hindsight)
      : stage_(stage), methods_(methods), hindsight_(hindsight) {
    comparison_.runs.resize(methods.size());
  }

  Result<Comparison> all() {
    Branch trunk{.loop = ClosedLoop(stage_), .methods = {}};
    for (std::size_t i = 0; i < methods_.size(); ++i) {
      trunk.methods.push_back(i);
    }
    waiting_.push_back(std::move(trunk));
    while (!waiting_.empty()) {
      Branch branch = std::move(waiting_.back());
      waiting_.pop_back();
      play(std::move(branch));
      if (problem_) {
        return *problem_;
      }
    }
    return std::move(comparison_);
  }

 private:
  void play(Branch branch);
  /// One look, and what everybody does then; who parts from the others waits with a simulation of
  /// its own.
  /// @return  false: a scene breaks a rule, and the simulation ends
  [[nodiscard]] bool ask(Branch& branch);
  [[nodiscard]] std::vector<Group> decide(const Branch& branch);
  void note_trigger(const Branch& branch);
  static void note_motion(Branch& branch);
  void begin(Branch& branch, const Group& group);
  void conclude(const Branch& branch);
  /// A method is asked no more.
  void give_up(std::size_t method, std::string fault) {
    comparison_.runs[method].fault = std::move(fault);
  }

  const encounter::Stage& stage_;
  const std::vector<std::unique_ptr<encounter::Method>>& methods_;
  Hindsight& hindsight_;
  Comparison comparison_;
  std::vector<Branch> waiting_;
  std::optional<Error> problem_;
};

void Play::play(Branch branch) {
  ClosedLoop& loop = branch.loop;
  while (!loop.over()) {
    if (!branch.decided && !ask(branch)) {
      break;
    }
    branch.decided = false;
    loop.keep();
    if (loop.contact()) {
      break;  // what the ego does from now on is the outcome's
    }
    note_motion(branch);
    branch.avoider != nullptr ? loop.advance(*branch.avoider) : loop.advance();
  }
  conclude(branch);
}

void Play::note_motion(Branch& branch) {
  const world::EgoState ego = branch.loop.truth().ego();
  branch.time = branch.loop.time();
  branch.ego_speed = norm(ego.v_B);
  branch.peak_deceleration = std::max(branch.peak_deceleration, -ego.a_B.x);
}

bool Play::ask(Branch& branch) {
  ClosedLoop& loop = branch.loop;
  if (auto problem = loop.look()) {
    for (const std::size_t method : branch.methods) {
      give_up(method, problem->message);
    }
    problem_ = branch.untouched && !branch.methods.empty() ? std::move(problem) : std::nullopt;
    return false;
  }
  if (loop.wake() && branch.untouched) {
    comparison_.woke = loop.time();
  }
  if (branch.untouched) {
    note_trigger(branch);
  }
  std::vector<Group> groups = decide(branch);
  if (branch.untouched && !comparison_.trigger &&
      std::all_of(groups.begin(), groups.end(), [](const Group& one) { return one.action; })) {
    groups.push_back({std::nullopt, {}, nullptr});
  }
  if (groups.empty()) {
    return false;  // T1 is known
  }
  for (std::size_t k = 1; k < groups.size(); ++k) {
    Branch split = branch;
    split.decided = true;
    begin(split, groups[k]);
    waiting_.push_back(std::move(split));
  }
  begin(branch, groups.front());
  return true;
}

std::vector<Group> Play::decide(const Branch& branch) {
  std::vector<Group> groups;
  for (const std::size_t method : branch.methods) {
    std::optional<Action> action;
    if (comparison_.runs[method].fault.empty()) {
      try {
        action = methods_[method]->step({branch.loop.seen(), branch.loop.beliefs(),
                                         branch.loop.confirmed(), branch.loop.driven(),
                                         branch.loop.finished(), branch.loop});
      } catch (const std::exception& fault) {
        give_up(method, *fault.what() == '\0' ? "an exception without text" : fault.what());
      }
    }
    Avoider* const avoider = action ? methods_[method]->avoider() : nullptr;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return avoider == nullptr && group.avoider == nullptr && alike(group.action, action);
    });
    if (same == groups.end()) {
      groups.push_back({action, {method}, avoider});
    } else {
      same->methods.push_back(method);
    }
    if (action) {
      MethodRun& run = comparison_.runs[method];
      if (!run.acted_at && action->plan.policy != PolicyId::no_intervention) {
        run.acted_at = branch.loop.time();
      }
      if (!run.plan) {
        run.source = action->source;
        run.reason = action->reason;
      }
    }
  }
  return groups;
}

void Play::note_trigger(const Branch& branch) {
  const ClosedLoop& loop = branch.loop;
  if (comparison_.trigger || !loop.driven()) {
    return;
  }
  const auto threat = loop.trigger();
  if (!threat) {
    return;
  }
  comparison_.trigger = loop.time();
  comparison_.threat = actor_name(loop.seen().actors[threat->actor]);
  const auto& tried = hindsight_.at(loop);
  for (const preview::RolledOut& one : tried) {
    const bool driven = one.facts.drivable();
    comparison_.tried.push_back(
        {.plan = one.facts.plan,
         .harm = driven ? std::optional(one.facts.outcome().harm) : std::nullopt,
         .contact = driven && one.facts.outcome().contact.has_value()});
  }
  const std::size_t best = best_of(tried);
  comparison_.best = tried[best].facts.plan;
  comparison_.best_harm = tried[best].facts.outcome().harm;
  comparison_.published_best_harm =
      tried[best_of(tried, forecast::Braking::full)].facts.outcome().harm;
}

void Play::begin(Branch& branch, const Group& group) {
  branch.methods = group.methods;
  if (!group.action) {
    return;
  }
  ClosedLoop& loop = branch.loop;
  std::optional<std::string> refused;
  if (group.avoider != nullptr) {
    branch.avoider = group.avoider;
  } else if (!branch.untouched && loop.plan() == group.action->plan) {  // it goes on
    loop.limit_braking(group.action->deceleration);
    return;
  } else {
    refused = loop.carry_out(group.action->plan, group.action->deceleration);
  }
  branch.untouched = false;
  for (const std::size_t method : group.methods) {
    MethodRun& run = comparison_.runs[method];
    run.switches += run.plan ? 1 : 0;
    if (refused && !run.plan) {
      run.reason = "cannot be driven: " + *refused;
    }
    if (!run.plan || run.plan->policy == PolicyId::no_intervention) {
      run.plan = group.avoider != nullptr ? group.action->plan : loop.plan();
    }
  }
}

void Play::conclude(const Branch& branch) {
  const bool never_came = branch.untouched && !comparison_.trigger;
  if (branch.methods.empty() && !never_came) {
    return;
  }
  const auto outcome = branch.loop.outcome();
  if (never_came && outcome) {
    comparison_.best_harm = outcome->harm;
    comparison_.published_best_harm = outcome->harm;
  }
  for (const std::size_t method : branch.methods) {
    MethodRun& run = comparison_.runs[method];
    run.clearance = collision::far_away;
    run.thinking = methods_[method]->thinking();
    run.peak_deceleration = branch.peak_deceleration;
    if (!outcome) {
      continue;
    }
    run.harm = outcome->harm;
    run.collision_loss = outcome->collision_loss;
    run.clearance = outcome->clearance;
    if (outcome->contact) {
      const collision::Contact& contact = *outcome->contact;
      run.met = contact.actor ? actor_name(branch.loop.met().actors[*contact.actor])
                              : std::string("edge");
      run.impact_speed = contact.relative_speed;
      run.ego_speed = speed_at(branch, contact.time);
    }
  }
}

}  // namespace

bool MethodRun::intervened() const {
  return acted_at.has_value();
}

Result<Comparison> compare(const encounter::Stage& stage,
                           const std::vector<std::unique_ptr<encounter::Method>>& methods,
                           Hindsight& hindsight) {
  return Play(stage, methods, hindsight).all();
}

}  // namespace saca::eval
