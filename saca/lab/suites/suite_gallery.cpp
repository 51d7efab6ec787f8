#include "saca/lab/suites/suite_gallery.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "saca/lab/eval/suite_figures.h"

namespace saca::suites {
namespace {

using eval::MethodRun;
using eval::SuiteRow;

constexpr std::size_t gallery_size = 12;

const preview::RolledOut* tried_of(const eval::TriedScene& scene, const manoeuvre::Plan& plan) {
  for (const preview::RolledOut& one : scene.tried) {
    const manoeuvre::Plan& tried = one.facts.plan;
    if (tried.policy == plan.policy && strength_of(tried) == strength_of(plan) &&
        std::abs(tried.target_speed.value_or(0.0) - plan.target_speed.value_or(0.0)) < 0.5) {
      return &one;
    }
  }
  return nullptr;
}

/// One line why it was lost.
std::string why_of(const SuiteRow& row, const MethodRun& run) {
  const std::string met = run.met
                              ? fmt::format("meets {} at {:.1f} m/s", *run.met, run.impact_speed)
                              : "meets nobody at first";
  return fmt::format("{} {}, harm {:.3f}; {} would have done {:.3f}. {}",
                     run.plan ? plan_text(*run.plan) : "Nothing is done and it", met, run.harm,
                     row.risk.best ? plan_text(*row.risk.best) : "doing nothing",
                     row.risk.best_harm, run.reason);
}

std::optional<report::GalleryCard> card_of(const SuiteRun& run, const SuiteRow& row,
                                           const SuiteRequest& request,
                                           const PictureOf& picture_of) {
  const auto encounter = run.encounter_at(row.number);
  if (!encounter.has_value() || !row.risk.best) {
    return std::nullopt;
  }
  const auto scene = run.tried_in(encounter.value());
  if (!scene) {
    return std::nullopt;
  }
  const MethodRun& first = row.risk.runs.front();
  const manoeuvre::Plan nothing{manoeuvre::PolicyId::no_intervention, std::nullopt};
  const auto* const done = tried_of(*scene, first.plan.value_or(nothing));
  const auto* const best = tried_of(*scene, *row.risk.best);
  if (done == nullptr || best == nullptr) {
    return std::nullopt;
  }
  report::GalleryCard card{
      .title = fmt::format("{} {}: regret {:.3f}", row.family, row.number,
                           first.harm - row.risk.best_harm),
      .lines = {why_of(row, first)},
      .done = picture_of(scene->scene, *done),
      .best = picture_of(scene->scene, *best),
      .command = fmt::format("saca suite {} --split {} --seed {}{}{} --replay {}", request.name,
                             request.split, request.seed, request.exact ? " --exact" : "",
                             thinking_text(request.thinking) +
                                 (request.car == "compact_rwd_ev" ? "" : " --car " + request.car) +
                                 (request.data.empty() ? "" : " --data " + request.data.front()),
                             row.number)};
  card.done.badge = "done";
  card.best.badge = "best";
  return card;
}

}  // namespace

std::vector<report::GalleryCard> gallery_of(const SuiteRun& run, const SuiteRequest& request,
                                            const PictureOf& picture_of) {
  std::vector<const SuiteRow*> worst;
  for (const SuiteRow& row : run.rows) {
    if (counts_in_figures(row) &&
        row.risk.runs.front().harm > row.risk.best_harm + eval::material) {
      worst.push_back(&row);
    }
  }
  const auto regret = [](const SuiteRow* row) {
    return row->risk.runs.front().harm - row->risk.best_harm;
  };
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const SuiteRow* a, const SuiteRow* b) { return regret(a) > regret(b); });
  std::vector<report::GalleryCard> cards;
  for (const SuiteRow* const row : worst) {
    if (cards.size() == gallery_size) {
      break;
    }
    if (auto card = card_of(run, *row, request, picture_of)) {
      cards.push_back(std::move(*card));
    }
  }
  return cards;
}

}  // namespace saca::suites
