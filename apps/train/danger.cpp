// saca-train-danger: from the transitions of `saca danger dataset` to the weights of V_h and Q_h.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/train/program.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/learned_danger/experience.h"
#include "saca/lab/learned_danger/learned.h"
#include "saca/lab/learned_danger/network.h"
#include "saca/lab/learned_danger/transition_file.h"
#include "saca/lab/network_training/danger_training.h"
#include "saca/lab/prepare/car_file.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace {

namespace fs = std::filesystem;
using namespace saca;

constexpr std::string_view program = "saca-train-danger";

struct Options {
  std::string folder;
  std::string output;
  std::string root = ".";
  int threads = usual_threads();
  network_training::DangerPlan plan;
  int pair_steps = 20'000;
  std::string values_of;  ///< weights; empty: none
  std::string q_of;       ///< likewise
  int hold_looks = 5;     ///< that an input is held, with `q_of`
  /// What is learnt on top of.
  [[nodiscard]] const std::string& earlier() const { return q_of.empty() ? values_of : q_of; }
};

/// What was read, and what the weights' file says of it.
struct Data {
  learned_danger::Experience singles{.num_obstacles = 1};
  learned_danger::Experience pairs{.num_obstacles = 2};
  std::string car;
  std::string vehicle;          ///< learned_danger::vehicle_word
  std::size_t transitions = 0;  ///< in the files
  std::size_t drives = 0;
};

std::string_view words_for(const learned_danger::Experience& experience) {
  return experience.num_obstacles == 1 ? "one obstacle" : "two obstacles";
}

Result<Data> read_data(const std::string& folder, const std::string& root) {
  const auto parts = learned_danger::part_files(folder);
  if (!parts.has_value()) {
    return parts.error();
  }
  Data data;
  world::Footprint body;
  for (const fs::path& path : parts.value()) {
    const auto part = data.car.empty() ? learned_danger::read_part(path)
                                       : learned_danger::read_part_of(path, data.car);
    if (!part.has_value()) {
      return part.error();
    }
    if (data.car.empty()) {
      data.car = part.value().car;
      const auto car = prepare::read_car(fs::path(root) / "data/vehicles" / (data.car + ".toml"));
      if (!car.has_value()) {
        return car.error();
      }
      body = manoeuvre::footprint(car.value());
      data.vehicle = learned_danger::vehicle_word(car.value());
    }
    for (learned_danger::Experience* all : {&data.singles, &data.pairs}) {
      learned_danger::add_experience(*all, part.value().transitions, body);
    }
    data.transitions += part.value().transitions.size();
    data.drives += part.value().transitions.drives;
    if (train_program::is_to_stop()) {
      break;
    }
  }
  for (const learned_danger::Experience* all : {&data.singles, &data.pairs}) {
    if (all->size() == 0) {
      return Error{Error::Code::out_of_range,
                   fmt::format("{}: want situations with {}, got none", folder, words_for(*all))};
    }
  }
  return data;
}

/// Tells of a training, and keeps its curve.
class Curve {
 public:
  std::function<bool(const network_training::DangerProgress&)> of(
      const learned_danger::Experience& experience) {
    fmt::print("{} transitions beside {}\n", experience.size(), words_for(experience));
    std::fflush(stdout);
    return
        [this, obstacles = experience.num_obstacles](const network_training::DangerProgress& now) {
          text_ += fmt::format("{},{},{:.5f},{:.5f},{:.4f},{:.5f},{:.1f}\n", obstacles, now.step,
                               now.v_loss, now.q_loss, now.mean_v, now.above, now.seconds);
          seconds_ += now.seconds;
          fmt::print(
              "step {} of {}: losses {:.4f} and {:.4f}, mean V {:.3f} m, above what was "
              "reached {:.2f} %, {:.0f} s\n",
              now.step, now.steps, now.v_loss, now.q_loss, now.mean_v, 100.0 * now.above, seconds_);
          std::fflush(stdout);
          return !train_program::is_to_stop();
        };
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_ = "obstacles,step,v_loss,q_loss,mean_v_m,above_reached,seconds\n";
  double seconds_ = 0.0;
};

/// Networks of one obstacle or two: V and Q by the data alone, V from outcomes, or Q from V.
class Trainings {
 public:
  /// @param earlier  weights that this is learnt on top of, if any
  Trainings(const Options& options, const Data& data, const formats::Tensors& earlier)
      : options_(options), data_(data), earlier_(earlier) {}

