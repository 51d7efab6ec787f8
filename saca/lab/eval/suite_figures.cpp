#include "saca/lab/eval/suite_figures.h"

#include <algorithm>
#include <iterator>
#include <random>

#include "saca/base/core/contract.h"
#include "saca/base/core/percentile.h"
#include "saca/lab/scenario/chance.h"
#include "saca/onboard/collision/ordering.h"

namespace saca::eval {
namespace {

using manoeuvre::PolicyId;

/// Which encounters each bootstrap sample holds, and how often.
class Bootstrap {
 public:
  Bootstrap(std::size_t count, std::uint64_t seed) : count_(count) {
    constexpr std::size_t num_samples = 1'000;
    std::mt19937_64 rng = scenario::generator(seed, count);
    std::uniform_int_distribution<std::uint32_t> any(0, static_cast<std::uint32_t>(count - 1));
    drawn_.resize(num_samples * count);
    for (std::uint32_t& each : drawn_) {
      each = any(rng);
    }
  }

  /// Mean of `values` over the encounters that have one.
  [[nodiscard]] Estimate mean(const std::vector<std::optional<double>>& values) const;

 private:
  std::size_t count_;
  std::vector<std::uint32_t> drawn_;  ///< one row of encounters for each sample
};

Estimate Bootstrap::mean(const std::vector<std::optional<double>>& values) const {
  expects(values.size() == count_, "one value for each encounter");
  std::vector<double> value(count_);
  std::vector<double> there(count_);
  double sum = 0.0;
  double n = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    value[i] = values[i].value_or(0.0);
    there[i] = values[i] ? 1.0 : 0.0;
    sum += value[i];
    n += there[i];
  }
  if (n == 0.0) {
    return {};
  }
  std::vector<double> means;
  for (auto row = drawn_.begin(); row != drawn_.end(); row += static_cast<std::ptrdiff_t>(count_)) {
    double sample_sum = 0.0;
    double sample_n = 0.0;
    for (auto i = row; i != row + static_cast<std::ptrdiff_t>(count_); ++i) {
      sample_sum += value[*i];
      sample_n += there[*i];
    }
    if (sample_n > 0.0) {
      means.push_back(sample_sum / sample_n);
    }
  }
  return {.value = sum / n,
          .low = percentile(means, 0.025),
          .high = percentile(means, 0.975),
          .n = static_cast<int>(n)};
}

/// What of a row a figure is the mean of; nullopt: the row does not count for it.
using Measure = std::optional<double> (*)(const SuiteRow& row, std::size_t method,
                                          std::optional<std::size_t> aeb);

const MethodRun& run_of(const SuiteRow& row, std::size_t method) {
  return row.risk.runs[method];
}

std::optional<double> over_aeb(const SuiteRow& row, std::size_t method,
                               std::optional<std::size_t> aeb) {
  return aeb ? std::optional(run_of(row, method).harm - run_of(row, *aeb).harm) : std::nullopt;
}

/// Nobody is harmed if nothing is done.
bool is_quiet(const Comparison& comparison) {
  return std::any_of(comparison.tried.begin(), comparison.tried.end(), [](const TriedPlan& tried) {
    return tried.plan.policy == PolicyId::no_intervention && tried.harm &&
           collision::harm_class(*tried.harm) == 0.0;
  });
}

std::optional<double> flag(bool holds) {
  return holds ? 1.0 : 0.0;
}

void add(std::optional<encounter::ThinkingFigures>& sum, const encounter::ThinkingFigures& one) {
  encounter::ThinkingFigures& all = sum ? *sum : sum.emplace();
  for (const auto part :
       {&encounter::ThinkingFigures::forecasts, &encounter::ThinkingFigures::recalled,
        &encounter::ThinkingFigures::from_memory, &encounter::ThinkingFigures::from_model,
        &encounter::ThinkingFigures::asked, &encounter::ThinkingFigures::answered,
        &encounter::ThinkingFigures::ended, &encounter::ThinkingFigures::statements,
        &encounter::ThinkingFigures::false_statements, &encounter::ThinkingFigures::unfounded}) {
    all.*part += one.*part;
  }
}

/// What was expected at the decision, where that was made at T1.
const encounter::ExpectedAtDecision* expected_at_trigger(const SuiteRow& row, std::size_t method) {
  constexpr double same_instant = 0.005;  // [s]: half a look
  const auto& thinking = run_of(row, method).thinking;
  const bool counts = thinking && thinking->expected && row.risk.trigger &&
                      std::abs(thinking->expected->time - *row.risk.trigger) < same_instant;
  return counts ? &*thinking->expected : nullptr;
}

/// Whether there was more than one plan to choose from.
std::optional<double> had_several(const SuiteRow& row, std::size_t method,
                                  std::optional<std::size_t> /*aeb*/) {
  const auto& thinking = run_of(row, method).thinking;
  return thinking && thinking->expected ? flag(thinking->expected->num_admissible > 1)
                                        : std::nullopt;
}

/// One of its figures, where it counts.
template <double encounter::ExpectedAtDecision::*harm>
std::optional<double> expectation(const SuiteRow& row, std::size_t method,
                                  std::optional<std::size_t> /*aeb*/) {
  const auto* const told = expected_at_trigger(row, method);
  return told != nullptr ? std::optional(told->*harm) : std::nullopt;
}

/// What happens to a plan with full knowledge: the tried one of its policy that is most like it.
std::optional<double> happened(const Comparison& comparison, const manoeuvre::Plan& plan) {
  const TriedPlan* const tried = manoeuvre::most_like<TriedPlan>(comparison.tried, plan);
  return tried == nullptr ? std::nullopt : tried->harm;
}

using RowRef = const SuiteRow&;
using Aeb = std::optional<std::size_t>;

/// One method's rows, of which means are taken.
struct MethodRows {
  std::span<const SuiteRow* const> rows;
  std::size_t method;
  Aeb aeb;
  const Bootstrap& bootstrap;

