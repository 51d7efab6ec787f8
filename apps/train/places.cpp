// saca-train-places: from recordings and encounters of the tuning split to the weights that
// predict where vehicles go (eval/mixture_lstm.h).
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/train/program.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/place_examples.h"
#include "saca/lab/eval/suite.h"
#include "saca/lab/eval/suite_source.h"
#include "saca/lab/eval/traffic_drives.h"
#include "saca/lab/network_training/place_mixture.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/lab/prepare/harm_file.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace {

namespace fs = std::filesystem;
using namespace saca;
using Sequences = std::vector<std::vector<eval::PlaceExample>>;

constexpr std::string_view program = "saca-train-places";

struct Options {
  std::vector<std::string> data;
  std::string output;
  std::string leave_out;
  std::string root = ".";
  int drives = 150;
  int encounters = 600;
  int threads = 1;
  std::size_t longest = 100;
  double dropout = 0.1;
  network_training::Schedule schedule{.seed = 1, .epochs = 15, .batch = 3'600};
};

/// One in so many encounters, or groups of drives, is not learnt from but watched.
constexpr std::size_t held_out_share = 8;

/// What is played, and with what.
struct World {
  manoeuvre::Car car;
  collision::HarmModel harm;
  intent::Model intent;
};

Result<World> read_world(const fs::path& root) {
  auto car = prepare::read_car(root / "data/vehicles/compact_rwd_ev.toml");
  if (!car.has_value()) {
    return car.error();
  }
  auto harm = prepare::read_harm(root / "data/harm.toml");
  if (!harm.has_value()) {
    return harm.error();
  }
  auto intent = intent::read_model(root / "models/intent/model.safetensors");
  if (!intent.has_value()) {
    return intent.error();
  }
  return World{car.value(), harm.value(), std::move(intent).value()};
}

struct Data {
  Sequences training;
  Sequences held_out;

