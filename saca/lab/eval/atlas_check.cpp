#include "saca/lab/eval/atlas_check.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "saca/base/core/percentile.h"
#include "saca/onboard/collision/harm.h"
#include "saca/onboard/collision/impact.h"
#include "saca/onboard/collision/outcome.h"
#include "saca/onboard/forecast/futures.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/ego.h"
#include "saca/thinking/rollout/roll_out.h"

namespace saca::eval {
namespace {

using collision::Outcome;
using forecast::Future;

AtlasRow row_of(const Future& told, const Outcome& truth) {
  AtlasRow row{.plan = told.plan, .outside = told.outside};
  row.told_contact = told.contact.has_value();
  row.true_contact = truth.contact.has_value();
  row.told_clearance = told.clearance;
  row.true_clearance = truth.clearance;
  row.probability = told.probability;
  row.forecast_harm = told.harm;
  row.true_harm = truth.harm;
  row.later_contacts = static_cast<int>(truth.later.size());
  if (told.contact && truth.contact) {
    row.same_partner =
        told.contact->actor == truth.contact->actor && told.contact->edge == truth.contact->edge;
    row.same_face = told.contact->ego_face == truth.contact->ego_face;
    row.speed_off = told.contact->relative_speed - truth.contact->relative_speed;
    row.time_off = told.contact->time - truth.contact->time;
  }
  return row;
}

// Is there a contact that a Future's probability counts?
bool stops(const Outcome& truth, const world::Road& road) {
  return truth.contact &&
         (truth.contact->actor || world::is_hard(collision::beyond(road, *truth.contact->edge)));
}

bool usable(const AtlasRow& row) {
  return !row.refused && !row.outside;
}

// As collision::better sees a policy of this harm and clearance.
bool less(const AtlasRow& a, const AtlasRow& b, double AtlasRow::*harm,
          double AtlasRow::*clearance) {
  Outcome of_a;
  Outcome of_b;
  of_a.harm = a.*harm;
  of_b.harm = b.*harm;
  of_a.clearance = a.*clearance;
  of_b.clearance = b.*clearance;
  return better(of_a, a.plan.policy, of_b, b.plan.policy);
}

// What the atlas takes for best, and the best there is; none: nothing can be chosen.
struct Choice {
  const AtlasRow* chosen = nullptr;
  const AtlasRow* best = nullptr;

  [[nodiscard]] double regret() const { return std::max(0.0, chosen->true_harm - best->true_harm); }
  [[nodiscard]] bool lone() const {
    return chosen->later_contacts == 0 && best->later_contacts == 0;
  }
};

Choice choice(const std::vector<AtlasRow>& rows) {
  Choice choice;
  for (const AtlasRow& row : rows) {
    if (row.refused) {
      continue;
    }
    if (usable(row) &&
        (choice.chosen == nullptr ||
         less(row, *choice.chosen, &AtlasRow::forecast_harm, &AtlasRow::told_clearance))) {
      choice.chosen = &row;
    }
    if (choice.best == nullptr ||
        less(row, *choice.best, &AtlasRow::true_harm, &AtlasRow::true_clearance)) {
      choice.best = &row;
    }
  }
  return choice;
}

std::array<manoeuvre::Plan, num_checked> checked_plans(double speed) {
  std::array<manoeuvre::Plan, num_checked> plans;
  auto plan = plans.begin();
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    *plan++ = manoeuvre::default_plan(policy, speed);
  }
  for (const double strength : manoeuvre::braking_strengths) {
    *plan++ = {.policy = manoeuvre::PolicyId::aeb, .strength = strength};
  }
  return plans;
}

double percentile_or_none(const std::vector<double>& values, double share) {
  return values.empty() ? 0.0 : percentile(values, share);
}

std::size_t bin_of(double chance) {
  std::size_t bin = 0;
  while (bin + 2 < chance_bounds.size() && chance >= chance_bounds[bin + 1]) {
    ++bin;
  }
  return bin;
}

ChanceBins chances_of(std::span<const std::vector<AtlasRow>> scenes) {
  ChanceBins bins{};
  std::array<int, bins.size()> touched{};
  for (const std::vector<AtlasRow>& scene : scenes) {
    for (const AtlasRow& row : scene) {
      if (usable(row)) {
        const std::size_t bin = bin_of(row.told_chance);
        ++bins[bin].plans;
        bins[bin].told += row.told_chance;
        touched[bin] += row.drawn_contact ? 1 : 0;
      }
    }
  }
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].low = chance_bounds[i];
    bins[i].high = chance_bounds[i + 1];
    if (bins[i].plans > 0) {
      bins[i].told /= bins[i].plans;
      bins[i].touched = proportion(touched[i], bins[i].plans);
    }
  }
  return bins;
}

LoneRegret lone_regret(std::span<const std::vector<AtlasRow>> scenes) {
  LoneRegret lone;
  double all = 0.0;
  double sum = 0.0;
  std::vector<double> off;
  std::vector<double> lasting;
  for (const std::vector<AtlasRow>& scene : scenes) {
    const Choice made = choice(scene);
    if (made.chosen != nullptr) {
      all += made.regret();
      lone.scenes += made.lone() ? 1 : 0;
      sum += made.lone() ? made.regret() : 0.0;
    }
    for (const AtlasRow& row : scene) {
      if (usable(row) && row.told_contact && row.true_contact) {
        (row.later_contacts == 0 ? off : lasting)
            .push_back(std::abs(row.forecast_harm - row.true_harm));
      }
    }
  }
  lone.mean = sum / std::max(1, lone.scenes);
  lone.share = all > 0.0 ? sum / all : 0.0;
  lone.harm_off_p95 = percentile_or_none(off, 0.95);
  lone.lasting_off_p95 = percentile_or_none(lasting, 0.95);
  return lone;
}