  [[nodiscard]] Estimate mean(Measure measure) const {
    std::vector<std::optional<double>> values;
    for (const SuiteRow* const row : rows) {
      values.push_back(measure(*row, method, aeb));
    }
    return bootstrap.mean(values);
  }
};

void fill_harms(const MethodRows& of, MethodFigures& figures) {
  figures.harm =
      of.mean([](RowRef row, std::size_t m, Aeb) { return std::optional(run_of(row, m).harm); });
  figures.regret = of.mean([](RowRef row, std::size_t m, Aeb) {
    return std::optional(run_of(row, m).harm - row.risk.best_harm);
  });
  figures.published_regret = of.mean([](RowRef row, std::size_t m, Aeb) {
    return std::optional(run_of(row, m).harm - row.risk.published_best_harm);
  });
  figures.over_aeb = of.mean(over_aeb);
  figures.collision_loss = of.mean(
      [](RowRef row, std::size_t m, Aeb) { return std::optional(run_of(row, m).collision_loss); });
}

void fill_decisions(const MethodRows& of, MethodFigures& figures) {
  figures.contact =
      of.mean([](RowRef row, std::size_t m, Aeb) { return flag(run_of(row, m).met.has_value()); });
  figures.right = of.mean([](RowRef row, std::size_t m, Aeb) {
    return flag(collision::harm_class(run_of(row, m).harm) <=
                collision::harm_class(row.risk.best_harm));
  });
  figures.worse_than_aeb = of.mean([](RowRef row, std::size_t m, Aeb reference) {
    const auto more = over_aeb(row, m, reference);
    return more ? flag(*more > material) : std::nullopt;
  });
  figures.needless = of.mean([](RowRef row, std::size_t m, Aeb) {
    return is_quiet(row.risk) ? flag(run_of(row, m).intervened()) : std::nullopt;
  });
  figures.switches = of.mean([](RowRef row, std::size_t m, Aeb) {
    return std::optional(static_cast<double>(run_of(row, m).switches));
  });
}

/// nullopt: nothing was decided by verdicts.
std::optional<ExpectedFigures> expected_figures(const MethodRows& of) {
  const bool decides = std::any_of(of.rows.begin(), of.rows.end(), [&](const SuiteRow* row) {
    return expected_at_trigger(*row, of.method) != nullptr;
  });
  if (!decides) {
    return std::nullopt;
  }
  ExpectedFigures figures;
  figures.expected = of.mean(expectation<&encounter::ExpectedAtDecision::harm>);
  figures.happened = of.mean([](RowRef row, std::size_t m, Aeb) {
    const auto* const told = expected_at_trigger(row, m);
    return told != nullptr ? happened(row.risk, told->plan) : std::nullopt;
  });
  figures.braking_expected = of.mean(expectation<&encounter::ExpectedAtDecision::braking_harm>);
  figures.braking_happened = of.mean([](RowRef row, std::size_t m, Aeb) {
    return expected_at_trigger(row, m) != nullptr ? happened(row.risk, manoeuvre::full_braking)
                                                  : std::nullopt;
  });
  figures.knowingly_worse = of.mean([](RowRef row, std::size_t m, Aeb) {
    const auto* const told = expected_at_trigger(row, m);
    return told != nullptr ? flag(told->harm > told->braking_harm + material) : std::nullopt;
  });
  figures.several = of.mean(had_several);
  return figures;
}

/// nullopt: no encounter has a twin.
std::optional<TwinFigures> twin_figures(const MethodRows& of) {
  const bool twins = std::any_of(of.rows.begin(), of.rows.end(),
                                 [](const SuiteRow* row) { return row->twin.has_value(); });
  if (!twins) {
    return std::nullopt;
  }
  TwinFigures figures;
  figures.false_trigger_loss = of.mean([](RowRef row, std::size_t m, Aeb) {
    return row.twin ? std::optional(false_trigger_loss(row.twin->runs[m])) : std::nullopt;
  });
  figures.false_triggers = of.mean([](RowRef row, std::size_t m, Aeb) {
    return row.twin ? flag(row.twin->runs[m].intervened()) : std::nullopt;
  });
  figures.harm = of.mean([](RowRef row, std::size_t m, Aeb) {
    return row.twin ? std::optional(row.twin->runs[m].harm) : std::nullopt;
  });
  return figures;
}

void count_decisions(const MethodRows& of, MethodFigures& figures) {
  for (const SuiteRow* const row : of.rows) {
    const MethodRun& run = run_of(*row, of.method);
    if (run.plan) {
      ++figures.sources[run.source];
      ++figures.reasons[run.reason];
    }
    if (run.thinking) {
      add(figures.thinking, *run.thinking);
    }
  }
}

/// Whether a method failed in an encounter or its twin.
bool threw(const SuiteRow& row, std::size_t method) {
  return row.fault.empty() && (!row.risk.runs[method].fault.empty() ||
                               (row.twin && !row.twin->runs[method].fault.empty()));
}

MethodFigures figures_of(const MethodRows& of, const std::string& name) {
  MethodFigures figures{.method = name};
  fill_harms(of, figures);
  fill_decisions(of, figures);
  figures.expected = expected_figures(of);
  figures.twins = twin_figures(of);
  count_decisions(of, figures);
  return figures;
}

}  // namespace