  void add(Sequences some, bool is_held_out) {
    Sequences& to = is_held_out ? held_out : training;
    std::move(some.begin(), some.end(), std::back_inserter(to));
  }
};

Sequences examples_in(const scenario::Scenario& scenario, const scenario::Chance& chance,
                      const eval::ForecastWindow& window, const World& world) {
  const encounter::Stage stage{.scenario = &scenario,
                               .car = &world.car,
                               .harm = &world.harm,
                               .intent = &world.intent,
                               .thresholds = {},
                               .chance = chance};
  auto examples = eval::place_examples(stage, window);
  return examples.has_value() ? std::move(examples).value() : Sequences();
}

/// Encounters of a suite, tuning split: no other is ever drawn here.
std::optional<Error> add_suite(const std::string& suite, const Options& options, const World& world,
                               Data& data) {
  const auto source = eval::SuiteSource::open({.scenarios = fs::path(options.root) / "scenarios",
                                               .suite = suite,
                                               .split = families::Split::tuning,
                                               .test_log = std::nullopt,
                                               .car = "compact_rwd_ev",
                                               .footprint = manoeuvre::footprint(world.car)});
  if (!source.has_value()) {
    return source.error();
  }
  const eval::SuiteOptions as_suite{.methods = {}, .seed = options.schedule.seed, .exact = false};
  std::vector<Sequences> all(static_cast<std::size_t>(options.encounters));
  in_parallel(all.size(), options.threads, [&](std::size_t i) {
    const auto sample = source.value().sample(i);
    if (sample.has_value()) {
      all[i] = examples_in(eval::as_played(sample.value().scenario, as_suite),
                           eval::chance_of(as_suite, i), {}, world);
    }
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    data.add(std::move(all[i]), i % held_out_share == 0);
  }
  return std::nullopt;
}

/// Recorded drives of every site but the one that is left out.
std::optional<Error> add_traffic(const Options& options, const World& world, Data& data) {
  const auto found = eval::traffic_drives(
      {options.data.begin(), options.data.end()}, static_cast<std::size_t>(options.drives),
      options.schedule.seed, [] { return !train_program::is_to_stop(); });
  if (!found.has_value()) {
    return found.error();
  }
  const std::vector<eval::TrafficDrive>& drives = found.value().drives;
  const eval::SuiteOptions as_suite{.methods = {}, .seed = options.schedule.seed, .exact = false};
  std::vector<Sequences> all(drives.size());
  in_parallel(all.size(), options.threads, [&](std::size_t i) {
    if (drives[i].site == options.leave_out) {
      return;
    }
    const auto played = eval::played_drive(drives[i]);
    if (played.has_value()) {
      all[i] = examples_in(eval::as_played(played.value().scenario, as_suite),
                           {.perception = eval::encounter_seed(as_suite.seed, i)},
                           played.value().window, world);
    }
  });
  std::map<std::string, std::size_t> groups;  // whole groups are held out: they share road users
  for (const eval::TrafficDrive& drive : drives) {
    groups.emplace(drive.site + " " + drive.group, 0);
  }
  std::size_t number = 0;
  for (auto& [name, index] : groups) {
    index = number++;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t group = groups.at(drives[i].site + " " + drives[i].group);
    data.add(std::move(all[i]), group % held_out_share == 0);
  }
  return std::nullopt;
}

Result<Data> read_data(const Options& options, const World& world) {
  Data data;
  for (const char* const suite : {"balanced", "natural"}) {
    if (auto problem = add_suite(suite, options, world, data)) {
      return *std::move(problem);
    }
  }
  if (!options.data.empty()) {
    if (auto problem = add_traffic(options, world, data)) {
      return *std::move(problem);
    }
  }
  return data;
}

int train_places(const Options& options) {
  const auto world = read_world(options.root);
  if (!world.has_value()) {
    return train_program::failed(program, world.error());
  }
  const auto data = read_data(options, world.value());
  if (!data.has_value()) {
    return train_program::failed(program, data.error());
  }
  const auto pieces = network_training::place_pieces(data.value().training, options.longest);
  const auto held_out = network_training::place_pieces(data.value().held_out, options.longest);
  fmt::print("{} pieces to train with, {} held out\n", pieces.size(), held_out.size());
  std::fflush(stdout);
  if (pieces.empty()) {
    return train_program::failed(
        program, {Error::Code::out_of_range, "--encounters, --data: want something to learn from"});
  }
  std::string curve = "epoch,training_loss,held_out_loss,seconds\n";
  const std::string state = options.output + ".state";
  const auto network = network_training::trained_mixture(
      pieces, held_out, options.schedule, options.dropout, state,
      [&](const network_training::Epoch& now) {
        const double other = now.held_out.value_or(std::nan(""));
        curve += fmt::format("{},{:.5f},{:.5f},{:.1f}\n", now.number, now.loss, other, now.seconds);
        return train_program::show_epoch(now, options.schedule.epochs);
      });
  if (!network.has_value()) {
    return train_program::failed(program, network.error());
  }
  if (train_program::is_to_stop()) {
    return train_program::stopped(program);
  }
  formats::Tensors tensors = network.value()->tensors();
  tensors.words = {{"left_out", options.leave_out.empty() ? "nothing" : options.leave_out},
                   {"seed", std::to_string(options.schedule.seed)},
                   {"epochs", std::to_string(options.schedule.epochs)},
                   {"encounters", std::to_string(options.encounters)},
                   {"drives", std::to_string(options.data.empty() ? 0 : options.drives)}};
  if (const auto problem = train_program::write_trained(options.output, tensors, curve)) {
    return train_program::failed(program, *problem);
  }
  fs::remove(state);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  train_program::begin(argv);
  CLI::App app("Trains what predicts where vehicles go: a mixture density network, with libtorch");
  Options options;
  app.add_option("--output", options.output, "safetensors file of the weights")->required();
  app.add_option("--data", options.data, "Folders with CommonRoad files of recorded traffic");
  app.add_option("--leave-out", options.leave_out, "A site of them that is not to be seen");
  app.add_option("--root", options.root, "Holds scenarios/, data/ and models/")
      ->capture_default_str();
  app.add_option("--drives", options.drives, "Of each site at most")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app.add_option("--encounters", options.encounters, "Of each suite, tuning split")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  app.add_option("--seed", options.schedule.seed)->capture_default_str();
  app.add_option("--epochs", options.schedule.epochs)
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  app.add_option("--threads", options.threads,
                 "That play encounters; they do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return train_places(options);
}