/// Of plans that the atlas covers, how often it is right about the contact.
struct PlanTally {
  int covered = 0;
  int agree = 0;  ///< whether there is one
  int both = 0;   ///< there is one, and it was told
  int partner = 0;
  int face = 0;
  std::vector<double> speeds;      ///< by how much that of the impact is off [m/s]
  std::vector<double> clearances;  ///< by how much that of a near miss is off [m]

  void add(const AtlasRow& row) {
    constexpr double near = 5.0;  // [m]
    ++covered;
    agree += row.told_contact == row.true_contact ? 1 : 0;
    if (row.told_contact && row.true_contact) {
      ++both;
      partner += row.same_partner ? 1 : 0;
      face += row.same_face ? 1 : 0;
      if (row.same_partner) {
        speeds.push_back(std::abs(row.speed_off));
      }
    } else if (!row.told_contact && !row.true_contact && row.true_clearance < near) {
      clearances.push_back(std::abs(row.told_clearance - row.true_clearance));
    }
  }
};

}  // namespace

std::array<AtlasRow, num_checked> atlas_rows(const DecisionPoint& point, const atlas::Atlas& atlas,
                                             const manoeuvre::Car& car,
                                             const collision::HarmModel& harm, std::uint64_t seed) {
  world::Scene scene = point.scene;
  scene.grip_sd = 0.0;
  for (world::Actor& actor : scene.actors) {
    actor.position_sd = 0.0;
    actor.velocity_sd = 0.0;
  }
  const manoeuvre::Plan going_on{manoeuvre::PolicyId::no_intervention, std::nullopt};
  const auto tracks = point.others(drive(car, going_on, scene, scene.grip, 20.0));
  world::Scene doubtful = scene;
  doubtful.grip_sd = grip_sd_share * scene.grip;
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal;
  std::array<AtlasRow, num_checked> rows;
  const auto plans = checked_plans(scene.ego.v_B.x);
  for (std::size_t i = 0; i < num_checked; ++i) {
    const manoeuvre::Plan& plan = plans[i];
    AtlasRow& row = rows[i];
    const double drawn = scene.grip * std::max(0.1, 1.0 + grip_sd_share * normal(rng));
    if (refusal(car, plan, scene)) {
      row = {.plan = plan, .refused = true};
      continue;
    }
    row = row_of(forecast::future(atlas, plan, scene, tracks, harm),
                 rollout::roll_out(car, plan, scene, tracks, scene.grip, harm));
    row.told_chance = forecast::future(atlas, plan, doubtful, tracks, harm).probability;
    row.drawn_contact =
        stops(rollout::roll_out(car, plan, scene, tracks, std::min(1.2, drawn), harm), scene.road);
  }
  return rows;
}

std::vector<AtlasRow> atlas_rows(const families::Family& family, std::uint64_t seed,
                                 std::uint64_t number, const atlas::Atlas& atlas,
                                 const manoeuvre::Car& car, const collision::HarmModel& harm) {
  const auto sample = families::sample(family, seed, number, "atlas", manoeuvre::footprint(car));
  if (!sample.has_value()) {
    return {};
  }
  const scenario::Scenario& scenario = sample.value().scenario;
  const auto time = trigger_time(scenario, car);
  if (!time) {
    return {};
  }
  const auto rows = atlas_rows(decision_point_at(scenario, car, *time), atlas, car, harm,
                               seed + 1'000'003 * number);
  return {rows.begin(), rows.end()};
}

AtlasFigures atlas_figures(std::span<const std::vector<AtlasRow>> rows) {
  AtlasFigures figures;
  PlanTally tally;
  int same = 0;
  std::vector<double> regrets;
  for (const std::vector<AtlasRow>& scene : rows) {
    figures.scenes += scene.empty() ? 0 : 1;
    for (const AtlasRow& row : scene) {
      figures.plans += row.refused ? 0 : 1;
      if (usable(row)) {
        tally.add(row);
      }
    }
    if (const Choice made = choice(scene); made.chosen != nullptr) {
      const double more = made.regret();
      regrets.push_back(more);
      same += more < collision::harm_tie ? 1 : 0;
      figures.regret_mean += more;
    }
  }
  figures.covered = proportion(tally.covered, std::max(1, figures.plans));
  figures.agreement = proportion(tally.agree, std::max(1, tally.covered));
  figures.partner = proportion(tally.partner, std::max(1, tally.both));
  figures.face = proportion(tally.face, std::max(1, tally.both));
  figures.speed_p50 = percentile_or_none(tally.speeds, 0.5);
  figures.speed_p95 = percentile_or_none(tally.speeds, 0.95);
  figures.speed_max = percentile_or_none(tally.speeds, 1.0);
  figures.clearance_p95 = percentile_or_none(tally.clearances, 0.95);
  figures.regret_p95 = percentile_or_none(regrets, 0.95);
  figures.same_choice = proportion(same, std::max(1, static_cast<int>(regrets.size())));
  figures.lone = lone_regret(rows);
  figures.chances = chances_of(rows);
  figures.regret_mean /= std::max(1.0, static_cast<double>(regrets.size()));
  return figures;
}

}  // namespace saca::eval
