#include "apps/saca/memory_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/lab/report/contact_sheet.h"
#include "saca/lab/report/suite_page.h"
#include "saca/onboard/match/feature_index.h"
#include "saca/onboard/match/similarity.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/preview/expected_harm.h"

namespace saca::app {
namespace {

constexpr std::size_t num_neighbours = 5;
constexpr std::size_t num_parts = 3;  // of a difference that are told

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

/// One of those most like a case.
struct Neighbour {
  const memory::Case* one = nullptr;
  double similarity = 0.0;
  std::string differs;  ///< in what, the largest first
};

std::vector<Neighbour> neighbours_of(const memory::Case& one, std::span<const memory::Case> all) {
  match::FeatureIndex index;
  std::vector<const memory::Case*> others;
  for (const memory::Case& other : all) {
    if (other.id != one.id) {
      others.push_back(&other);
      index.add(static_cast<match::CaseId>(others.size()), other.scene);
    }
  }
  std::array<match::FeatureIndex::Hit, num_neighbours> hits;
  const std::size_t found = index.nearest(match::features(one.scene), hits);
  std::vector<Neighbour> neighbours;
  neighbours.reserve(found);
  for (const match::FeatureIndex::Hit& hit : std::span(hits).first(found)) {
    const memory::Case& other = *others[hit.place];
    auto parts = match::difference_parts(one.scene, other.scene);
    parts.resize(std::min(parts.size(), num_parts));
    std::string text;
    for (const match::DifferencePart& part : parts) {
      text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", part.what, part.size);
    }
    neighbours.push_back({.one = &other,
                          .similarity = match::similarity_at(hit.difference),
                          .differs = text.empty() ? "the same scene" : "differs: " + text});
  }
  return neighbours;
}

std::string title_of(const memory::Case& one) {
  return fmt::format("Case {}", one.id);
}

/// "trusted" is nothing to tell.
std::string trust_badge(const memory::Case& one) {
  return one.trust == memory::Trust::trusted ? "" : std::string(name(one.trust));
}

constexpr const char* what_is_drawn =
    "The scene at the trigger and two seconds more, everybody going on as they do; the colour is "
    "that of the policy that was the best in hindsight.";

/// What every policy was expected to harm and did; the worse, the deeper the shade.
report::PageTable harms_table(const memory::Case& one) {
  report::PageTable table{
      .heading = "Harm of each policy",
      .lines = {fmt::format("Of its plan that harms least; in hindsight the mean over {} draw{} "
                            "of what is left to chance.",
                            one.draws, one.draws == 1 ? "" : "s")},
      .columns = {"expected at the trigger", "in hindsight", ""},
      .rows = {}};
  const auto good = memory::as_good_as_best(one);
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const std::size_t i = manoeuvre::index(policy);
    report::PageTable::Row row{.name = std::string(name(policy)), .explanation = ""};
    for (const auto& harms : {one.told, one.happened}) {
      const auto harm = harms ? harms->at(i) : std::nullopt;
      row.cells.push_back(!harms ? "not known"
                          : harm ? fmt::format("{:.3f}", *harm)
                                 : "cannot be driven");
      row.shades.push_back(harm ? std::optional(std::clamp(*harm, 0.0, 1.0)) : std::nullopt);
    }
    row.cells.push_back(good.test(i) ? "the case speaks for it" : "");
    row.shades.emplace_back();
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<std::string> story_of(const memory::Case& one) {
  std::vector<std::string> lines{
      fmt::format("{}. Carried out: {}; best in hindsight: {}. Harm {:.3f}, of the best {:.3f}.",
                  one.source.empty() ? "Its source is not known" : one.source,
                  name(one.plan.policy), name(one.best), one.harm, one.best_harm),
      fmt::format("From: {}. Trust: {}. It stands for {} encounter{}{}.", name(one.origin),
                  name(one.trust), one.count, one.count == 1 ? "" : "s",
                  one.worst_harm
                      ? fmt::format(", the worst of which harmed {:.3f}", *one.worst_harm)
                      : "")};
  if (!one.review.empty()) {
    lines.push_back("Review: " + one.review);
  }
  for (const std::string& lesson : one.lessons) {
    lines.push_back("Lesson, checked: " + lesson);
  }
  lines.emplace_back(what_is_drawn);
  return lines;
}

}  // namespace

std::string case_picture(const memory::Case& one, std::span<const memory::Case> all) {
  const std::vector<Neighbour> neighbours = neighbours_of(one, all);
  report::ContactSheet sheet{
      .heading = title_of(one),
      .lines = {what_is_drawn,
                fmt::format("Then the {} cases most like it, and in what they differ.",
                            neighbours.size())},
      .scenes = {case_view(one, title_of(one), trust_badge(one))},
      .columns = 3,
      .thumbnail = {420.0, 300.0}};
  for (const Neighbour& near : neighbours) {
    report::SceneView view =
        case_view(*near.one, title_of(*near.one), fmt::format("{:.0f} %", 100.0 * near.similarity));
    view.lines.push_back(near.differs);
    sheet.scenes.push_back(std::move(view));
  }
  return report::contact_sheet(sheet);
}

std::string case_page(const memory::Case& one, std::span<const memory::Case> all,
                      const std::string& command) {
  report::SuitePage page{.title = title_of(one),
                         .lines = story_of(one),
                         .chart = std::nullopt,
                         .tables = {harms_table(one)},
                         .gallery_heading = "The cases most like it",
                         .gallery = {},
                         .footnotes = {command}};
  if (!one.made_with.empty()) {
    std::string made_with = "Made with";
    for (const memory::MadeWith& thing : one.made_with) {
      made_with += fmt::format("{} {} {}{}", &thing == one.made_with.data() ? "" : ",", thing.what,
                               thing.name, thing.digest.empty() ? "" : " (" + thing.digest + ")");
    }
    page.footnotes.push_back(made_with);
  }
  for (const Neighbour& near : neighbours_of(one, all)) {
    page.gallery.push_back(
        {.title = fmt::format("{}: {:.0f} % alike", title_of(*near.one), 100.0 * near.similarity),
         .lines = {near.differs},
         .done = case_view(one, title_of(one), trust_badge(one)),
         .best = case_view(*near.one, title_of(*near.one), trust_badge(*near.one)),
         .command = fmt::format("saca memory show {}", near.one->id)});
  }
  return report::suite_page(page);
}

}  // namespace saca::app
