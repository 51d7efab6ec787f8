// saca-train: from sets of recorded traffic to the weights of the intention model.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saca/core/file.h"
#include "saca/core/parallel.h"
#include "saca/intent/model.h"
#include "saca/learn/examples.h"
#include "saca/learn/foretell.h"
#include "saca/learn/score.h"
#include "saca/learn/simulated.h"
#include "saca/learn/split.h"
#include "saca/traffic/set_file.h"
#include "saca/train/training.h"

namespace fs = std::filesystem;
using namespace saca;

namespace {

struct Options {
  std::vector<std::string> sets;
  std::size_t simulated = 1500;
  std::uint64_t seed = 1;
  int networks = 1;
  int parts = 5;
  std::optional<int> test_part;
  std::string test_site;
  std::string output;
  std::string state;
  train::TrainingPlan plan;
};

std::vector<learn::Sequence> joined(std::vector<learn::Sequence> a,
                                    std::vector<learn::Sequence> b) {
  a.insert(a.end(), std::make_move_iterator(b.begin()), std::make_move_iterator(b.end()));
  return a;
}

void show_scores(const char* what, const intent::Model& model,
                 const std::vector<learn::Sequence>& sequences) {
  const auto forecasts = learn::foretold(model, sequences, usual_threads());
  for (std::size_t head = 0; head < learn::num_heads; ++head) {
    learn::Tally sum;
    for (std::size_t i = 0; i < sequences.size(); ++i) {
      sum += learn::tally(sequences[i], forecasts[i], head);
    }
    fmt::print("{} head {}: macro F1 {:.3f}, log loss {:.3f}, ECE {:.3f} |", what, head,
               sum.confusion.macro_f1(learn::recorded_classes).value_or(0.0),
               sum.mean_log_loss().value_or(0.0), sum.top_calibration_error().value_or(0.0));
    for (std::size_t k = 0; k < learn::num_vehicle_classes; ++k) {
      fmt::print(" {:.2f}/{}", sum.confusion.f1(k).value_or(0.0), sum.confusion.truly(k));
    }
    fmt::print("\n");
  }
}

int fail(const Error& error) {
  fmt::print(stderr, "saca-train: error: {}\n", error.message);
  return 1;
}

int train_intent(const Options& options) {
  std::vector<learn::Sequence> recorded;
  for (const std::string& path : options.sets) {
    const auto set = traffic::read_set(path);
    if (!set.has_value()) {
      return fail(set.error());
    }
    recorded = joined(std::move(recorded), learn::examples_of(set.value()));
  }
  std::vector<learn::Sequence> test;
  if (options.test_part) {
    auto split = learn::split_off(std::move(recorded), *options.test_part, options.parts);
    test = std::move(split.part);
    recorded = std::move(split.rest);
  }
  auto split = learn::split_off(std::move(recorded), 0, 8);
  const auto held_out = std::move(split.part);
  const auto simulated =
      learn::simulated_sequences(options.simulated, options.seed, usual_threads());
  const auto all = joined(std::move(split.rest), simulated);
  fmt::print("{} sequences, {} held out, {} for the test\n", all.size(), held_out.size(),
             test.size());
  std::vector<train::LstmCrf> networks;
  for (int i = 0; i < options.networks; ++i) {
    train::TrainingPlan plan = options.plan;
    plan.seed = options.seed + static_cast<std::uint64_t>(i);
    const fs::path state =
        options.state.empty() ? fs::path() : fs::path(options.state + "." + std::to_string(i));
    auto network = train::trained(all, held_out, plan, state, [&](const train::Epoch& epoch) {
      fmt::print("network {} epoch {}: loss {:.4f}, held out {:.4f}, {:.1f} s\n", i, epoch.number,
                 epoch.loss, epoch.held_out.value_or(0.0), epoch.seconds);
      std::fflush(stdout);
      return true;
    });
    if (!network.has_value()) {
      return fail(network.error());
    }
    networks.push_back(network.value());
  }
  config::Tensors tensors = train::model_tensors(networks);
  auto model = intent::model_from(tensors, "model");
  if (!model.has_value()) {
    return fail(model.error());
  }
  intent::Model calibrated = std::move(model).value();
  calibrated.sharpness =
      learn::best_sharpness(held_out, learn::foretold(calibrated, held_out, usual_threads()));
  fmt::print("sharpness {:.3f} {:.3f} {:.3f}\n", calibrated.sharpness[0], calibrated.sharpness[1],
             calibrated.sharpness[2]);
  for (std::size_t h = 0; h < intent::num_horizons; ++h) {
    tensors.tensors["sharpness"].values[h] = static_cast<float>(calibrated.sharpness[h]);
  }
  show_scores("held out", calibrated, held_out);
  if (!test.empty()) {
    show_scores("test", calibrated, test);
  }
  show_scores("simulated", calibrated, simulated);
  if (!options.output.empty()) {
    if (const auto problem = write_file(options.output, config::tensor_bytes(tensors))) {
      return fail(*problem);
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Trains the model of intentions");
  Options options;
  app.add_option("sets", options.sets, "HDF5 sets of recorded traffic")->required();
  app.add_option("--simulated", options.simulated);
  app.add_option("--seed", options.seed);
  app.add_option("--networks", options.networks);
  app.add_option("--parts", options.parts);
  app.add_option("--test-part", options.test_part);
  app.add_option("--output", options.output);
  app.add_option("--state", options.state);
  app.add_option("--epochs", options.plan.epochs);
  app.add_option("--step", options.plan.step);
  app.add_option("--decay", options.plan.decay);
  app.add_option("--dropout", options.plan.dropout);
  app.add_option("--filtered-share", options.plan.filtered_share);
  CLI11_PARSE(app, argc, argv);
  torch::set_num_threads(1);
  return train_intent(options);
}
