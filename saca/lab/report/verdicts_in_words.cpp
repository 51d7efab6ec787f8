#include "saca/lab/report/verdicts_in_words.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "saca/onboard/manoeuvre/plan.h"

namespace saca::report {
namespace {

using nlohmann::json;
using Sentences = std::vector<std::string>;

/// Of a plan, or of what else has its keys. Records that are older than strengths have none.
manoeuvre::Plan plan_of(const json& plan) {
  const auto number = [&](const char* key) {
    const auto found = plan.find(key);
    return found == plan.end() || found->is_null() ? std::nullopt
                                                   : std::optional(found->get<double>());
  };
  return {manoeuvre::policy_from(plan.at("policy").get<int>())
              .value_or(manoeuvre::PolicyId::no_intervention),
          number("target_speed_mps"), number("strength")};
}

/// What one verdict says of a plan, and of going on with what was under way.
struct Beside {
  double time = 0.0;  ///< of the judged scene [s]
  double harm = 0.0;
  double contact = 0.0;
  double harm_before = 0.0;  ///< of going on
  json speaks_for;           ///< the plan that the verdict by itself would begin
};

/// The forecaster's verdicts; none where the record is older than they.
std::vector<const json*> forecast(const json& record) {
  std::vector<const json*> all;
  if (const auto verdicts = record.find("verdicts"); verdicts != record.end()) {
    for (const json& one : verdicts->at("in_hand")) {
      if (!one.at("by_atlas").get<bool>()) {
        all.push_back(&one);
      }
    }
  }
  return all;
}

/// nullopt: there is no such plan, or it cannot be driven.
std::optional<double> harm_of(const json& plan) {
  return plan.is_null() || plan.at("harm").is_null() ? std::nullopt
                                                     : std::optional(plan.at("harm").get<double>());
}

/// A plan's place among those of its policy: the same in every verdict, though the speed that it
/// brakes to falls with the ego's.
struct Place {
  json policy;
  std::size_t before = 0;  ///< how many of its policy are told before it
};

std::optional<Place> place_of(const json& plan, const json& verdict) {
  Place place{.policy = plan.at("policy")};
  for (const json& one : verdict.at("plans")) {
    if (is_same_plan(one, plan)) {
      return place;
    }
    place.before += one.at("policy") == place.policy ? 1U : 0U;
  }
  return std::nullopt;
}

/// nullopt: the verdict does not hold both that plan and what was under way.
std::optional<Beside> beside(const json& verdict, const Place& place) {
  const auto going_on = harm_of(verdict.at("under_way"));
  std::size_t before = 0;
  for (const json& one : verdict.at("plans")) {
    if (one.at("policy") == place.policy && before++ == place.before) {
      const auto harm = harm_of(one);
      return harm && going_on ? std::optional(Beside{.time = verdict.at("t_s").get<double>(),
                                                     .harm = *harm,
                                                     .contact = one.at("contact").get<double>(),
                                                     .harm_before = *going_on,
                                                     .speaks_for = verdict.at("speaks_for")})
                              : std::nullopt;
    }
  }
  return std::nullopt;
}

/// What the verdicts say of the plan of a switch while the plan before it was under way, without a
/// gap up to the verdict that it was switched by; by time.
std::vector<Beside> up_to(const json& record, const json& change) {
  const double switched = change.at("t_s").get<double>();
  double begun = record.at("decision").at("time_s").get<double>();
  for (const json& one : record.at("switches")) {
    const double time = one.at("t_s").get<double>();
    begun = time < switched ? time : begun;
  }
  std::vector<Beside> told;
  std::optional<Place> place;
  const std::vector<const json*> all = forecast(record);
  for (auto verdict = all.rbegin(); verdict != all.rend(); ++verdict) {
    if ((*verdict)->at("received_s").get<double>() > switched) {
      continue;
    }
    place = place ? place : place_of(change, **verdict);
    const auto one = place ? beside(**verdict, *place) : std::nullopt;
    if (!one || one->time <= begun) {
      break;
    }
    told.insert(told.begin(), *one);
  }
  return told;
}

/// The first of those without a gap up to the last that are such; where not even the last is, how
/// many there are.
template <class Such>
std::size_t begin_of_run(const std::vector<Beside>& all, Such such) {
  std::size_t first = all.size();
  while (first > 0 && such(all[first - 1])) {
    --first;
  }
  return first;
}

/// From when on the verdicts spoke for a plan of this policy; empty where not even the last did.
Sentences spoken_for(const std::vector<Beside>& all, const json& policy) {
  const std::size_t first =
      begin_of_run(all, [&](const Beside& one) { return one.speaks_for.at("policy") == policy; });
  if (first == all.size()) {
    return {};
  }
  const std::string before =
      first == 0 ? ""
                 : fmt::format("; that of {:.2f} s still spoke for {}", all[first - 1].time,
                               plan_name(all[first - 1].speaks_for));
  return {fmt::format("The verdicts spoke for it from that of {:.2f} s on{}.", all[first].time,
                      before)};
}

Sentences why_better(const std::vector<Beside>& all, const json& change) {
  const std::string name = plan_name(change);
  const std::size_t first =
      begin_of_run(all, [](const Beside& one) { return one.harm < one.harm_before; });
  if (first == all.size()) {
    return {};
  }
  Sentences told;
  if (first > 0) {
    const Beside& before = all[first - 1];
    told.push_back(
        fmt::format("By the verdict of {:.2f} s {} was not yet expected to harm less: "
                    "{:.4f}, and going on {:.4f}.",
                    before.time, name, before.harm, before.harm_before));
  }
  told.push_back(fmt::format(
      "From the verdict of {:.2f} s on {} was expected to harm less: {:.4f}, and going on {:.4f}.",
      all[first].time, name, all[first].harm, all[first].harm_before));
  const Sentences spoken = spoken_for(all, change.at("policy"));
  told.insert(told.end(), spoken.begin(), spoken.end());
  if (first + 1 < all.size()) {
    told.push_back(
        fmt::format("By that of {:.2f} s, when it was switched, it was {:.4f} and {:.4f}.",
                    all.back().time, all.back().harm, all.back().harm_before));
  }
  return told;
}

Sentences why_clear(const std::vector<Beside>& all) {
  const std::size_t first =
      begin_of_run(all, [](const Beside& one) { return one.harm == 0.0 && one.contact == 0.0; });
  if (first == all.size()) {
    return {};
  }
  Sentences told;
  if (first > 0) {
    told.push_back(
        fmt::format("By the verdict of {:.2f} s doing nothing still had a chance of contact of "
                    "{:.0f} %.",
                    all[first - 1].time, 100.0 * all[first - 1].contact));
  }
  told.push_back(fmt::format(
      "From the verdict of {:.2f} s on doing nothing was expected to harm nobody under any draw.",
      all[first].time));
  return told;
}

Sentences why_needed(const std::vector<Beside>& all, const std::string& name) {
  Sentences told;
  if (all.size() > 1) {
    const Beside& before = all[all.size() - 2];
    told.push_back(fmt::format("By the verdict of {:.2f} s going on was expected to harm {:.4f}.",
                               before.time, before.harm_before));
  }
  told.push_back(
      fmt::format("By that of {:.2f} s it was {:.4f}, and {} was expected to harm {:.4f}.",
                  all.back().time, all.back().harm_before, name, all.back().harm));
  return told;
}

}  // namespace

std::string plan_name(const json& plan) {
  return manoeuvre::plan_name(plan_of(plan));
}

bool is_same_plan(const json& a, const json& b) {
  return plan_of(a) == plan_of(b);
}

Sentences why_then(const json& record, const json& change) {
  const std::vector<Beside> all = up_to(record, change);
  if (all.empty()) {
    return {};
  }
  const json& reason = change.at("reason");
  return reason == "no longer needed"   ? why_clear(all)
         : reason == "needed after all" ? why_needed(all, plan_name(change))
                                        : why_better(all, change);
}

Sentences why_not_switched(const json& record) {
  const json* most = nullptr;  // the verdict
  const json* best = nullptr;  // its plan
  double gain = 0.0;
  bool is_judged = false;
  for (const json* const verdict : forecast(record)) {
    const auto going_on = harm_of(verdict->at("under_way"));
    for (const json& plan : verdict->at("plans")) {
      const auto harm = harm_of(plan);
      is_judged = is_judged || (going_on && harm);
      if (going_on && harm && *going_on - *harm > gain) {
        gain = *going_on - *harm;
        most = verdict;
        best = &plan;
      }
    }
  }
  if (!is_judged) {
    return {};
  }
  if (most == nullptr) {
    return {"In no verdict after it was another plan expected to harm less than going on."};
  }
  return {
      fmt::format("The most that another plan promised was by the verdict of {:.2f} s: {} was "
                  "expected to harm {:.4f}, and going on {:.4f}.",
                  most->at("t_s").get<double>(), plan_name(*best), *harm_of(*best),
                  *harm_of(most->at("under_way")))};
}

}  // namespace saca::report
