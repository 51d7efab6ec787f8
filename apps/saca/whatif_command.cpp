#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/moment_option.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/whatif.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/report/map_svg.h"

namespace saca::app {
namespace {

using eval::Axis;
using eval::Cell;
using nlohmann::json;

struct WhatifCommand {
  std::string scenario;
  std::vector<std::string> vary;
  std::optional<double> at;
  std::string svg = "runs/whatif.svg";
  int threads = usual_threads();
  bool as_json = false;
};

constexpr std::size_t most_cells = 40'000;

/// The scenario at one place of the map, or why there is none.
Result<scenario::Scenario> scenario_at(const ScenarioInputs& inputs, double time,
                                       const std::vector<Axis>& axes, std::size_t cell) {
  auto changed = Result<scenario::Scenario>(inputs.scenario);
  for (const Axis& axis : axes) {
    const double value = axis.values[cell % axis.values.size()];
    cell /= axis.values.size();
    changed = eval::varied(changed.value(), inputs.car, time, axis, value);
    if (!changed.has_value()) {
      return changed;
    }
  }
  return changed;
}

std::size_t num_cells(const std::vector<Axis>& axes) {
  std::size_t count = 1;
  for (const Axis& axis : axes) {
    count *= axis.values.size();
  }
  return count;
}

/// All cells, the first axis fastest; nullopt: interrupted.
Result<std::optional<std::vector<Cell>>> try_all(const ScenarioInputs& inputs, double time,
                                                 const std::vector<Axis>& axes, int threads) {
  std::vector<Cell> cells(num_cells(axes));
  std::vector<std::optional<Error>> problems(cells.size());
  SteadyClock clock;
  long_work::ProgressLine progress("what if", static_cast<int>(cells.size()), clock,
                                   progress_display());
  long_work::watch_for_interrupt();
  constexpr std::size_t at_once = 32;
  for (std::size_t from = 0; from < cells.size(); from += at_once) {
    if (long_work::interrupted()) {
      return std::optional<std::vector<Cell>>();
    }
    const std::size_t to = std::min(cells.size(), from + at_once);
    std::vector<std::optional<scenario::Scenario>> varied(to - from);
    in_parallel(to - from, threads, [&](std::size_t i) {
      const auto scenario = scenario_at(inputs, time, axes, from + i);
      if (scenario.has_value()) {
        varied[i] = scenario.value();
      } else {
        problems[from + i] = scenario.error();
      }
    });
    const auto tried = eval::try_cells(varied, inputs.car, inputs.harm, time, threads);
    std::copy(tried.begin(), tried.end(), cells.begin() + static_cast<std::ptrdiff_t>(from));
    if (to < cells.size()) {
      progress.show(static_cast<int>(to), 0, " scenes");
    }
  }
  const bool none =
      std::none_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.possible; });
  if (none) {
    const auto why = std::find_if(problems.begin(), problems.end(),
                                  [](const auto& problem) { return problem.has_value(); });
    return why == problems.end()
               ? Error{Error::Code::out_of_range, "--vary: bodies overlap whatever the value"}
               : **why;
  }
  return std::optional(cells);
}

std::array<bool, manoeuvre::num_policies> refused_in(const Cell& cell) {
  std::array<bool, manoeuvre::num_policies> refused{};
  for (std::size_t i = 0; i < refused.size(); ++i) {
    refused.at(i) = !cell.harms.at(i).has_value();
  }
  return refused;
}

report::MapCell drawn(const Cell& cell) {
  if (!cell.possible) {
    return {.verdict = report::MapVerdict::unplayable};
  }
  const bool no_risk = *cell.harms[manoeuvre::index(manoeuvre::PolicyId::no_intervention)] <
                       0.5 * collision::harm_tie;
  return {.verdict = no_risk ? report::MapVerdict::no_risk : report::MapVerdict::decided,
          .best = cell.best,
          .margin = cell.margin,
          .refused = refused_in(cell)};
}

report::MapAxis drawn(const Axis& axis, const std::optional<double>& nominal) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> units{{{"_m", "m"},
                                                                                {"_mps", "m/s"},
                                                                                {"_mps2", "m/s2"},
                                                                                {"_s", "s"},
                                                                                {"_deg", "deg"},
                                                                                {"_degps", "deg/s"},
                                                                                {"_kg", "kg"},
                                                                                {"_1pm", "1/m"},
                                                                                {"", "-"}}};
  const auto unit = std::find_if(units.begin(), units.end(),
                                 [&](const auto& one) { return axis.key.ends_with(one.first); });
  std::string name = axis.what;
  if (const auto at = name.rfind(axis.key);
      at != std::string::npos) {  // a place in a list may follow
    name.erase(at + axis.key.size() - unit->first.size(), unit->first.size());
  }
  return {
      .name = name, .unit = std::string(unit->second), .values = axis.values, .nominal = nominal};
}

