// The batch against the scalar model, where it matters: in encounters.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/base/core/percentile.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/eval/scenes_for_test.h"
#include "saca/lab/families/family.h"
#include "saca/lab/families/splits.h"
#include "saca/lab/prepare/shipped_cars_for_test.h"
#include "saca/onboard/collision/ordering.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::eval::rollout_agreement_test {
namespace {

using manoeuvre::PolicyId;
using prepare::default_car;

/// Family by family in turn, from the tuning split, with chance drawn; those that trigger.
struct Encounters {
  std::vector<scenario::Scenario> scenarios;
  std::vector<DecisionPoint> points;

  explicit Encounters(int count) {
    const std::filesystem::path folder = "scenarios/families";
    const auto splits = families::load_splits("scenarios/splits.toml").value();
    std::vector<families::Family> families;
    for (const char* const name : {"crossing", "cut_in", "cut_out", "cyclist", "head_on",
                                   "lead_brakes", "merge", "one_way", "pedestrian", "dart_out"}) {
      const bool test_only = std::find(splits.test_only.begin(), splits.test_only.end(), name) !=
                             splits.test_only.end();
      if (!test_only) {
        families.push_back(families::load_family(folder, name).value());
      }
    }
    const auto body = manoeuvre::footprint(default_car());
    const auto seed = splits.seeds[static_cast<std::size_t>(families::Split::tuning)];
    for (int i = 0; i < count; ++i) {
      const auto number = static_cast<std::uint64_t>(i);
      scenarios.push_back(
          families::sample(families[number % families.size()], seed, number, "compact_rwd_ev", body)
              .value()
              .scenario);
    }
    for (std::size_t i = 0; i < scenarios.size(); ++i) {
      if (const auto time = trigger_time(scenarios[i], default_car())) {
        const auto chance = scenario::draw_chance(seed, i, *time);
        points.push_back(decision_point_at(scenarios[i], default_car(), *time, chance));
      }
    }
  }
};

collision::Outcome scalar(const DecisionPoint& point, const manoeuvre::Plan& plan) {
  constexpr double horizon = 20.0;  // [s] as roll_out_all, but where a stop takes longer
  const double grip = std::min(1.2, point.grip * point.perturbation.grip);
  return rollout::collision_sequence(
             drive(default_car(), plan, point.scene, point.grip, horizon, point.perturbation),
             point.scene, point.others, shipped_harm(), grip)
      .outcome;
}

/// How one policy ends by both.
struct OutcomePair {
  PolicyId policy;
  collision::Outcome batch, scalar;
};

std::vector<std::vector<OutcomePair>> outcome_pairs(const Encounters& encounters) {
  const int threads = usual_threads();
  const auto batch = hindsights(encounters.points, default_car(), shipped_harm(), threads);
  std::vector<std::vector<OutcomePair>> pairs(batch.size());
  in_parallel(batch.size(), threads, [&](std::size_t i) {
    for (const encounter::Hindsight& one : batch[i]) {
      if (one.facts.drivable()) {
        pairs[i].push_back({one.facts.plan.policy, one.facts.outcome(),
                            scalar(encounters.points[i], one.facts.plan)});
      }
    }
  });
  return pairs;
}

PolicyId best_policy(const std::vector<OutcomePair>& all, collision::Outcome OutcomePair::*by) {
  return std::min_element(all.begin(), all.end(),
                          [&](const OutcomePair& a, const OutcomePair& b) {
                            return collision::better(a.*by, a.policy, b.*by, b.policy);
                          })
      ->policy;
}

// SACA_AGREEMENT_ENCOUNTERS says how many; `make soak` takes thousands.
TEST(RolloutAgreement, TheBatchEndsAsTheScalarModelDoes) {
  const char* const wanted = std::getenv("SACA_AGREEMENT_ENCOUNTERS");
  const auto pairs = outcome_pairs(Encounters(wanted == nullptr ? 14 : std::stoi(wanted)));
  int count = 0;
  int agree = 0;
  int best_agrees = 0;
  std::vector<double> speeds;
  std::vector<double> clearances;
  for (const std::vector<OutcomePair>& all : pairs) {
    best_agrees +=
        best_policy(all, &OutcomePair::batch) == best_policy(all, &OutcomePair::scalar) ? 1 : 0;
    for (const OutcomePair& pair : all) {
      ++count;
      const auto& a = pair.batch.contact;
      const auto& b = pair.scalar.contact;
      agree += a.has_value() == b.has_value() ? 1 : 0;
      if (a && b) {
        speeds.push_back(std::abs(a->relative_speed - b->relative_speed));
      } else if (!a && !b) {
        clearances.push_back(std::abs(pair.batch.clearance - pair.scalar.clearance));
      }
    }
  }
  fmt::print(
      "{} encounters, {} futures: contact agrees in {:.2f} %, the best policy in {} of {}; "
      "impact speed off by {:.3f} m/s (p95, max {:.3f}), clearance by {:.3f} m (p95, max "
      "{:.3f})\n",
      pairs.size(), count, 100.0 * agree / count, best_agrees, pairs.size(),
      percentile(speeds, 0.95), *std::max_element(speeds.begin(), speeds.end()),
      percentile(clearances, 0.95), *std::max_element(clearances.begin(), clearances.end()));
  EXPECT_GE(count, 80);
  EXPECT_GE(best_agrees, 0.95 * static_cast<double>(pairs.size()));
  EXPECT_GE(agree, 0.99 * count);
  EXPECT_LE(percentile(speeds, 0.95), 0.05);
  EXPECT_LE(percentile(clearances, 0.95), 0.05);
}

}  // namespace
}  // namespace saca::eval::rollout_agreement_test
