// saca-train: from labelled sequences to the weights of the intention model.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "saca/core/file.h"
#include "saca/core/fnv.h"
#include "saca/core/parallel.h"
#include "saca/core/standard_files.h"
#include "saca/intent/model.h"
#include "saca/learn/foretell.h"
#include "saca/learn/sequence_file.h"
#include "saca/learn/split.h"
#include "saca/train/training.h"

namespace {

namespace fs = std::filesystem;
using namespace saca;
using learn::Sequence;

volatile std::sig_atomic_t was_told_to_stop = 0;

struct Options {
  std::string sequences;
  std::string output;
  std::string leave_out;
  int networks = 1;
  train::TrainingPlan plan;
};

/// What a model may see, and what it is calibrated on.
struct Data {
  std::vector<Sequence> training;
  std::vector<Sequence> calibration;
};

constexpr int calibration_share = 8;  // one group in so many of those recorded

Result<Data> read_data(const Options& options) {
  auto read = learn::read_sequences(options.sequences);
  if (!read.has_value()) {
    return read.error();
  }
  learn::SequenceSet set = std::move(read).value();
  std::vector<Sequence> recorded;
  Data data;
  std::size_t num_left_out = 0;
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    Sequence& sequence = set.sequences[i];
    if (set.splits[i] == "test" || set.splits[i] == options.leave_out ||
        sequence.site == options.leave_out) {
      ++num_left_out;
    } else {
      (sequence.simulated ? data.training : recorded).push_back(std::move(sequence));
    }
  }
  if (!options.leave_out.empty() && num_left_out == 0) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: --leave-out: want a split or a site of "
                             "the file, got {}",
                             options.sequences, options.leave_out)};
  }
  learn::Split split = learn::split_off(std::move(recorded), 0, calibration_share);
  data.calibration = std::move(split.part);
  for (Sequence& each : split.rest) {
    data.training.push_back(std::move(each));
  }
  if (data.training.empty() || data.calibration.empty()) {
    return Error{Error::Code::out_of_range,
                 options.sequences + ": want recorded sequences of several groups to train with"};
  }
  return data;
}

int fail(const Error& error) {
  fmt::print(stderr, "saca-train: error: {}\n", error.message);
  constexpr int bad_input = 3;
  constexpr int cannot_write = 4;
  return error.code == Error::Code::unwritable ? cannot_write : bad_input;
}

/// The tensors with the sharpness that suits the calibration's labels, and words on where they come
/// from.
Result<config::Tensors> calibrated(const Options& options, const Data& data,
                                   const std::vector<train::LstmCrf>& networks) {
  config::Tensors tensors = train::model_tensors(networks);
  const auto model = intent::model_from(tensors, options.output);
  if (!model.has_value()) {
    return model.error();
  }
  const auto forecasts = learn::foretold(model.value(), data.calibration, usual_threads());
  const auto sharpness = learn::best_sharpness(data.calibration, forecasts);
  for (std::size_t h = 0; h < sharpness.size(); ++h) {
    tensors.tensors["sharpness"].values[h] = static_cast<float>(sharpness[h]);
  }
  const auto bytes = read_file(options.sequences, many_bytes);
  Fnv digest;
  digest.add(bytes.has_value() ? std::string_view(bytes.value()) : std::string_view());
  tensors.words = {{"left_out", options.leave_out.empty() ? "nothing" : options.leave_out},
                   {"sequences", fmt::format("{:016x}", digest.value())},
                   {"seed", std::to_string(options.plan.seed)},
                   {"epochs", std::to_string(options.plan.epochs)}};
  return tensors;
}

int train_model(const Options& options) {
  auto read = read_data(options);
  if (!read.has_value()) {
    return fail(read.error());
  }
  const Data data = std::move(read).value();
  fmt::print("{} sequences to train with, {} to calibrate with\n", data.training.size(),
             data.calibration.size());
  std::vector<train::LstmCrf> networks;
  std::string curve = "network,epoch,training_loss,calibration_loss,seconds\n";
  for (int i = 0; i < options.networks; ++i) {
    train::TrainingPlan plan = options.plan;
    plan.seed = options.plan.seed + static_cast<std::uint64_t>(i);
    const fs::path state = fmt::format("{}.network{}.state", options.output, i);
    auto network =
        train::trained(data.training, data.calibration, plan, state, [&](const train::Epoch& now) {
          const double held_out = now.held_out.value_or(std::nan(""));
          curve += fmt::format("{},{},{:.5f},{:.5f},{:.1f}\n", i, now.number, now.loss, held_out,
                               now.seconds);
          fmt::print(
              "network {} of {}, epoch {} of {}: loss {:.4f}, calibration {:.4f}, {:.1f} s\n",
              i + 1, options.networks, now.number, plan.epochs, now.loss, held_out, now.seconds);
          std::fflush(stdout);
          return was_told_to_stop == 0;
        });
    if (!network.has_value()) {
      return fail(network.error());
    }
    if (was_told_to_stop != 0) {
      fmt::print(stderr, "saca-train: stopped; the same command goes on from here\n");
      constexpr int interrupted = 130;
      return interrupted;
    }
    networks.push_back(network.value());
  }
  const auto tensors = calibrated(options, data, networks);
  if (!tensors.has_value()) {
    return fail(tensors.error());
  }
  if (const auto problem = write_file(options.output, config::tensor_bytes(tensors.value()))) {
    return fail(*problem);
  }
  if (const auto problem = write_file(options.output + ".curve.csv", curve)) {
    return fail(*problem);
  }
  for (int i = 0; i < options.networks; ++i) {
    fs::remove(fmt::format("{}.network{}.state", options.output, i));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  saca::occupy_standard_files();
  CLI::App app("Trains the model of intentions: an LSTM-CRF, with libtorch");
  Options options;
  app.add_option("sequences", options.sequences, "HDF5 file of `saca intent examples`")->required();
  app.add_option("--output", options.output, "safetensors file of the weights")->required();
  app.add_option("--leave-out", options.leave_out,
                 "A split or a site of the file that is not to be seen");
  app.add_option("--networks", options.networks, "Trained from seeds one after the other")
      ->check(CLI::Range(1, static_cast<int>(intent::Model::max_networks)))
      ->capture_default_str();
  app.add_option("--seed", options.plan.seed)->capture_default_str();
  app.add_option("--epochs", options.plan.epochs)
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  app.add_flag("!--without-chain", options.plan.with_chain,
               "Train each frame for itself: the LSTM without the CRF, for comparison");
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGINT, [](int) { was_told_to_stop = 1; });
  torch::set_num_threads(1);  // the same bytes each time; two trainings side by side use both cores
  return train_model(options);
}
