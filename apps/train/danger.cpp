// saca-train-danger: from the transitions of `saca danger dataset` to the weights of V_h and Q_h.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saca/core/file.h"
#include "saca/core/parallel.h"
#include "saca/core/standard_files.h"
#include "saca/danger/experience.h"
#include "saca/danger/transition_file.h"
#include "saca/manoeuvre/ego.h"
#include "saca/train/blas.h"
#include "saca/train/danger_training.h"

namespace {

namespace fs = std::filesystem;
using namespace saca;

volatile std::sig_atomic_t is_to_end = 0;

struct Options {
  std::string folder;
  std::string output;
  std::string root = ".";
  int threads = usual_threads();
  train::DangerPlan plan;
};

/// What was read, and what the weights' file says of it.
struct Data {
  danger::Experience singles{.num_obstacles = 1};
  danger::Experience pairs{.num_obstacles = 2};
  std::string car;
  std::size_t transitions = 0;  ///< in the files
  std::size_t drives = 0;
};

Result<std::vector<fs::path>> parts_in(const fs::path& folder) {
  std::vector<fs::path> parts;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".h5") {
      parts.push_back(entry.path());
    }
  }
  std::sort(parts.begin(), parts.end());
  if (parts.empty()) {
    return Error{Error::Code::unreadable,
                 folder.string() +
                     ": want a folder with parts of a data set (*.h5), as `saca "
                     "danger dataset` makes them"};
  }
  return parts;
}

std::string_view words_for(const danger::Experience& experience) {
  return experience.num_obstacles == 1 ? "one obstacle" : "two obstacles";
}

Result<Data> read_data(const Options& options) {
  const auto parts = parts_in(options.folder);
  if (!parts.has_value()) {
    return parts.error();
  }
  Data data;
  world::Footprint body;
  for (const fs::path& path : parts.value()) {
    const auto part = danger::read_part(path);
    if (!part.has_value()) {
      return part.error();
    }
    if (data.car.empty()) {
      data.car = part.value().car;
      const auto car =
          manoeuvre::read_car(fs::path(options.root) / "data/vehicles" / (data.car + ".toml"));
      if (!car.has_value()) {
        return car.error();
      }
      body = manoeuvre::footprint(car.value());
    }
    if (part.value().car != data.car) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: car: want {} as in the other parts, got {}", path.string(),
                               data.car, part.value().car)};
    }
    for (danger::Experience* all : {&data.singles, &data.pairs}) {
      danger::add_experience(*all, part.value().transitions, body);
    }
    data.transitions += part.value().transitions.size();
    data.drives += part.value().transitions.drives;
    if (is_to_end != 0) {
      break;
    }
  }
  for (const danger::Experience* all : {&data.singles, &data.pairs}) {
    if (all->size() == 0) {
      return Error{Error::Code::out_of_range, fmt::format("{}: want situations with {}, got none",
                                                          options.folder, words_for(*all))};
    }
  }
  return data;
}

int give_up(const Error& error) {
  fmt::print(stderr, "saca-train-danger: error: {}\n", error.message);
  constexpr int bad_input = 3;
  constexpr int cannot_write = 4;
  return error.code == Error::Code::unwritable ? cannot_write : bad_input;
}

/// Tells of a training, and keeps its curve.
class Curve {
 public:
  explicit Curve(const train::DangerPlan& plan) : plan_(plan) {}

  std::function<bool(const train::DangerProgress&)> of(const danger::Experience& experience) {
    fmt::print("{} transitions beside {}\n", experience.size(), words_for(experience));
    std::fflush(stdout);
    return [this, obstacles = experience.num_obstacles](const train::DangerProgress& now) {
      text_ += fmt::format("{},{},{:.5f},{:.5f},{:.4f},{:.5f},{:.1f}\n", obstacles, now.step,
                           now.v_loss, now.q_loss, now.mean_v, now.above, now.seconds);
      seconds_ += now.seconds;
      fmt::print(
          "step {} of {}: losses {:.4f} and {:.4f}, mean V {:.3f} m, above what was "
          "reached {:.2f} %, {:.0f} s\n",
          now.step, plan_.steps, now.v_loss, now.q_loss, now.mean_v, 100.0 * now.above, seconds_);
      std::fflush(stdout);
      return is_to_end == 0;
    };
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  const train::DangerPlan& plan_;
  std::string text_ = "obstacles,step,v_loss,q_loss,mean_v_m,above_reached,seconds\n";
  double seconds_ = 0.0;
};

int stopped() {
  fmt::print(stderr, "saca-train-danger: stopped; the same command goes on from here\n");
  constexpr int interrupted = 130;
  return interrupted;
}

int train_danger(const Options& options) {
  const auto read = read_data(options);
  if (!read.has_value()) {
    return give_up(read.error());
  }
  if (is_to_end != 0) {
    return stopped();
  }
  const Data& data = read.value();
  Curve curve(options.plan);
  const std::string state = options.output + ".state";
  const std::string pairs_state = options.output + ".pairs.state";
  auto singles = train::trained_danger(data.singles, options.plan, options.threads, state,
                                       curve.of(data.singles));
  if (!singles.has_value()) {
    return give_up(singles.error());
  }
  if (is_to_end != 0) {
    return stopped();
  }
  train::DangerNets nets = singles.value();
  const auto pairs = train::trained_pairs(data.pairs, nets, options.plan, options.threads,
                                          pairs_state, curve.of(data.pairs));
  if (!pairs.has_value()) {
    return give_up(pairs.error());
  }
  if (is_to_end != 0) {
    return stopped();
  }
  config::Tensors tensors;
  nets->add_to(tensors, "");
  pairs.value()->add_to(tensors, "pair_");
  tensors.words = {{"car", data.car},
                   {"transitions", std::to_string(data.transitions)},
                   {"drives", std::to_string(data.drives)},
                   {"seed", std::to_string(options.plan.seed)},
                   {"steps", std::to_string(options.plan.steps)},
                   {"batch", std::to_string(options.plan.batch)},
                   {"expectile", fmt::format("{}", options.plan.expectile)},
                   {"discount", fmt::format("{}", options.plan.discount)}};
  for (const auto& [path, text] : {std::pair{options.output, config::tensor_bytes(tensors)},
                                   std::pair{options.output + ".curve.csv", curve.text()}}) {
    if (const auto problem = write_file(path, text)) {
      return give_up(*problem);
    }
  }
  fs::remove(state);
  fs::remove(pairs_state);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  saca::train::give_each_thread_its_own_products(argv);
  saca::occupy_standard_files();
  CLI::App app("Trains V_h and Q_h from transitions alone, with libtorch");
  Options options;
  app.add_option("FOLDER", options.folder, "Of the parts that `saca danger dataset` made")
      ->required();
  app.add_option("--output", options.output, "safetensors file of the weights")->required();
  app.add_option("--root", options.root, "Holds data/")->capture_default_str();
  app.add_option("--seed", options.plan.seed)->capture_default_str();
  app.add_option("--steps", options.plan.steps)
      ->check(CLI::Range(1, 10'000'000))
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
  std::signal(SIGINT, [](int) { is_to_end = 1; });
  torch::set_num_threads(1);  // each half of a batch by itself: the same bytes each time
  return train_danger(options);
}
