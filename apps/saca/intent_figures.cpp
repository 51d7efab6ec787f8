#include "apps/saca/intent_figures.h"

#include <fmt/core.h>

#include <array>
#include <string_view>
#include <utility>

#include "apps/saca/printing.h"
#include "saca/thinking/intent/intention.h"

namespace saca::app {
namespace {

using nlohmann::json;
using training::Figures;
using training::Interval;

json number(const std::optional<double>& value) {
  return value ? json(*value) : json();
}

json interval_json(const std::optional<Interval>& interval) {
  return interval
             ? json{{"value", interval->value}, {"low", interval->low}, {"high", interval->high}}
             : json();
}

json lead_times_json(const training::LeadTimes& lead_times) {
  return {{"events", lead_times.events()},
          {"share_warned", number(lead_times.share_predicted())},
          {"lower_quartile_s", number(lead_times.quantile(0.25))},
          {"median_s", number(lead_times.quantile(0.5))},
          {"upper_quartile_s", number(lead_times.quantile(0.75))}};
}

json events_json(const training::ManoeuvreEventsFound& found) {
  json all = json::object();
  for (std::size_t k = 1; k < training::num_vehicle_classes; ++k) {
    json recalls = json::array();
    for (std::size_t a = 0; a < training::ManoeuvreEventsFound::ages.size(); ++a) {
      const training::ManoeuvreEventsFound::Share& frames = found.of[k].frames[a];
      recalls.push_back({{"from_s", training::ManoeuvreEventsFound::ages[a]},
                         {"frames", frames.num},
                         {"recall", number(frames.share())}});
    }
    all[std::string(name(static_cast<intent::Intention>(k)))] = {
        {"acts", found.of[k].events.num},
        {"found", found.of[k].events.found},
        {"recall_by_age", recalls}};
  }
  return all;
}

std::string cell(const std::optional<double>& value, int digits = 3) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

constexpr std::array<std::string_view, training::num_foresights> foresight_names{
    "constant velocity", "lane keeping", "likeliest intention", "mean over intentions"};

}  // namespace

json row_json(const Row& row) {
  json heads = json::array();
  for (std::size_t head = 0; head < training::num_heads; ++head) {
    const training::Tally& tally = row.figures.tallies[head];
    json classes = json::object();
    for (std::size_t k = 0; k < training::num_vehicle_classes; ++k) {
      classes[std::string(name(static_cast<intent::Intention>(k)))] = {
          {"frames", tally.confusion.truly(k)},
          {"recall", number(tally.confusion.recall(k))},
          {"precision", number(tally.confusion.precision(k))},
          {"f1", number(tally.confusion.f1(k))}};
    }
    heads.push_back({{"ahead_s", intent::horizons[head]},
                     {"macro_f1", interval_json(row.figures.macro_f1[head])},
                     {"calibration_error", number(tally.top_calibration_error())},
                     {"classwise_calibration_error", number(tally.classwise_calibration_error())},
                     {"log_loss", number(tally.mean_log_loss())},
                     {"brier", number(tally.mean_brier())},
                     {"macro_f1_ours_less_this", interval_json(row.macro_f1_difference[head])},
                     {"log_loss_ours_less_this", interval_json(row.log_loss_difference[head])},
                     {"classes", classes},
                     {"confusion", tally.confusion.counts}});
  }
  return {{"method", row.method},
          {"heads", heads},
          {"warning_before_line", lead_times_json(row.figures.lane_changes)},
          {"warning_before_braking", lead_times_json(row.figures.brakings)},
          {"false_alarms_per_hour", number(row.figures.alarms.per_hour())},
          {"hours", row.figures.alarms.hours},
          {"acts", events_json(row.figures.events)},
          {"illegal_steps", row.figures.illegal_steps},
          {"ours_less_this", interval_json(row.macro_f1_difference[0])}};
}

void tell_table(const std::string& title, const std::vector<Row>& rows) {
  app::print("\n{}\n", title);
  app::print("{:24} {:>22} {:>8} {:>8} {:>7} {:>22} {:>12} {:>12} {:>8} {:>8}\n", "",
             "macro F1 now", "0.5 s", "1 s", "ECE", "log loss now, 0.5, 1 s", "line [s]",
             "brake [s]", "alarm/h", "illegal");
  for (const Row& row : rows) {
    const Figures& f = row.figures;
    const auto& now = f.macro_f1[0];
    const auto value = [&](std::size_t head) {
      return f.macro_f1[head] ? std::optional(f.macro_f1[head]->value) : std::nullopt;
    };
    app::print(
        "{:24} {:>22} {:>8} {:>8} {:>7} {:>22} {:>12} {:>12} {:>8} {:>8}\n", row.method,
        now ? fmt::format("{:.3f} [{:.3f}, {:.3f}]", now->value, now->low, now->high) : "-",
        cell(value(1)), cell(value(2)), cell(f.tallies[0].top_calibration_error()),
        cell(f.tallies[0].mean_log_loss()) + ", " + cell(f.tallies[1].mean_log_loss()) + ", " +
            cell(f.tallies[2].mean_log_loss()),
        cell(f.lane_changes.quantile(0.5), 1) + " of " + std::to_string(f.lane_changes.events()),
        cell(f.brakings.quantile(0.5), 1) + " of " + std::to_string(f.brakings.events()),
        cell(f.alarms.per_hour(), 0), f.illegal_steps);
  }
}

void tell_confusion(const Row& row) {
  for (std::size_t head = 0; head < training::num_heads; ++head) {
    const training::Confusion& confusion = row.figures.tallies[head].confusion;
    app::print("\n{}, {:.1f} s ahead: truth in rows, predicted in columns\n{:>8}", row.method,
               intent::horizons[head], "");
    for (std::size_t k = 0; k < training::num_vehicle_classes; ++k) {
      app::print("{:>8}", name(static_cast<intent::Intention>(k)));
    }
    app::print("{:>8} {:>9} {:>6}\n", "recall", "precision", "F1");
    for (std::size_t k = 0; k < training::num_vehicle_classes; ++k) {
      app::print("{:>8}", name(static_cast<intent::Intention>(k)));
      for (const std::size_t count : confusion.counts[k]) {
        app::print("{:>8}", count);
      }
      app::print("{:>8} {:>9} {:>6}\n", cell(confusion.recall(k), 2),
                 cell(confusion.precision(k), 2), cell(confusion.f1(k), 2));
    }
  }
}

void tell_difference(const Row& row) {
  for (std::size_t head = 0; head < training::num_heads; ++head) {
    const auto& f1 = row.macro_f1_difference[head];
    const auto& loss = row.log_loss_difference[head];
    if (f1 && loss) {
      app::print(
          "ours less {}, {:.1f} s ahead: macro F1 {:+.3f} [{:+.3f}, {:+.3f}], log loss {:+.4f} "
          "[{:+.4f}, {:+.4f}]\n",
          row.method, intent::horizons[head], f1->value, f1->low, f1->high, loss->value, loss->low,
          loss->high);
    }
  }
}

void tell_acts(const Row& row) {
  app::print("\n{}, now: acts found, and recall of their frames by the age of the act [s]\n{:8}",
             row.method, "");
  app::print("{:>16}", "acts found");
  for (const double age : training::ManoeuvreEventsFound::ages) {
    app::print("{:>8}", fmt::format("{:.1f}-", age));
  }
  app::print("\n");
  for (std::size_t k = 1; k < training::num_vehicle_classes; ++k) {
    const auto& found = row.figures.events.of[k];
    app::print("{:>8}{:>16}", name(static_cast<intent::Intention>(k)),
               fmt::format("{} of {}", found.events.found, found.events.num));
    for (const training::ManoeuvreEventsFound::Share& frames : found.frames) {
      app::print("{:>8}", cell(frames.share(), 2));
    }
    app::print("\n");
  }
}

void tell_displacements(const training::Displacements& found) {
  for (const auto& [title, table] :
       {std::pair("all vehicles in lanes", &found.all),
        std::pair("those that brake or change lanes", &found.acting)}) {
    app::print("\nMean displacement error [m] after 1, 2, 3 s: {} ({} frames)\n", title,
               (*table)[0][0].num);
    for (std::size_t f = 0; f < training::num_foresights; ++f) {
      app::print("{:24}", foresight_names[f]);
      for (const training::Displacement& each : (*table)[f]) {
        app::print(" {:8.2f}", each.mean());
      }
      app::print("\n");
    }
  }
}

json displacements_json(const training::Displacements& found) {
  json all = json::array();
  for (const auto& [which, table] :
       {std::pair("all", &found.all), std::pair("acting", &found.acting)}) {
    for (std::size_t f = 0; f < training::num_foresights; ++f) {
      for (std::size_t k = 0; k < training::seconds_ahead.size(); ++k) {
        const training::Displacement& one = (*table)[f][k];
        all.push_back({{"vehicles", which},
                       {"foresight", foresight_names[f]},
                       {"ahead_s", training::seconds_ahead[k]},
                       {"frames", one.num},
                       {"mean_m", one.mean()},
                       {"rms_m", one.rms()}});
      }
    }
  }
  return all;
}

}  // namespace saca::app
