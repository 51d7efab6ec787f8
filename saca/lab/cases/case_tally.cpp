#include "saca/lab/cases/case_tally.h"

#include <fmt/core.h>

#include <string_view>

namespace saca::cases {

using nlohmann::json;

namespace {

/// Of all crashes, in [0, 1]; 0 where there is none.
double share_of(const FamilyTally& tally, const CaseSources& sources) {
  const auto crashes = static_cast<double>(sources.release.crashes.size());
  return crashes == 0.0 ? 0.0 : tally.count.crashes / crashes;
}

void add_family(json& out, const std::string& key, const FamilyTally& tally) {
  out[key + "num_crashes"] = tally.count.crashes;
  out[key + "ego_is_no_car"] = tally.count.ego_is_no_car;
  out[key + "other_unknown"] = tally.count.other_unknown;
  out[key + "not_playable"] = tally.count.not_playable;
  out[key + "worked_on"] = tally.worked_on;
  for (std::size_t i = 0; i < tally.ends.size(); ++i) {
    out[key + std::string(name(static_cast<CrashEnd>(i)))] = tally.ends.at(i);
  }
  out[key + "happens_at_once"] = tally.at_once;
  out[key + "num_cases"] = tally.cases;
  out[key + "impact_known"] = tally.impact_known;
  out[key + "impact_agrees"] = tally.impact_agrees;
}

}  // namespace

FamilyTallies family_tallies(const CaseSources& sources, const std::vector<CaseRow>& rows) {
  FamilyTallies tallies;
  for (std::size_t i = 0; i < sources.counts.size(); ++i) {
    const auto family = static_cast<crash_records::CrashFamily>(i);
    tallies[std::string(name(family))].count = sources.counts.at(i);
  }
  for (const CaseRow& row : rows) {
    FamilyTally& tally = tallies[row.family];
    ++tally.worked_on;
    ++tally.ends.at(static_cast<std::size_t>(row.end));
    if (row.made) {
      ++tally.cases;
      tally.at_once += row.end == CrashEnd::happens && row.made->sample == 0 ? 1 : 0;
      tally.impact_known += row.made->impact_agrees ? 1 : 0;
      tally.impact_agrees += row.made->impact_agrees.value_or(false) ? 1 : 0;
    }
  }
  return tallies;
}

json tally_json(const CaseSources& sources, const FamilyTallies& tallies, const CaseSet& set) {
  json out{{"cases.num_crashes", sources.release.crashes.size()},
           {"cases.num_events", sources.events.size()},
           {"cases.num_cases", set.cases.size()},
           {"cases.num_failed", set.problems.size()}};
  for (const auto& [family, tally] : tallies) {
    const std::string key = "cases." + family + ".";
    add_family(out, key, tally);
    out[key + "share"] = share_of(tally, sources);
  }
  std::map<std::string_view, int> best;
  for (const CrashCase& one : set.cases) {
    ++best[name(one.judged.one.best)];
  }
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    out[fmt::format("cases.best.{}", name(policy))] = best[name(policy)];
  }
  return out;
}

std::string tally_text(const CaseSources& sources, const FamilyTallies& tallies, const CaseSet& set,
                       const std::string& output) {
  std::string text;
  for (const std::string& note : sources.release.notes) {
    text += fmt::format("note: {}\n", note);
  }
  text += fmt::format("{:<12} {:>8} {:>6} {:>10} {:>9} {:>8} {:>6}\n", "family", "crashes", "share",
                      "worked on", "happens", "at once", "cases");
  for (const auto& [family, tally] : tallies) {
    text += fmt::format("{:<12} {:>8} {:>5.1f}% {:>10} {:>9} {:>8} {:>6}\n", family,
                        tally.count.crashes, 100.0 * share_of(tally, sources), tally.worked_on,
                        tally.ends.at(static_cast<std::size_t>(CrashEnd::happens)), tally.at_once,
                        tally.cases);
  }
  return text + fmt::format("{}: {} cases of {} crashes and {} events\n", output, set.cases.size(),
                            sources.release.crashes.size(), sources.events.size());
}

}  // namespace saca::cases