std::string picture(const ScenarioInputs& inputs, double time, const std::vector<Axis>& axes,
                    const std::vector<Cell>& cells) {
  std::vector<report::MapCell> drawn_cells;
  drawn_cells.reserve(cells.size());
  for (const Cell& cell : cells) {
    drawn_cells.push_back(drawn(cell));
  }
  const std::vector<std::string> lines{
      inputs.scenario.title,
      fmt::format("All eight begin at {:.2f} s; everything else is where it was.", time)};
  const auto axis = [&](std::size_t i) {
    return drawn(axes[i], eval::nominal(inputs.scenario, inputs.car, time, axes[i]));
  };
  if (axes.size() == 2) {
    return report::map_svg({.title = "Which policy is best",
                            .lines = lines,
                            .x = axis(0),
                            .y = axis(1),
                            .cells = drawn_cells});
  }
  report::PolicyStrip strip{.title = "Which policy is best",
                            .lines = lines,
                            .x = axis(0),
                            .cells = drawn_cells,
                            .curves = {}};
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    report::HarmCurve curve{.policy = policy, .harm = {}, .low = {}, .high = {}};
    for (const Cell& cell : cells) {
      curve.harm.push_back(cell.harms[manoeuvre::index(policy)]);
    }
    strip.curves.push_back(curve);
  }
  return report::strip_svg(strip);
}

json json_of(const Cell& cell) {
  json harms = json::array();
  for (const auto& harm : cell.harms) {
    harms.push_back(harm ? json(*harm) : json());
  }
  return cell.possible ? json{{"best", manoeuvre::index(cell.best)},
                              {"alone", cell.alone},
                              {"margin", cell.margin},
                              {"contact", cell.contact},
                              {"harm", harms}}
                       : json();
}

void print_counts(const std::vector<Cell>& cells) {
  std::array<int, manoeuvre::num_policies> counts{};
  int impossible = 0;
  for (const Cell& cell : cells) {
    cell.possible ? ++counts[manoeuvre::index(cell.best)] : ++impossible;
  }
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    if (counts[manoeuvre::index(policy)] > 0) {
      app::print("  {:6} best in {:5.1f} %\n", name(policy),
                 100.0 * counts[manoeuvre::index(policy)] / static_cast<double>(cells.size()));
    }
  }
  for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
    const auto refused = std::count_if(cells.begin(), cells.end(), [&](const Cell& cell) {
      return cell.possible && !cell.harms.at(manoeuvre::index(policy));
    });
    if (refused > 0) {
      app::print("  {:6} cannot be driven in {} of {}\n", name(policy), refused, cells.size());
    }
  }
  if (impossible > 0) {
    app::print("  {} of {} cannot be: bodies would overlap, or a value is out of range\n",
               impossible, cells.size());
  }
}

int run(const WhatifCommand& options) {
  const auto inputs = read_scenario_inputs(options.scenario);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  std::vector<Axis> axes;
  for (const std::string& text : options.vary) {
    const auto axis = eval::parse_axis(text, inputs.value().scenario);
    if (!axis.has_value()) {
      return refused({axis.error().code, "--vary " + axis.error().message});
    }
    axes.push_back(axis.value());
  }
  if (axes.size() == 2 && axes[0].what == axes[1].what) {
    return refused({Error::Code::malformed,
                    "--vary: want two different numbers, got " + axes[0].what + " twice"});
  }
  if (num_cells(axes) > most_cells) {
    return refused({Error::Code::out_of_range, fmt::format("--vary: want at most {} scenes, got {}",
                                                           most_cells, num_cells(axes))});
  }
  const auto time = decision_time(inputs.value(), options.at);
  if (!time.has_value()) {
    return refused(time.error());
  }
  if (!time.value()) {
    return nothing_to_decide;
  }
  const double begin = *time.value();
  if (const auto problem = long_work::why_outputs_unwritable({options.svg})) {
    return refused(*problem);
  }
  const auto cells = try_all(inputs.value(), begin, axes, options.threads);
  if (!cells.has_value()) {
    return refused(cells.error());
  }
  if (!cells.value()) {
    complain("interrupted; nothing was written");
    return was_interrupted;
  }
  auto problem =
      long_work::write_output(options.svg, picture(inputs.value(), begin, axes, *cells.value()));
  if (problem) {
    return refused(*problem);
  }
  if (!options.as_json) {
    app::print("{}, {} scenes, from {:.2f} s on\n", inputs.value().scenario.title,
               cells.value()->size(), begin);
    print_counts(*cells.value());
    app::print("Map: {}\n", std::filesystem::absolute(options.svg).string());
    return success;
  }
  json all{{"schema", "saca.whatif/1"},
           {"scenario", inputs.value().scenario.name},
           {"time_s", begin},
           {"axes", json::array()},
           {"cells", json::array()}};
  for (const Axis& axis : axes) {
    all["axes"].push_back({{"what", axis.what}, {"values", axis.values}});
  }
  for (const Cell& cell : *cells.value()) {
    all["cells"].push_back(json_of(cell));
  }
  app::print_json(all);
  return success;
}

}  // namespace

void add_whatif(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "whatif", "Map which policy is best when one or two numbers of a scenario change");
  const auto options = std::make_shared<WhatifCommand>();
  command
      ->add_option("scenario", options->scenario, "A scenario file, or the name of a shipped one")
      ->required();
  command
      ->add_option("--vary", options->vary,
                   "NUMBER=FROM:TO:STEP, once or twice. As it is when the policies begin: "
                   "ego.speed_mps, ego.offset_m, truck1.distance_m, truck1.offset_m, "
                   "truck1.speed_mps, grip; as it stands in the scenario: any other number, by its "
                   "keys and places in lists, as road.left_edge_m, truck1.start.brake_at_s, "
                   "actors.0.mass_kg")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_size(1);
  add_at(*command, options->at);
  command->add_option("--svg", options->svg, "The map")->capture_default_str();
  command->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] {
    if (options->vary.size() > 2) {
      throw CLI::ValidationError("--vary", "at most twice");
    }
    exit_code = run(*options);
  });
}

}  // namespace saca::app
