#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/danger_check.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/progress.h"
#include "saca/config/tensors.h"
#include "saca/core/clock.h"
#include "saca/core/file.h"
#include "saca/core/fnv.h"
#include "saca/core/parallel.h"
#include "saca/danger/check.h"
#include "saca/danger/network.h"
#include "saca/manoeuvre/ego.h"

namespace saca::app {
namespace {

using danger::Checked;
using danger::CheckFigures;
using danger::Share;
using nlohmann::json;

struct DangerCheckOptions {
  std::string weights;
  int situations = 20'000;
  std::uint64_t seed = 1;
  int threads = usual_threads();
  bool as_json = false;
};

constexpr double confidence = 1.0 - 1e-6;

/// Situations of like speed and grip.
struct SpeedAndGrip {
  std::string name;
  double slowest;  ///< [m/s]
  double fastest;
  double least_grip;
  double most_grip;

  [[nodiscard]] bool holds(const Checked& one) const {
    return one.speed >= slowest && one.speed < fastest && one.grip >= least_grip &&
           one.grip < most_grip;
  }
};

std::vector<SpeedAndGrip> bins() {
  constexpr double any = std::numeric_limits<double>::infinity();
  std::vector<SpeedAndGrip> all;
  for (const auto& [slow, fast, speeds] : {std::tuple{0.0, 10.0, "below_10"},
                                           {10.0, 20.0, "10_to_20"},
                                           {20.0, 30.0, "20_to_30"},
                                           {30.0, any, "from_30"}}) {
    for (const auto& [low, high, grips] :
         {std::tuple{0.0, 0.5, "slippery"}, {0.5, any, "good_grip"}}) {
      all.push_back({fmt::format("{}_mps.{}", speeds, grips), slow, fast, low, high});
    }
  }
  return all;
}

std::vector<Checked> in_bin(const std::vector<Checked>& all, const SpeedAndGrip& bin) {
  std::vector<Checked> some;
  for (const Checked& one : all) {
    if (bin.holds(one)) {
      some.push_back(one);
    }
  }
  return some;
}

/// How long a value takes, of 32 that are asked for at once [us].
double microseconds_of_value(const danger::Network& network, SteadyClock& clock) {
  constexpr std::size_t count = danger::Network::at_once;
  constexpr int times = 2'000;
  const std::vector<danger::SeenByNet> seen(count);
  std::vector<double> v(count);
  const auto start = clock.now();
  for (int i = 0; i < times; ++i) {
    network.values(seen, v);
  }
  const std::chrono::duration<double, std::micro> taken = clock.now() - start;
  return taken.count() / (times * static_cast<double>(count));
}

/// The figures of all, and of each bin, under their names.
json figures_json(const std::string& place, const CheckFigures& figures) {
  json all;
  const auto add = [&](const char* name, const Share& share) {
    all[place + name] = share.value();
    all[place + name + ".n"] = share.of;
  };
  add("hit_given_told_safe", figures.hit_given_told_safe);
  all[place + "hit_given_told_safe.hi"] =
      danger::upper_bound(figures.hit_given_told_safe, confidence);
  add("told_safe_given_hit", figures.told_safe_given_hit);
  add("false_alarm", figures.false_alarms);
  add("sign_agreement", figures.agreeing_near);
  all[place + "mean_error_m"] = figures.mean_error_near;
  all[place + "bias_m"] = figures.bias_near;
  all[place + "p99_error_m"] = figures.p99_error_near;
  all[place + "lost_by_acting_m"] = figures.lost_near;
  return all;
}

void tell_danger_row(const std::string& name, double margin, const CheckFigures& figures) {
  app::print("{:28} {:7.2f} {:9.3f} {:9.3f} {:9.2f} {:9.2f} {:9.2f} {:8.3f} {:8.3f} {:8.3f}\n",
             name, margin, 100.0 * figures.hit_given_told_safe.value(),
             100.0 * danger::upper_bound(figures.hit_given_told_safe, confidence),
             100.0 * figures.told_safe_given_hit.value(), 100.0 * figures.false_alarms.value(),
             100.0 * figures.agreeing_near.value(), figures.mean_error_near, figures.bias_near,
             figures.lost_near);
}

void tell(const std::vector<Checked>& fitted, const std::vector<Checked>& others, bool as_json,
          json all) {
  if (!as_json) {
    app::print("{} situations for the margins, {} others for the figures\n\n", fitted.size(),
               others.size());
    app::print("{:28} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "", "margin",
               "hit|safe", "at most", "safe|hit", "false", "sign", "error", "bias", "lost");
    app::print("{:28} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "", "[m]", "[%]",
               "[%]", "[%]", "[%]", "[%]", "[m]", "[m]", "[m]");
  }
  const auto add = [&](const std::string& name, const std::string& place, double margin,
                       const std::vector<Checked>& some) {
    const CheckFigures figures = danger::figures_of(some, margin);
    all[place + "margin_m"] = margin;
    all.update(figures_json(place, figures));
    if (!as_json) {
      tell_danger_row(name, margin, figures);
    }
  };
  add("all, no margin", "danger.net.plain.", 0.0, others);
  // What is told with the margin of its own bin is told with a margin of 0.
  std::vector<Checked> with_margins;
  for (const SpeedAndGrip& bin : bins()) {
    const double margin = danger::margin_of(in_bin(fitted, bin));
    const std::vector<Checked> some = in_bin(others, bin);
    add(bin.name, "danger.net." + bin.name + ".", margin, some);
    for (Checked one : some) {
      one.told += margin;
      with_margins.push_back(one);
    }
  }
  add("all, each with its margin", "danger.net.", 0.0, with_margins);
  if (as_json) {
    print_json(all);
  }
}

int check_danger(const DangerCheckOptions& options) {
  watch_for_interrupt();
  const auto network = read_danger_network(options.weights);
  if (!network.has_value()) {
    return refused(network.error());
  }
  const auto& words = network.value().words();
  const auto car = words.find("car");
  if (car == words.end()) {
    return refused({Error::Code::malformed, options.weights + ": want a word `car`, got none"});
  }
  const auto inputs = read_inputs(car->second);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  SteadyClock clock;
  const world::Footprint body = manoeuvre::footprint(inputs.value().car);
  std::vector<Checked> all(static_cast<std::size_t>(options.situations));
  constexpr std::size_t at_once = 200;
  {
    ProgressLine line("danger check", options.situations, clock);
    for (std::size_t first = 0; first < all.size(); first += at_once) {
      const std::size_t count = std::min(at_once, all.size() - first);
      in_parallel(count, options.threads, [&](std::size_t i) {
        Fnv seed;
        seed.add(fmt::format("check {} {}", options.seed, first + i));
        all[first + i] = danger::checked(inputs.value().car, body, network.value(), seed.value());
      });
      line.show(static_cast<int>(first + count), 0, " situations");
      if (interrupted()) {
        complain("interrupted; nothing was kept: the same command begins anew");
        return was_interrupted;
      }
    }
  }
  const auto half = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  json figures{{"danger.net.us_batch32", microseconds_of_value(network.value(), clock)},
               {"meta.weights", options.weights},
               {"meta.car", car->second},
               {"meta.situations", options.situations},
               {"meta.seed", std::to_string(options.seed)}};
  if (!options.as_json) {
    app::print("a value takes {:.2f} us, 32 at once\n",
               figures["danger.net.us_batch32"].get<double>());
  }
  tell({all.begin(), half}, {half, all.end()}, options.as_json, std::move(figures));
  return success;
}

}  // namespace

Result<danger::Network> read_danger_network(const std::string& path) {
  const auto bytes = read_file(path, many_bytes);
  if (!bytes.has_value()) {
    return bytes.error();
  }
  const auto tensors = config::read_tensors(bytes.value(), path);
  if (!tensors.has_value()) {
    return tensors.error();
  }
  return danger::Network::from(tensors.value(), path);
}

void add_danger_check(CLI::App& danger, int& exit_code) {
  const auto options = std::make_shared<DangerCheckOptions>();
  CLI::App* const command = danger.add_subcommand(
      "check", "Drive the full vehicle by learnt V_h and Q_h, and tell how often they are wrong");
  command->add_option("WEIGHTS", options->weights, "safetensors file of saca-train-danger")
      ->required();
  command
      ->add_option("--situations", options->situations,
                   "Half of them set the margins, the others make the figures")
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
