#include "saca/lab/suites/traffic_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "saca/lab/suites/traffic_text.h"

namespace saca::suites {
namespace {

using eval::ShadowReason;

constexpr std::size_t most_cards = 150;    // of a page: some 40 kB each
constexpr std::size_t most_left_out = 20;  // reasons told one by one

constexpr const char* rule_of_danger =
    "A trigger is danger if within 3 s the driver or who threatens brakes with 4 m/s^2 or more "
    "(over half a second), or the driver steers across the lane with 3 m/s^2 or more (over a "
    "second), or if, on the way that the driver took, at the speed that he had, only braking "
    "with 4 m/s^2 or more from the trigger on would have kept the bodies apart, or if a crash "
    "follows. Else it is false; so is one that errors of the recording set off: bodies that "
    "overlap, a threat whose track has only begun or is about to end.";

std::string needed_text(const std::optional<double>& deceleration) {
  return deceleration ? fmt::format("{:.1f}", *deceleration) : "more than 12";
}

/// A trigger, or SACA begins to act.
struct TriggerRow {
  const ShadowTrigger* trigger = nullptr;
  const ShadowIntervention* begun = nullptr;  ///< nullptr: a trigger alone
  const DriveToWatch* drive = nullptr;

  /// "T1 has come", "SACA begins AEB before T1".
  [[nodiscard]] std::string what() const {
    return begun == nullptr ? "T1 has come"
                            : "SACA begins " + begun->plan + (begun->early ? " before T1" : "");
  }
};

/// Those that count against SACA first, and of these its own actions.
std::vector<TriggerRow> triggers_of(const WatchedTraffic& traffic) {
  std::vector<TriggerRow> all;
  for (std::size_t k = 0; k < traffic.rows.size(); ++k) {
    for (const ShadowIntervention& begun : traffic.rows[k].watched.interventions) {
      all.push_back({&begun.trigger, &begun, &traffic.drives[k]});
    }
  }
  for (std::size_t k = 0; k < traffic.rows.size(); ++k) {
    for (const ShadowTrigger& trigger : traffic.rows[k].watched.triggers) {
      all.push_back({&trigger, nullptr, &traffic.drives[k]});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const TriggerRow& a, const TriggerRow& b) {
    const auto rank = [](const TriggerRow& one) {
      const ShadowReason reason = one.trigger->judgement.reason;
      const bool unsure =
          reason == ShadowReason::bodies_touch || reason == ShadowReason::track_ends;
      return std::pair(is_danger(reason), unsure);
    };
    return rank(a) < rank(b);
  });
  return all;
}

std::string judged_text(const ShadowTrigger& trigger) {
  const eval::ShadowJudgement& told = trigger.judgement;
  return fmt::format("{}: {}", is_danger(told.reason) ? "danger" : "false", meaning(told.reason));
}

std::string in_short(ShadowReason reason) {
  std::string words(name(reason));
  std::replace(words.begin(), words.end(), '_', ' ');
  return (is_danger(reason) ? "danger: " : "false: ") + words;
}

report::PageTable rates_table(const WatchedTraffic& traffic) {
  report::PageTable table{
      .heading = "Rates",
      .lines = {"95 % intervals, exact (Garwood) for events that come independently of each "
                "other. A trigger, or an action of SACA, that is not danger is false."},
      .columns = {"drives", "hours", "km", "previews", "previews per h", "triggers",
                  "triggers per h", "danger", "false", "false per h", "false per 1,000 km",
                  "SACA acts", "danger", "false", "false per h", "false per 1,000 km"},
      .rows = {}};
  const auto add = [&](const std::string& source, const ShadowFigures& one) {
    table.rows.push_back(
        {.name = source,
         .explanation = {},
         .cells = {std::to_string(one.drives), fmt::format("{:.3f}", one.hours),
                   fmt::format("{:.2f}", one.kilometres),
                   std::to_string(one.previews_per_hour.count), with_bounds(one.previews_per_hour),
                   std::to_string(one.triggers.per_hour.count), with_bounds(one.triggers.per_hour),
                   std::to_string(one.triggers.danger),
                   std::to_string(one.triggers.false_per_hour.count),
                   with_bounds(one.triggers.false_per_hour),
                   with_bounds(one.triggers.false_per_1000km),
                   std::to_string(one.interventions.per_hour.count),
                   std::to_string(one.interventions.danger),
                   std::to_string(one.interventions.false_per_hour.count),
                   with_bounds(one.interventions.false_per_hour),
                   with_bounds(one.interventions.false_per_1000km)},
         .shades = {}});
  };
  for (const std::string& source : sources_of(traffic)) {
    add(source, shadow_figures(traffic.rows, source));
  }
  add("all", shadow_figures(traffic.rows, ""));
  return table;
}

report::PageTable triggers_table(const std::vector<TriggerRow>& triggers) {
  report::PageTable table{.heading = "Every trigger, and every time that SACA acts",
                          .lines = {},
                          .columns = {"what", "at, s", "threat", "time to conflict, s", "ego, m/s",
                                      "judged", "driver braked, m/s^2", "other braked, m/s^2",
                                      "driver steered, m/s^2", "needed, m/s^2", "least gap, m"},
                          .rows = {}};
  for (const TriggerRow& one : triggers) {
    const ShadowTrigger& trigger = *one.trigger;
    const eval::ShadowJudgement& told = trigger.judgement;
    table.rows.push_back(
        {.name = one.drive->source + ": " + one.drive->name,
         .explanation = {},
         .cells = {one.what(), fmt::format("{:.2f}", trigger.time), trigger.who,
                   fmt::format("{:.2f}", trigger.time_to_conflict),
                   fmt::format("{:.1f}", trigger.speed), in_short(told.reason),
                   fmt::format("{:.1f}", told.driver_deceleration),
                   fmt::format("{:.1f}", told.other_deceleration),
                   fmt::format("{:.1f}", told.driver_lateral_acceleration),
                   needed_text(told.needed_deceleration), fmt::format("{:.2f}", told.least_gap)},
         .shades = {},
         .faded = is_danger(told.reason)});
  }
  return table;
}

std::optional<report::GalleryCard> card_of_trigger(const TriggerRow& one, const WatchTools& tools) {
  const auto ego = one.drive->open();
  if (!ego.has_value()) {
    return std::nullopt;
  }
  const ShadowTrigger& trigger = *one.trigger;
  const eval::ShadowJudgement& told = trigger.judgement;
  const ShadowPicture picture = shadow_picture(
      ego.value().scenario,
      {.car = tools.car, .intent = tools.intent, .thresholds = {}, .saca = nullptr}, trigger);
  report::GalleryCard card{
      .title = fmt::format("{}: {}, at {:.2f} s: {}; {}", one.drive->source, one.drive->name,
                           trigger.time, one.what(), judged_text(trigger)),
      .lines = {fmt::format(
          "{} would be met in {:.2f} s, at {:.1f} m/s. Then the driver braked with {:.1f} and "
          "steered with {:.1f} m/s^2, {} braked with {:.1f} m/s^2; {} m/s^2 was needed; the least "
          "gap was {:.2f} m.",
          trigger.who, trigger.time_to_conflict, trigger.speed, told.driver_deceleration,
          told.driver_lateral_acceleration, trigger.who, told.other_deceleration,
          needed_text(told.needed_deceleration), told.least_gap)},
      .done = {},
      .best = {},
      .command = one.drive->command};
  card.done.title = "As recorded, 3 s on";
  card.done.scene = picture.scene;
  card.done.ego = picture.ego;
  card.done.others = picture.others;
  card.best.title = "As the trigger supposed, until the conflict";
  card.best.scene = picture.scene;
  card.best.ego = picture.supposed_ego;
  card.best.others = picture.supposed_others;
  card.done.shown_P = report::scene_extent(card.done);  // both of one ground
  card.best.shown_P = card.done.shown_P;
  return card;
}

std::string rate_sentence(const WatchedTraffic& traffic) {
  const ShadowFigures all = shadow_figures(traffic.rows, "");
  return fmt::format(
      "SACA watched {:.2f} hours and {:.1f} km of recorded driving ({} drives) without taking the "
      "wheel. {} times a conflict came within T1: {} times there was danger by the rule below, {} "
      "times there was none; {} times it stood. It would have acted {} times, {} of them before "
      "T1; {} times there was danger, {} times there was none: {} false actions per 1,000 km, {} "
      "per hour.",
      all.hours, all.kilometres, all.drives, all.triggers.per_hour.count, all.triggers.danger,
      all.triggers.false_per_hour.count, all.triggers.at_rest, all.interventions.per_hour.count,
      all.early, all.interventions.danger, all.interventions.false_per_hour.count,
      with_bounds(all.interventions.false_per_1000km),
      with_bounds(all.interventions.false_per_hour));
}

/// How it was made, and what was not watched.
std::vector<std::string> footnotes_of_traffic(const WatchedTraffic& traffic,
                                              const nlohmann::json& figures) {
  std::vector<std::string> footnotes;
  for (const auto& [key, value] : figures.items()) {
    if (key.starts_with("meta.")) {
      footnotes.push_back(key.substr(5) + ": " + value.get<std::string>());
    }
  }
  footnotes.push_back(fmt::format("{} drives drawn of {}", traffic.rows.size(), traffic.found));
  footnotes.insert(footnotes.end(), traffic.notes.begin(), traffic.notes.end());
  std::map<std::string, int> reasons;
  for (const ShadowRow& row : traffic.rows) {
    if (!row.left_out.empty()) {
      ++reasons[row.source + ": " + row.left_out];
    }
  }
  for (const auto& [reason, times] : reasons) {
    if (footnotes.size() > most_left_out + traffic.notes.size()) {
      footnotes.push_back("and others");
      break;
    }
    footnotes.push_back(fmt::format("not watched: {} x {}", times, reason));
  }
  return footnotes;
}

}  // namespace

report::SuitePage traffic_page(const WatchedTraffic& traffic, const WatchTools& tools,
                               const nlohmann::json& figures) {
  const std::vector<TriggerRow> triggers = triggers_of(traffic);
  report::SuitePage page;
  page.title = "Normal driving, in shadow";
  page.lines = {rate_sentence(traffic), rule_of_danger};
  page.tables = {rates_table(traffic), triggers_table(triggers)};
  page.gallery_heading =
      triggers.size() > most_cards
          ? fmt::format("The first {} of {}, false ones first", most_cards, triggers.size())
          : "Each of them, false ones first";
  for (const TriggerRow& one : triggers) {
    if (page.gallery.size() == most_cards) {
      break;
    }
    if (auto card = card_of_trigger(one, tools)) {
      page.gallery.push_back(std::move(*card));
    }
  }
  page.footnotes = footnotes_of_traffic(traffic, figures);
  return page;
}

}  // namespace saca::suites