double false_trigger_loss(const MethodRun& run) {
  if (!run.intervened()) {
    return 0.0;
  }
  return run.plan && manoeuvre::drifts(run.plan->policy) ? 1.0 : 0.5;
}

std::vector<MethodFigures> suite_figures(std::span<const SuiteRow* const> rows,
                                         const std::vector<std::string>& methods,
                                         std::optional<std::size_t> aeb, std::uint64_t seed) {
  std::vector<const SuiteRow*> good;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(good),
               [](const SuiteRow* row) { return counts_in_figures(*row); });
  std::vector<MethodFigures> all;
  if (good.empty()) {
    return all;
  }
  const Bootstrap bootstrap(good.size(), seed);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    all.push_back(figures_of({good, m, aeb, bootstrap}, methods[m]));
    all.back().faults = static_cast<int>(std::count_if(
        rows.begin(), rows.end(), [&](const SuiteRow* row) { return threw(*row, m); }));
  }
  return all;
}

Estimate harm_above(std::span<const SuiteRow> rows, std::size_t method, std::size_t other,
                    std::uint64_t seed) {
  std::vector<std::optional<double>> differences;
  for (const SuiteRow& row : rows) {
    if (counts_in_figures(row)) {
      differences.emplace_back(row.risk.runs[method].harm - row.risk.runs[other].harm);
    }
  }
  return mean_over_encounters(differences, seed);
}

Estimate mean_over_encounters(const std::vector<std::optional<double>>& values,
                              std::uint64_t seed) {
  return values.empty() ? Estimate{} : Bootstrap(values.size(), seed).mean(values);
}

}  // namespace saca::eval
