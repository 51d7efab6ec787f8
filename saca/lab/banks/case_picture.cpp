#include "saca/lab/banks/case_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/lab/report/contact_sheet.h"
#include "saca/thinking/preview/expected_harm.h"

namespace saca::banks {
namespace {

/// "expected: AEB 0.120, NI 0.300": the least first.
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

}  // namespace

std::string title_of(const memory::Case& one) {
  return fmt::format("Case {}", one.id);
}

std::string trust_badge(const memory::Case& one) {
  return one.trust == memory::Trust::trusted ? "" : std::string(name(one.trust));
}

report::SceneView case_view(const memory::Case& one, std::string title, std::string badge) {
  constexpr double shown = 2.0;  // [s]
  constexpr double step = 0.1;   // [s]
  world::Track ego{.start = one.scene.time, .step = step, .X_WA = {}};
  for (int k = 0; step * k <= shown; ++k) {
    ego.X_WA.push_back(world::ego_going_on(one.scene, step * k));
  }
  return {.title = std::move(title),
          .lines = {one.source, harms_text("expected", one.told),
                    harms_text("in hindsight", one.happened)},
          .badge = std::move(badge),
          .policy = one.best,
          .scene = one.scene,
          .ego = std::move(ego),
          .others = preview::all_going_on(one.scene).tracks,
          .contacts = {},
          .fan = {},
          .shown_P = std::nullopt};
}

std::string case_picture(const memory::Case& one, std::span<const CaseNeighbour> neighbours) {
  report::ContactSheet sheet{
      .heading = title_of(one),
      .lines = {case_view_note,
                fmt::format("Then the {} cases most like it, and in what they differ.",
                            neighbours.size())},
      .scenes = {case_view(one, title_of(one), trust_badge(one))},
      .columns = 3,
      .thumbnail = {420.0, 300.0}};
  for (const CaseNeighbour& near : neighbours) {
    report::SceneView view =
        case_view(*near.one, title_of(*near.one), fmt::format("{:.0f} %", 100.0 * near.similarity));
    view.lines.push_back(near.differs);
    sheet.scenes.push_back(std::move(view));
  }
  return report::contact_sheet(sheet);
}

}  // namespace saca::banks
