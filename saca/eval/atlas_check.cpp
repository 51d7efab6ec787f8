#include "saca/eval/atlas_check.h"

#include <algorithm>
#include <cmath>

#include "saca/core/percentile.h"
#include "saca/manoeuvre/drive.h"
#include "saca/manoeuvre/ego.h"
#include "saca/outcome/futures.h"
#include "saca/outcome/outcome.h"
#include "saca/outcome/roll_out.h"

namespace saca::eval {
namespace {

using manoeuvre::num_policies;
using outcome::Future;
using outcome::Outcome;

AtlasRow row_of(const Future& told, const Outcome& truth) {
  AtlasRow row{.policy = told.plan.policy, .outside = told.outside};
  row.told_contact = told.contact.has_value();
  row.true_contact = truth.contact.has_value();
  row.told_clearance = told.clearance;
  row.true_clearance = truth.clearance;
  row.probability = told.probability;
  row.told_harm = told.harm;
  row.true_harm = truth.harm;
  if (told.contact && truth.contact) {
    row.same_partner =
        told.contact->actor == truth.contact->actor && told.contact->edge == truth.contact->edge;
    row.same_face = told.contact->ego_face == truth.contact->ego_face;
    row.speed_off = told.contact->relative_speed - truth.contact->relative_speed;
    row.time_off = told.contact->time - truth.contact->time;
  }
  return row;
}

bool usable(const AtlasRow& row) {
  return !row.refused && !row.outside;
}

// As outcome::better sees a policy of this harm and clearance.
bool less(const AtlasRow& a, const AtlasRow& b, double AtlasRow::*harm,
          double AtlasRow::*clearance) {
  Outcome of_a;
  Outcome of_b;
  of_a.harm = a.*harm;
  of_b.harm = b.*harm;
  of_a.clearance = a.*clearance;
  of_b.clearance = b.*clearance;
  return better(of_a, a.policy, of_b, b.policy);
}

// True harm of what the atlas takes for best, above that of the best there is; nullopt: nothing can
// be chosen.
std::optional<double> regret(const std::vector<AtlasRow>& rows) {
  const AtlasRow* chosen = nullptr;
  const AtlasRow* best = nullptr;
  for (const AtlasRow& row : rows) {
    if (row.refused) {
      continue;
    }
    if (usable(row) && (chosen == nullptr ||
                        less(row, *chosen, &AtlasRow::told_harm, &AtlasRow::told_clearance))) {
      chosen = &row;
    }
    if (best == nullptr || less(row, *best, &AtlasRow::true_harm, &AtlasRow::true_clearance)) {
      best = &row;
    }
  }
  return chosen == nullptr ? std::nullopt
                           : std::optional(std::max(0.0, chosen->true_harm - best->true_harm));
}

double percentile_or_none(const std::vector<double>& values, double share) {
  return values.empty() ? 0.0 : percentile(values, share);
}

}  // namespace

std::array<AtlasRow, num_policies> atlas_rows(const Moment& moment, const manoeuvre::Atlas& atlas,
                                              const manoeuvre::Car& car,
                                              const outcome::HarmModel& harm) {
  world::Scene scene = moment.scene;
  scene.grip_sd = 0.0;
  for (world::Actor& actor : scene.actors) {
    actor.position_sd = 0.0;
    actor.velocity_sd = 0.0;
  }
  const manoeuvre::Plan going_on{manoeuvre::PolicyId::no_intervention, std::nullopt};
  const auto tracks = moment.others(drive(car, going_on, scene, scene.grip, 20.0));
  std::array<AtlasRow, num_policies> rows;
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const manoeuvre::Plan plan = manoeuvre::default_plan(policy, scene.ego.v_B.x);
    AtlasRow& row = rows[manoeuvre::index(policy)];
    if (refusal(car, plan, scene)) {
      row = {.policy = policy, .refused = true};
      continue;
    }
    row = row_of(future(atlas, plan, scene, tracks, harm),
                 roll_out(car, plan, scene, tracks, scene.grip, harm));
  }
  return rows;
}

std::vector<AtlasRow> atlas_rows(const sim::Family& family, std::uint64_t seed,
                                 std::uint64_t number, const manoeuvre::Atlas& atlas,
                                 const manoeuvre::Car& car, const outcome::HarmModel& harm) {
  const auto sample = sim::sample(family, seed, number, "atlas", manoeuvre::footprint(car));
  if (!sample.has_value()) {
    return {};
  }
  const sim::Scenario& scenario = sample.value().scenario;
  const auto time = trigger_time(scenario, car);
  if (!time) {
    return {};
  }
  const auto rows = atlas_rows(moment_at(scenario, car, *time), atlas, car, harm);
  return {rows.begin(), rows.end()};
}

AtlasFigures atlas_figures(std::span<const std::vector<AtlasRow>> rows) {
  AtlasFigures figures;
  int covered = 0;
  int agree = 0;
  int both = 0;
  int partner = 0;
  int face = 0;
  int same = 0;
  std::vector<double> speeds;
  std::vector<double> clearances;
  std::vector<double> regrets;
  for (const std::vector<AtlasRow>& scene : rows) {
    figures.scenes += scene.empty() ? 0 : 1;
    for (const AtlasRow& row : scene) {
      figures.plans += row.refused ? 0 : 1;
      if (!usable(row)) {
        continue;
      }
      ++covered;
      agree += row.told_contact == row.true_contact ? 1 : 0;
      if (row.told_contact && row.true_contact) {
        ++both;
        partner += row.same_partner ? 1 : 0;
        face += row.same_face ? 1 : 0;
        if (row.same_partner) {
          speeds.push_back(std::abs(row.speed_off));
        }
      } else if (!row.told_contact && !row.true_contact && row.true_clearance < 5.0) {
        clearances.push_back(std::abs(row.told_clearance - row.true_clearance));
      }
    }
    if (const auto more = scene.empty() ? std::nullopt : regret(scene)) {
      regrets.push_back(*more);
      same += *more < outcome::harm_tie ? 1 : 0;
      figures.regret_mean += *more;
    }
  }
  figures.covered = proportion(covered, std::max(1, figures.plans));
  figures.agreement = proportion(agree, std::max(1, covered));
  figures.partner = proportion(partner, std::max(1, both));
  figures.face = proportion(face, std::max(1, both));
  figures.speed_p50 = percentile_or_none(speeds, 0.5);
  figures.speed_p95 = percentile_or_none(speeds, 0.95);
  figures.speed_max = percentile_or_none(speeds, 1.0);
  figures.clearance_p95 = percentile_or_none(clearances, 0.95);
  figures.regret_p95 = percentile_or_none(regrets, 0.95);
  figures.same_choice = proportion(same, std::max(1, static_cast<int>(regrets.size())));
  figures.regret_mean /= std::max(1.0, static_cast<double>(regrets.size()));
  return figures;
}

}  // namespace saca::eval