  Result<network_training::DangerNets> singles() {
    return trained(data_.singles, nullptr, options_.plan, state());
  }
  Result<network_training::DangerNets> pairs(network_training::DangerNets& singles) {
    network_training::DangerPlan plan = options_.plan;
    plan.steps = options_.pair_steps;
    return trained(data_.pairs, &singles, plan, pairs_state());
  }
  /// What is shipped of networks.
  void add_to(formats::Tensors& tensors, const network_training::DangerNets& nets,
              const std::string& prefix) const {
    if (options_.values_of.empty()) {
      nets->add_to(tensors, prefix);
    } else {
      nets->v->add_to(tensors, prefix + "v.");
    }
  }
  /// Where they were stopped, all is in there.
  void remove_states() const {
    for (const std::string& each : {state(), pairs_state()}) {
      fs::remove(each);
    }
  }
  [[nodiscard]] const std::string& curve() const { return curve_.text(); }

 private:
  Result<network_training::DangerNets> trained(const learned_danger::Experience& experience,
                                               network_training::DangerNets* singles,
                                               const network_training::DangerPlan& plan,
                                               const std::string& state) {
    if (!options_.q_of.empty()) {
      return network_training::improved_q(experience, network_training::danger_net(earlier_, "v."),
                                          plan, options_.threads, state, curve_.of(experience));
    }
    const auto& learn = options_.values_of.empty() ? network_training::trained_danger
                                                   : network_training::policy_values;
    return learn(experience, singles, plan, options_.threads, state, curve_.of(experience));
  }
  [[nodiscard]] std::string state() const { return options_.output + ".state"; }
  [[nodiscard]] std::string pairs_state() const { return options_.output + ".pairs.state"; }

  const Options& options_;
  const Data& data_;
  const formats::Tensors& earlier_;
  Curve curve_;
};

/// The weights that are learnt on top of; none where there are no such.
Result<formats::Tensors> earlier_weights(const Options& options, const Data& data) {
  const std::string& path = options.earlier();
  if (path.empty()) {
    return formats::Tensors{};
  }
  constexpr std::size_t most_bytes = std::size_t{1} << 30U;
  auto tensors = formats::read_tensor_file(path, most_bytes);
  if (!tensors.has_value()) {
    return tensors.error();
  }
  const auto network = learned_danger::Network::from(tensors.value(), path);
  if (!network.has_value()) {
    return network.error();
  }
  const auto vehicle = tensors.value().words.find("vehicle");
  if (vehicle != tensors.value().words.end() && vehicle->second != data.vehicle) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want weights of the car {} of {}, got of another", path, data.car,
                             options.folder)};
  }
  return tensors;
}

/// What the weights' file says of how they came about.
/// @param earlier  what it said of the weights that are learnt from
std::map<std::string, std::string> words_of(const Options& options, const Data& data,
                                            const std::map<std::string, std::string>& earlier) {
  const bool by_outcomes = !options.values_of.empty();
  const bool improves = !options.q_of.empty();
  const auto word = [&](const char* name) {
    const auto found = earlier.find(name);
    return found != earlier.end() ? found->second : std::string("0");
  };
  return {{"car", data.car},
          {"vehicle", data.vehicle},
          {"transitions", by_outcomes ? word("transitions") : std::to_string(data.transitions)},
          {"drives", by_outcomes ? word("drives") : std::to_string(data.drives)},
          {"outcomes", by_outcomes ? std::to_string(data.drives) : word("outcomes")},
          {"hold_looks",
           by_outcomes ? word("hold_looks") : std::to_string(improves ? options.hold_looks : 1)},
          {"seed", std::to_string(options.plan.seed)},
          {"steps", std::to_string(options.plan.steps)},
          {"pair_steps", std::to_string(options.pair_steps)},
          {"batch", std::to_string(options.plan.batch)},
          {"expectile", options.earlier().empty() ? fmt::format("{}", options.plan.expectile)
                                                  : word("expectile")},
          {"discount", fmt::format("{}", options.plan.discount)}};
}

