#include "saca/lab/banks/case_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "saca/lab/banks/case_picture.h"
#include "saca/lab/report/suite_page.h"
#include "saca/thinking/memory/experience.h"

namespace saca::banks {
namespace {

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
  lines.emplace_back(case_view_note);
  return lines;
}

std::string made_with_text(const std::vector<memory::MadeWith>& things) {
  std::string text = "Made with";
  for (const memory::MadeWith& thing : things) {
    text += fmt::format("{} {} {}{}", &thing == things.data() ? "" : ",", thing.what, thing.name,
                        thing.digest.empty() ? "" : " (" + thing.digest + ")");
  }
  return text;
}

}  // namespace

std::string case_page(const memory::Case& one, std::span<const CaseNeighbour> neighbours,
                      const std::string& command) {
  report::SuitePage page{.title = title_of(one),
                         .lines = story_of(one),
                         .chart = std::nullopt,
                         .tables = {harms_table(one)},
                         .gallery_heading = "The cases most like it",
                         .gallery = {},
                         .footnotes = {command}};
  if (!one.made_with.empty()) {
    page.footnotes.push_back(made_with_text(one.made_with));
  }
  for (const CaseNeighbour& near : neighbours) {
    page.gallery.push_back(
        {.title = fmt::format("{}: {:.0f} % alike", title_of(*near.one), 100.0 * near.similarity),
         .lines = {near.differs},
         .done = case_view(one, title_of(one), trust_badge(one)),
         .best = case_view(*near.one, title_of(*near.one), trust_badge(*near.one)),
         .command = fmt::format("saca memory show {}", near.one->id)});
  }
  return report::suite_page(page);
}

}  // namespace saca::banks
