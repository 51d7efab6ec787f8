#include "apps/saca/memory_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/memory/feature_index.h"
#include "saca/memory/similarity.h"
#include "saca/preview/expected_harm.h"
#include "saca/report/contact_sheet.h"

namespace saca::app {
namespace {

constexpr std::size_t num_neighbours = 5;
constexpr std::size_t num_parts = 3;  // of a difference that are told

/// "told AEB 0.120, NI 0.300": the best of all, braking and doing nothing.
std::string harms_text(std::string_view what, const std::optional<memory::PolicyHarms>& harms) {
  if (!harms) {
    return fmt::format("{}: not known", what);
  }
  std::vector<std::pair<double, std::string_view>> known;
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    if (const auto& harm = harms->at(manoeuvre::index(policy))) {
      known.emplace_back(*harm, name(policy));
    }
  }
  std::stable_sort(known.begin(), known.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  for (const auto& [harm, policy] : known) {
    text += fmt::format("{}{} {:.3f}", text.empty() ? "" : ", ", policy, harm);
  }
  return fmt::format("{}: {}", what, text);
}

report::SceneView case_view(const memory::Case& one, std::string title, std::string badge) {
  constexpr double shown = 2.0;  // [s]
  constexpr double step = 0.1;   // [s]
  world::Track ego{.start = one.scene.time, .step = step, .X_WA = {}};
  for (int k = 0; step * k <= shown; ++k) {
    ego.X_WA.push_back(world::ego_going_on(one.scene, step * k));
  }
  return {.title = std::move(title),
          .lines = {one.source, harms_text("told", one.told), harms_text("in truth", one.happened)},
          .badge = std::move(badge),
          .policy = one.best,
          .scene = one.scene,
          .ego = std::move(ego),
          .others = preview::all_going_on(one.scene).tracks,
          .contacts = {},
          .fan = {},
          .shown_P = std::nullopt};
}

}  // namespace

std::string case_picture(const memory::Case& one, std::span<const memory::Case> all) {
  memory::FeatureIndex index;
  std::vector<const memory::Case*> others;
  for (const memory::Case& other : all) {
    if (other.id != one.id) {
      others.push_back(&other);
      index.add(static_cast<memory::CaseId>(others.size()), other.scene);
    }
  }
  std::array<memory::FeatureIndex::Hit, num_neighbours> hits;
  const std::size_t found = index.nearest(memory::features(one.scene), hits);
  report::ContactSheet sheet{
      .heading = fmt::format("Case {}", one.id),
      .lines = {"The scene at the trigger and two seconds more, everybody going on as they do; the "
                "colour is that of the policy that was the best in truth.",
                fmt::format("Then the {} cases most like it, and in what they differ.", found)},
      .scenes = {case_view(
          one, fmt::format("Case {}", one.id),
          one.trust == memory::Trust::trusted ? "" : std::string(name(one.trust)))},
      .columns = 3,
      .thumbnail = {420.0, 300.0}};
  for (std::size_t i = 0; i < found; ++i) {
    const memory::Case& other = *others[hits.at(i).place];
    report::SceneView view =
        case_view(other, fmt::format("Case {}", other.id),
                  fmt::format("{:.0f} %", 100.0 * memory::similarity_at(hits.at(i).difference)));
    auto parts = memory::difference_parts(one.scene, other.scene);
    parts.resize(std::min(parts.size(), num_parts));
    std::string text;
    for (const memory::DifferencePart& part : parts) {
      text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", part.what, part.size);
    }
    view.lines.push_back(text.empty() ? "the same scene" : "differs: " + text);
    sheet.scenes.push_back(std::move(view));
  }
  return report::contact_sheet(sheet);
}

}  // namespace saca::app
