#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/decide_bench.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_bench.h"
#include "apps/saca/within.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/percentile.h"
#include "saca/base/world/time_to_conflict.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/forecast/futures.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/onboard/manoeuvre/controller.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::app {
namespace {

using nlohmann::json;

/// Integrated milliseconds per second of computing: a stop from 20 m/s, over and over.
void bench_vehicle(const manoeuvre::Car& car, const Clock& clock, json& figures) {
  world::Scene scene;
  scene.ego.v_B = {20.0, 0.0};
  const manoeuvre::Plan plan{manoeuvre::PolicyId::aeb, std::nullopt};
  constexpr int num_stops = 100;
  constexpr int num_steps = 2'000;
  const Clock::Time start = clock.now();
  for (int stop = 0; stop < num_stops; ++stop) {
    manoeuvre::ControllerState memory = manoeuvre::begin(car, plan, scene);
    vehicle::VehicleState state = manoeuvre::rolling_state(car, scene.ego, 0.9);
    for (int k = 0; k < num_steps; ++k) {
      const vehicle::Command command =
          manoeuvre::control(car, scene.road, 0.9, state, memory, vehicle::usual_step);
      state = vehicle::step(car, state, command, 0.9, vehicle::usual_step);
    }
  }
  figures["vehicle.steps_per_s"] = num_stops * num_steps / to_seconds(clock.now() - start);
}

/// All eight read from the atlas and judged: percentiles, with one target speed and with four, the
/// others known exactly and with their spread.
void bench_atlas(const manoeuvre::Car& car, const atlas::Atlas& atlas,
                 const collision::HarmModel& harm, const Clock& clock, int num_calls,
                 json& figures) {
  constexpr std::array half{0.5};
  for (const int num_actors : {1, 8, 32}) {
    for (const bool spread : {false, true}) {
      std::mt19937 rng(1);
      std::vector<world::Scene> scenes;
      std::vector<std::vector<world::Track>> tracks;
      for (int i = 0; i < 64; ++i) {
        world::Scene scene = crowd(car, num_actors, rng);
        scene.grip_sd = spread ? 0.06 : 0.0;
        tracks.emplace_back();
        for (world::Actor& actor : scene.actors) {
          actor.position_sd = spread ? 0.2 : 0.0;
          actor.velocity_sd = spread ? 0.3 : 0.0;
          world::Track& track = tracks.back().emplace_back();
          for (int k = 0; k <= 600; ++k) {
            track.X_WA.push_back(world::actor_going_on(actor, track.step * k));
          }
        }
        scenes.push_back(scene);
      }
      for (const bool chooses : {false, true}) {
        std::vector<double> times;
        int num_outside = 0;
        for (int call = 0; call < num_calls; ++call) {
          const std::size_t i = static_cast<std::size_t>(call) % scenes.size();
          const Clock::Time start = clock.now();
          const forecast::Futures all =
              forecast::futures(atlas, scenes[i], tracks[i], harm,
                                {.shares = chooses ? forecast::BrakingChoices{}.shares
                                                   : std::span<const double>(half)});
          times.push_back(1e6 * to_seconds(clock.now() - start));
          num_outside += all[0].outside ? 1 : 0;
        }
        const std::string suffix = fmt::format(".actors{}{}{}", num_actors, spread ? ".spread" : "",
                                               chooses ? ".targets4" : "");
        figures["atlas.futures_us.p50" + suffix] = percentile(times, 0.5);
        figures["atlas.futures_us.p99" + suffix] = percentile(times, 0.99);
        figures["atlas.futures_us.n" + suffix] = num_calls;
        figures["atlas.outside_share" + suffix] = static_cast<double>(num_outside) / num_calls;
      }
    }
  }
}

struct BenchOptions {
  std::string what = "all";
  int calls = 1'000'000;
  bool as_json = false;
};

int bench(const BenchOptions& options) {
  const auto read = read_inputs("compact_rwd_ev");
  if (!read.has_value()) {
    complain(read.error().message);
    return bad_input;
  }
  const Inputs& inputs = read.value();
  SteadyClock clock;
  json figures;
  const auto asked = [&](std::string_view what) {
    return options.what == "all" || options.what == what;
  };
  if (asked("vehicle")) {
    bench_vehicle(inputs.car, clock, figures);
  }
  std::optional<Error> problem;
  if (asked("reach")) {
    problem = bench_reach(inputs.places.root, inputs.car, clock, figures);
  } else if (asked("air3d")) {
    problem = bench_air3d(inputs.places.root, clock, figures);
  }
  if (problem) {
    return refused(*problem);
  }
  const int fewer_calls = std::min(options.calls, 10'000);
  if (asked("decide") || asked("atlas")) {
    const atlas::Atlas atlas = usual_atlas(inputs);
    if (asked("decide")) {
      bench_decide(inputs, atlas, clock, options.calls, figures);
    }
    if (asked("atlas")) {
      bench_atlas(inputs.car, atlas, inputs.harm, clock, fewer_calls, figures);
    }
  }
  if (options.as_json) {
    app::print_json(figures);
    return success;
  }
  for (const auto& [name, value] : figures.items()) {
    app::print("{:52} {:.6g}\n", name, value.get<double>());
  }
  return success;
}

}  // namespace

void add_bench(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand("bench",
                                                "Measure: vehicle steps, the reflex plane and the "
                                                "forecaster, the atlas, the solver of reach");
  const auto options = std::make_shared<BenchOptions>();
  command
      ->add_option("what", options->what,
                   "all, vehicle, decide, atlas, reach, or air3d: a part of reach")
      ->check(one_of({"all", "vehicle", "decide", "atlas", "reach", "air3d"}))
      ->capture_default_str();
  command->add_option("--calls", options->calls, "Of the reflex plane, for each number of actors")
      ->check(CLI::Range(1'000, 100'000'000))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = bench(*options); });
}

}  // namespace saca::app
