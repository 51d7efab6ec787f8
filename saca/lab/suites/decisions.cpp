#include "saca/lab/suites/decisions.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "saca/lab/eval/methods.h"

namespace saca::suites {
namespace {

using encounter::ThinkingFigures;
using eval::MethodFigures;

int total_of(const std::map<std::string, int>& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0,
                         [](int sum, const auto& one) { return sum + one.second; });
}

/// One thing that is counted of what was thought.
struct ThoughtCount {
  const char* key;    ///< of the figure
  const char* words;  ///< for readers
  int ThinkingFigures::*count;
  int ThinkingFigures::*of;  ///< what its share is of
};

constexpr std::array<ThoughtCount, 10> thinking_counts{
    {{"forecasts", "forecasts for which a plan was sought", &ThinkingFigures::forecasts,
      &ThinkingFigures::forecasts},
     {"memory_hits", "of these, where memory is at least 70 % sure", &ThinkingFigures::recalled,
      &ThinkingFigures::forecasts},
     {"plans_from_memory", "of these, with a plan from memory", &ThinkingFigures::from_memory,
      &ThinkingFigures::forecasts},
     {"plans_from_model", "of these, with a plan from the model", &ThinkingFigures::from_model,
      &ThinkingFigures::forecasts},
     {"model_asked", "of these, the model was asked about", &ThinkingFigures::asked,
      &ThinkingFigures::forecasts},
     {"model_answered", "of those asked about, answered in time", &ThinkingFigures::answered,
      &ThinkingFigures::asked},
     {"model_ended", "of those answered, with a reply that came to its end",
      &ThinkingFigures::ended, &ThinkingFigures::answered},
     {"model_unfounded", "of those answered, with a choice that rests on something false",
      &ThinkingFigures::unfounded, &ThinkingFigures::answered},
     {"statements", "statements of replies that can be checked", &ThinkingFigures::statements,
      &ThinkingFigures::statements},
     {"statements_false", "of these, false", &ThinkingFigures::false_statements,
      &ThinkingFigures::statements}}};

}  // namespace

report::PageTable decisions_table(const MethodFigures& figures) {
  report::PageTable table{.heading = "Where the decisions of " +
                                     std::string(eval::find_method(figures.method)->title) +
                                     " came from",
                          .lines = {},
                          .columns = {"times", "share, %"},
                          .rows = {}};
  const auto add = [&](const std::string& name, int times, int of) {
    table.rows.push_back(
        {.name = name,
         .explanation = {},
         .cells = {std::to_string(times), fmt::format("{:.1f}", 100.0 * times / std::max(1, of))},
         .shades = {}});
  };
  const int all = total_of(figures.sources);
  for (const auto& [source, times] : figures.sources) {
    add("source: " + (source.empty() ? std::string("its rule") : source), times, all);
  }
  for (const auto& [reason, times] : figures.reasons) {
    if (!reason.empty()) {
      add("reason: " + reason, times, all);
    }
  }
  if (figures.thinking) {
    for (const ThoughtCount& one : thinking_counts) {
      if ((*figures.thinking).*one.of > 0) {
        add(one.words, (*figures.thinking).*one.count, (*figures.thinking).*one.of);
      }
    }
  }
  return table;
}

void add_decisions(nlohmann::json& out, const std::string& place, const MethodFigures& figures) {
  for (const auto& [source, times] : figures.sources) {
    out[place + "source." + (source.empty() ? "none" : source)] = times;
  }
  for (const auto& [reason, times] : figures.reasons) {
    if (!reason.empty()) {
      out[fmt::format("{}reason.{}", place, reason)] = times;
    }
  }
  if (!figures.thinking) {
    return;
  }
  const auto times = [&](const char* source) {
    const auto found = figures.sources.find(source);
    return found == figures.sources.end() ? 0 : found->second;
  };
  if (const int decided = total_of(figures.sources); decided > 0) {
    out[place + "cache_hit_rate"] = static_cast<double>(times("memory") + times("model")) / decided;
  }
  const ThinkingFigures& thinking = *figures.thinking;
  for (const ThoughtCount& one : thinking_counts) {
    out[place + one.key] = thinking.*one.count;
  }
  if (thinking.forecasts > 0) {
    out[place + "memory_hit_rate"] = static_cast<double>(thinking.recalled) / thinking.forecasts;
  }
}

std::string expectations_text(const MethodFigures& figures) {
  if (!figures.expected) {
    return "";
  }
  const eval::ExpectedFigures& one = *figures.expected;
  return fmt::format(
      "At T1 the verdict expected {:.4f} harm of what was decided on, and {:.4f} of full braking; "
      "tried with full knowledge they harm {:.4f} and {:.4f} ({} decisions). {:.1f} % were "
      "knowingly worse than braking. In {:.1f} % of all decisions by a verdict more than one plan "
      "was admissible; plans were switched {:.2f} times in an encounter.",
      one.expected.value, one.braking_expected.value, one.happened.value,
      one.braking_happened.value, one.expected.n, 100.0 * one.knowingly_worse.value,
      100.0 * one.several.value, figures.switches.value);
}

std::string decisions_text(const MethodFigures& figures) {
  std::string text = fmt::format("{}: {} decisions", figures.method, total_of(figures.sources));
  const char* before = ": ";
  for (const auto& [source, times] : figures.sources) {
    text += fmt::format("{}{} from {}", before, times, source.empty() ? "its rule" : source);
    before = ", ";
  }
  for (const auto& [reason, times] : figures.reasons) {
    text += reason.empty() ? "" : fmt::format("; {}: {}", reason, times);
  }
  if (figures.thinking) {
    const ThinkingFigures& thinking = *figures.thinking;
    text += fmt::format(
        "; of {} forecasts memory knew {}, the model answered {} of the {} that it was asked about",
        thinking.forecasts, thinking.recalled, thinking.answered, thinking.asked);
  }
  return text;
}

}  // namespace saca::suites
