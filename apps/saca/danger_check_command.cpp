#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/danger_check.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/learned_danger/check.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/progress.h"

namespace saca::app {
namespace {

using learned_danger::CheckedCase;
using learned_danger::CheckFigures;
using learned_danger::Share;
using nlohmann::json;

struct DangerCheckOptions {
  std::string weights;
  int situations = 20'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

std::vector<CheckedCase> in_bin(const std::vector<CheckedCase>& all, std::size_t bin) {
  std::vector<CheckedCase> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), [&](const CheckedCase& one) {
    return learned_danger::bin_of(one.is_straight, one.speed, one.grip, one.num_obstacles) == bin;
  });
  return some;
}

/// How long a value takes, of 32 that are asked for at once [us].
double microseconds_of_value(const learned_danger::Network& network, const SteadyClock& clock) {
  constexpr std::size_t count = learned_danger::Network::at_once;
  constexpr int times = 2'000;
  const std::vector<learned_danger::SeenByNet> seen(count);
  std::vector<double> v(count);
  const auto start = clock.now();
  for (int i = 0; i < times; ++i) {
    network.values(seen, v);
  }
  const std::chrono::duration<double, std::micro> taken = clock.now() - start;
  return taken.count() / (times * static_cast<double>(count));
}

/// The figures of all, or of a bin, under their names.
json figures_json(const std::string& place, const CheckFigures& figures) {
  json all;
  const auto add = [&](const char* name, const Share& share) {
    all[place + name] = share.value();
    all[place + name + ".n"] = share.of;
  };
  add("hit_given_told_safe", figures.hit_given_told_safe);
  all[place + "hit_given_told_safe.hi"] =
      learned_danger::upper_bound(figures.hit_given_told_safe, learned_danger::margin_confidence);
  add("hit_given_just_safe", figures.hit_given_just_safe);
  add("told_safe_given_hit", figures.told_safe_given_hit);
  add("false_alarm", figures.false_alarms);
  add("sign_agreement", figures.agreeing_near);
  all[place + "mean_error_m"] = figures.mean_error_near;
  all[place + "bias_m"] = figures.bias_near;
  all[place + "p99_error_m"] = figures.p99_error_near;
  all[place + "lost_by_acting_m"] = figures.lost_near;
  add("pincer", figures.pincers);
  add("pincer_told", figures.told_of_pincers);
  add("pincer_told_alone", figures.told_alone_of_pincers);
  return all;
}

void tell_danger_row(const std::string& name, const std::string& margin,
                     const CheckFigures& figures) {
  app::print(
      "{:42} {:>7} {:9.3f} {:9.3f} {:9.3f} {:9.2f} {:9.2f} {:9.2f} {:8.3f} {:8.3f} {:8.3f}\n", name,
      margin, 100.0 * figures.hit_given_told_safe.value(),
      100.0 * learned_danger::upper_bound(figures.hit_given_told_safe,
                                          learned_danger::margin_confidence),
      100.0 * figures.hit_given_just_safe.value(), 100.0 * figures.told_safe_given_hit.value(),
      100.0 * figures.false_alarms.value(), 100.0 * figures.agreeing_near.value(),
      figures.mean_error_near, figures.bias_near, figures.lost_near);
}

void tell_head() {
  app::print("{:42} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "", "margin",
             "hit|safe", "at most", "hit|just", "safe|hit", "false", "sign", "error", "bias",
             "lost");
  app::print("{:42} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "", "[m]",
             "[%]", "[%]", "[%]", "[%]", "[%]", "[%]", "[m]", "[m]", "[m]");
}

void tell(const std::vector<CheckedCase>& situations,
          const std::optional<learned_danger::Margins>& margins, bool as_json, json all) {
  if (!as_json) {
    tell_head();
  }
  const auto margin_of = [&](const CheckedCase& one) {
    return margins ? margins->at(one.is_straight, one.speed, one.grip, one.num_obstacles) : 0.0;
  };
  const auto add = [&](const std::string& name, const std::string& place, const std::string& margin,
                       const CheckFigures& figures) {
    all.update(figures_json(place, figures));
    if (!as_json) {
      tell_danger_row(name, margin, figures);
    }
    return figures;
  };
  add("all, no margin", "danger.net.plain.", "0",
      learned_danger::figures_of(situations, [](const CheckedCase&) { return 0.0; }));
  if (margins) {
    for (std::size_t bin = 0; bin < learned_danger::num_bins; ++bin) {
      const std::vector<CheckedCase> some = in_bin(situations, bin);
      const std::string& name = learned_danger::bin_names()[bin];
      const double margin = margins->metres()[bin];
      all["danger.net." + name + ".margin_m"] = margin;
      add(name, "danger.net." + name + ".",
          margin < learned_danger::Margins::none ? fmt::format("{:.2f}", margin) : "none",
          learned_danger::figures_of(some, margin_of));
    }
    add("all, each with its margin", "danger.net.", "",
        learned_danger::figures_of(situations, margin_of));
  }
  for (const auto& [name, place, is_one] :
       {std::tuple{"one obstacle", "one", true}, {"several obstacles", "several", false}}) {
    std::vector<CheckedCase> some;
    std::copy_if(
        situations.begin(), situations.end(), std::back_inserter(some),
        [one = is_one](const CheckedCase& each) { return (each.num_obstacles == 1) == one; });
    add(name, fmt::format("danger.net.{}.", place), "",
        learned_danger::figures_of(some, margin_of));
  }
  if (as_json) {
    print_json(all);
    return;
  }
  const CheckFigures figures = learned_danger::figures_of(situations, margin_of);
  app::print(
      "\npincers, which each obstacle alone leaves a way out of: {} of {} situations with several "
      "obstacles; told unsafe {}, by the highest single value {}\n",
      figures.pincers.count, figures.pincers.of, figures.told_of_pincers.count,
      figures.told_alone_of_pincers.count);
}

int check_danger(const DangerCheckOptions& options) {
  constexpr int situations_at_once = 200;
  long_work::watch_for_interrupt();
  const auto read = read_danger_weights(options.weights);
  if (!read.has_value()) {
    return refused(read.error());
  }
  const DangerWeights& weights = read.value();
  const auto margins = learned_danger::Margins::from(weights.network.words(), options.weights);
  if (!margins.has_value()) {
    return refused(margins.error());
  }
  SteadyClock clock;
  std::vector<CheckedCase> all;
  {
    long_work::ProgressLine line("danger check", options.situations, clock, progress_display());
    while (std::ssize(all) < options.situations) {
      const int done = static_cast<int>(all.size());
      const auto more = checked_situations<CheckedCase>(
          "check", done, std::min(situations_at_once, options.situations - done), options.threads,
          options.seed, [&](std::uint64_t seed) {
            return learned_danger::checked(weights.inputs.car, weights.body, weights.network, seed);
          });
      all.insert(all.end(), more.begin(), more.end());
      line.show(static_cast<int>(all.size()), 0, " situations");
      if (long_work::interrupted()) {
        complain("interrupted; nothing was kept: the same command begins anew");
        return was_interrupted;
      }
    }
  }
  json figures{{"danger.net.us_batch32", microseconds_of_value(weights.network, clock)},
               {"meta.weights", options.weights},
               {"meta.car", weights.car_name},
               {"meta.situations", options.situations},
               {"meta.seed", std::to_string(options.seed)}};
  if (!options.as_json) {
    app::print("a value takes {:.2f} us, 32 at once\n",
               figures["danger.net.us_batch32"].get<double>());
  }
  tell(all, margins.value(), options.as_json, std::move(figures));
  return success;
}

}  // namespace

void add_danger_check(CLI::App& danger, int& exit_code) {
  const auto options = std::make_shared<DangerCheckOptions>();
  CLI::App* const command = danger.add_subcommand(
      "check", "Drive the full vehicle by learnt V_h and Q_h, and tell how often they are wrong");
  command->add_option("WEIGHTS", options->weights, "safetensors file of saca-train-danger")
      ->required();
  command->add_option("--situations", options->situations)
      ->check(CLI::Range(2, 10'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed)->capture_default_str();
  command->add_option("--threads", options->threads, "They do not change the figures")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = check_danger(*options); });
}

}  // namespace saca::app