/// Checks the weights, and writes them and the curve.
std::optional<Error> write_weights(const Options& options, const Data& data,
                                   formats::Tensors& tensors, const std::string& curve) {
  auto words = words_of(options, data, tensors.words);
  tensors.words.clear();
  const auto network = learned_danger::Network::from(tensors, options.output);
  if (!network.has_value()) {
    return network.error();
  }
  words["digest"] = fmt::format("{:016x}", network.value().digest());
  tensors.words = std::move(words);
  if (auto problem = write_file(options.output, formats::tensor_bytes(tensors))) {
    return problem;
  }
  return write_file(options.output + ".curve.csv", curve);
}

int train_danger(const Options& options) {
  auto read = read_data(options.folder, options.root);
  if (!read.has_value()) {
    return train_program::failed(program, read.error());
  }
  Data data = std::move(read).value();
  const auto earlier = earlier_weights(options, data);
  if (!earlier.has_value()) {
    return train_program::failed(program, earlier.error());
  }
  if (train_program::is_to_stop()) {
    return train_program::stopped(program);
  }
  const bool improves = !options.q_of.empty();
  const bool with_pairs = options.pair_steps > 0 && !improves;
  if (improves) {
    learned_danger::keep_held(data.singles, options.hold_looks);
  }
  formats::Tensors tensors = earlier.value();
  Trainings trainings(options, data, earlier.value());
  const auto singles = trainings.singles();
  if (!singles.has_value()) {
    return train_program::failed(program, singles.error());
  }
  if (train_program::is_to_stop()) {
    return train_program::stopped(program);
  }
  network_training::DangerNets nets = singles.value();
  trainings.add_to(tensors, nets, "");
  if (with_pairs) {
    const auto pairs = trainings.pairs(nets);
    if (!pairs.has_value()) {
      return train_program::failed(program, pairs.error());
    }
    if (train_program::is_to_stop()) {
      return train_program::stopped(program);
    }
    trainings.add_to(tensors, pairs.value(), "pair_");
  }
  if (const auto problem = write_weights(options, data, tensors, trainings.curve())) {
    return train_program::failed(program, *problem);
  }
  if (with_pairs || improves) {  // else kept: pairs may yet be learnt on top
    trainings.remove_states();
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  train_program::begin(argv);
  CLI::App app("Trains V_h and Q_h from transitions alone, with libtorch");
  Options options;
  app.add_option("FOLDER", options.folder, "Of the parts that `saca danger dataset` made")
      ->required();
  app.add_option("--output", options.output, "safetensors file of the weights")->required();
  app.add_option("--values-of", options.values_of,
                 "Earlier weights; FOLDER is of `saca danger dataset --by THESE --outcomes`, and V "
                 "becomes what such drives came to");
  app.add_option(
         "--q-of", options.q_of,
         "Earlier weights; Q becomes what an input that is held for a while and then their V come "
         "to, from transitions of any drivers")
      ->excludes("--values-of");
  app.add_option("--hold-looks", options.hold_looks,
                 "With --q-of: Q is of an input that is held for so many looks of 0.1 s")
      ->check(CLI::Range(1, 20))
      ->capture_default_str();
  app.add_option("--root", options.root, "Holds data/")->capture_default_str();
  app.add_option("--seed", options.plan.seed)->capture_default_str();
  app.add_option("--steps", options.plan.steps)
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  app.add_option("--pair-steps", options.pair_steps,
                 "Likewise, of what two obstacles add; 0, or with --q-of: it is not learnt")
      ->check(CLI::Range(0, 10'000'000))
      ->capture_default_str();
  app.add_option("--batch", options.plan.batch, "Transitions in a step")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  app.add_option("--expectile", options.plan.expectile, "Of V at the end, in (0.5, 1)")
      ->check(CLI::Range(0.5, 0.9999))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return train_danger(options);
}
