#include "saca/lab/intention_study/evaluation_text.h"

#include <fmt/core.h>

#include <array>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "saca/lab/intention_study/foresight_names.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_study {
namespace {

using intention_scoring::Figures;
using Text = std::back_insert_iterator<std::string>;

std::string cell(const std::optional<double>& value, int digits = 3) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

void add_table(Text text, const Comparison& comparison) {
  fmt::format_to(text, "\n{}\n", comparison.title);
  fmt::format_to(text, "{:24} {:>22} {:>8} {:>8} {:>7} {:>22} {:>12} {:>12} {:>8} {:>8}\n", "",
                 "macro F1 now", "0.5 s", "1 s", "ECE", "log loss now, 0.5, 1 s", "line [s]",
                 "brake [s]", "alarm/h", "illegal");
  for (const MethodFigures& row : comparison.methods) {
    const Figures& f = row.figures;
    const auto& now = f.macro_f1[0];
    const auto value = [&](std::size_t head) {
      return f.macro_f1[head] ? std::optional(f.macro_f1[head]->value) : std::nullopt;
    };
    fmt::format_to(
        text, "{:24} {:>22} {:>8} {:>8} {:>7} {:>22} {:>12} {:>12} {:>8} {:>8}\n", row.method,
        now ? fmt::format("{:.3f} [{:.3f}, {:.3f}]", now->value, now->low, now->high) : "-",
        cell(value(1)), cell(value(2)), cell(f.tallies[0].top_calibration_error()),
        cell(f.tallies[0].mean_log_loss()) + ", " + cell(f.tallies[1].mean_log_loss()) + ", " +
            cell(f.tallies[2].mean_log_loss()),
        cell(f.lane_changes.quantile(0.5), 1) + " of " + std::to_string(f.lane_changes.events()),
        cell(f.brakings.quantile(0.5), 1) + " of " + std::to_string(f.brakings.events()),
        cell(f.alarms.per_hour(), 0), f.illegal_steps);
  }
}

void add_confusion(Text text, const MethodFigures& row) {
  for (std::size_t head = 0; head < intention_scoring::num_heads; ++head) {
    const intention_scoring::Confusion& confusion = row.figures.tallies[head].confusion;
    fmt::format_to(text, "\n{}, {:.1f} s ahead: truth in rows, predicted in columns\n{:>8}",
                   row.method, intent::horizons[head], "");
    for (std::size_t k = 0; k < intention_scoring::num_vehicle_classes; ++k) {
      fmt::format_to(text, "{:>8}", name(static_cast<intent::Intention>(k)));
    }
    fmt::format_to(text, "{:>8} {:>9} {:>6}\n", "recall", "precision", "F1");
    for (std::size_t k = 0; k < intention_scoring::num_vehicle_classes; ++k) {
      fmt::format_to(text, "{:>8}", name(static_cast<intent::Intention>(k)));
      for (const std::size_t count : confusion.counts[k]) {
        fmt::format_to(text, "{:>8}", count);
      }
      fmt::format_to(text, "{:>8} {:>9} {:>6}\n", cell(confusion.recall(k), 2),
                     cell(confusion.precision(k), 2), cell(confusion.f1(k), 2));
    }
  }
}

void add_difference(Text text, const MethodFigures& row) {
  for (std::size_t head = 0; head < intention_scoring::num_heads; ++head) {
    const auto& f1 = row.macro_f1_difference[head];
    const auto& loss = row.log_loss_difference[head];
    if (f1 && loss) {
      fmt::format_to(
          text,
          "ours less {}, {:.1f} s ahead: macro F1 {:+.3f} [{:+.3f}, {:+.3f}], log loss {:+.4f} "
          "[{:+.4f}, {:+.4f}]\n",
          row.method, intent::horizons[head], f1->value, f1->low, f1->high, loss->value, loss->low,
          loss->high);
    }
  }
}

void add_acts(Text text, const MethodFigures& row) {
  fmt::format_to(
      text, "\n{}, now: acts found, and recall of their frames by the age of the act [s]\n{:8}",
      row.method, "");
  fmt::format_to(text, "{:>16}", "acts found");
  for (const double age : intention_scoring::ManoeuvreEventsFound::ages) {
    fmt::format_to(text, "{:>8}", fmt::format("{:.1f}-", age));
  }
  fmt::format_to(text, "\n");
  for (std::size_t k = 1; k < intention_scoring::num_vehicle_classes; ++k) {
    const auto& found = row.figures.events.of[k];
    fmt::format_to(text, "{:>8}{:>16}", name(static_cast<intent::Intention>(k)),
                   fmt::format("{} of {}", found.events.found, found.events.num));
    for (const intention_scoring::ManoeuvreEventsFound::Share& frames : found.frames) {
      fmt::format_to(text, "{:>8}", cell(frames.share(), 2));
    }
    fmt::format_to(text, "\n");
  }
}

void add_displacements(Text text, const intention_scoring::Displacements& found) {
  for (const auto& [title, table] :
       {std::pair("all vehicles in lanes", &found.all),
        std::pair("those that brake or change lanes", &found.acting)}) {
    fmt::format_to(text, "\nMean displacement error [m] after 1, 2, 3 s: {} ({} frames)\n", title,
                   (*table)[0][0].num);
    for (std::size_t f = 0; f < intention_scoring::num_foresights; ++f) {
      fmt::format_to(text, "{:24}", foresight_names[f]);
      for (const intention_scoring::Displacement& each : (*table)[f]) {
        fmt::format_to(text, " {:8.2f}", each.mean());
      }
      fmt::format_to(text, "\n");
    }
  }
}

}  // namespace

std::string evaluation_text(const Evaluation& evaluation) {
  std::string all;
  const auto text = std::back_inserter(all);
  for (const Comparison& each : evaluation.comparisons) {
    add_table(text, each);
    add_confusion(text, each.methods.front());
    add_acts(text, each.methods.front());
    for (const MethodFigures& method : each.methods) {
      add_difference(text, method);
    }
  }
  add_displacements(text, evaluation.displacements);
  return all;
}

}  // namespace saca::intention_study
