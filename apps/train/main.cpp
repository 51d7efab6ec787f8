// saca-train: from labelled sequences to the weights of the intention model.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/train/program.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/intention_scoring/calibration.h"
#include "saca/lab/intention_scoring/evaluation.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/lab/network_training/lessons.h"
#include "saca/lab/network_training/training.h"
#include "saca/thinking/intent/model.h"

namespace {

namespace fs = std::filesystem;
using namespace saca;
using intention_scoring::Sequence;

constexpr std::string_view program = "saca-train";

struct Options {
  std::string sequences;
  std::string output;
  std::string calibrate;
  std::string leave_out;
  std::string teachers;
  double taught_share = network_training::Lessons().share;
  int networks = 1;
  network_training::TrainingPlan plan;
};

/// What a model may see, and what it is judged on while it learns.
struct Data {
  std::vector<Sequence> training;
  std::vector<Sequence> held_out;
  network_training::Lessons lessons;
};

Result<Data> read_data(const Options& options) {
  auto read = intention_scoring::read_sequences(options.sequences);
  if (!read.has_value()) {
    return read.error();
  }
  intention_scoring::SequenceSet set = std::move(read).value();
  Data data;
  std::vector<Sequence> simulated_test;
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    Sequence& sequence = set.sequences[i];
    if (set.splits[i] == options.leave_out || sequence.site == options.leave_out) {
      data.held_out.push_back(std::move(sequence));
    } else {
      (set.splits[i] == "test" ? simulated_test : data.training).push_back(std::move(sequence));
    }
  }
  if (!options.leave_out.empty() && data.held_out.empty()) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: --leave-out: want a split or a site of "
                             "the file, got {}",
                             options.sequences, options.leave_out)};
  }
  if (data.training.empty()) {
    return Error{Error::Code::out_of_range, options.sequences + ": want sequences to train with"};
  }
  if (options.leave_out.empty()) {
    data.held_out = std::move(simulated_test);
  }
  if (!options.teachers.empty()) {
    auto lessons = network_training::read_lessons(options.teachers, data.training, data.held_out);
    if (!lessons.has_value()) {
      return lessons.error();
    }
    data.lessons = std::move(lessons).value();
    data.lessons.share = options.taught_share;
  }
  return data;
}

std::string digest_of(const std::string& path) {
  const auto bytes = read_file(path, many_bytes);
  Fnv digest;
  digest.add(bytes.has_value() ? std::string_view(bytes.value()) : std::string_view());
  return fmt::format("{:016x}", digest.value());
}

/// The tensors, with words on where they come from.
formats::Tensors described(const Options& options, formats::Tensors tensors) {
  tensors.words = {{"left_out", options.leave_out.empty() ? "nothing" : options.leave_out},
                   {"sequences", digest_of(options.sequences)},
                   {"seed", std::to_string(options.plan.seed)},
                   {"epochs", std::to_string(options.plan.epochs)}};
  if (!options.teachers.empty()) {
    tensors.words["taught_share"] = fmt::format("{}", options.taught_share);
    tensors.words["teachers"] = digest_of(options.teachers);
  }
  if (options.plan.speed_noise > 0.0) {
    tensors.words["speed_noise_mps"] = fmt::format("{}", options.plan.speed_noise);
  }
  return tensors;
}

/// A model's file.
struct ModelFile {
  fs::path path;
  formats::Tensors tensors;
  std::string left_out;
};

Result<std::vector<ModelFile>> read_model_files(const fs::path& folder) {
  std::vector<ModelFile> files;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    if (entry.path().extension() != ".safetensors") {
      continue;
    }
    auto tensors = formats::read_tensor_file(entry.path(), many_bytes);
    if (!tensors.has_value()) {
      return tensors.error();
    }
    ModelFile file{.path = entry.path(), .tensors = std::move(tensors).value(), .left_out = {}};
    file.left_out = file.tensors.words["left_out"];
    files.push_back(std::move(file));
  }
  if (files.empty()) {
    return Error{Error::Code::unreadable, folder.string() + ": want a folder with models"};
  }
  return files;
}

/// Of the recorded sequences, what models without calibration predict that have not seen them.
Result<std::vector<intention_scoring::Forecasts>> unseen_forecasts(
    std::vector<ModelFile> files, std::span<const Sequence> recorded,
    std::span<const std::string> splits) {
  intention_scoring::ModelsByLeftOut models;
  for (ModelFile& file : files) {
    network_training::set_calibrations(file.tensors, {});
    auto model = intent::model_from(file.tensors, file.path.string());
    if (!model.has_value()) {
      return model.error();
    }
    models.emplace(file.left_out, std::move(model).value());
  }
  return intention_scoring::predicted_unseen(models, recorded, splits, usual_threads());
}

/// Calibrates each model of a folder on what models that had left a split out predict of it: on
/// all splits but the one, or sequences of all sites but the one, that it has left out itself.
int calibrate_models(const Options& options) {
  const auto set = intention_scoring::read_sequences(options.sequences);
  if (!set.has_value()) {
    return train_program::failed(program, set.error());
  }
  std::vector<Sequence> recorded;
  std::vector<std::string> splits;
  for (std::size_t i = 0; i < set.value().sequences.size(); ++i) {
    if (!set.value().sequences[i].simulated) {
      recorded.push_back(set.value().sequences[i]);
      splits.push_back(set.value().splits[i]);
    }
  }
  auto read = read_model_files(options.calibrate);
  if (!read.has_value()) {
    return train_program::failed(program, read.error());
  }
  std::vector<ModelFile> files = std::move(read).value();
  const auto forecasts = unseen_forecasts(files, recorded, splits);
  if (!forecasts.has_value()) {
    return train_program::failed(program, forecasts.error());
  }
  for (ModelFile& file : files) {
    std::vector<Sequence> sequences;
    std::vector<intention_scoring::Forecasts> of_them;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      if (splits[i] != file.left_out && recorded[i].site != file.left_out) {
        sequences.push_back(recorded[i]);
        of_them.push_back(forecasts.value()[i]);
      }
    }
    network_training::set_calibrations(file.tensors,
                                       intention_scoring::best_calibrations(sequences, of_them));
    if (const auto problem = write_file(file.path, formats::tensor_bytes(file.tensors))) {
      return train_program::failed(program, *problem);
    }
    fmt::print("{}: calibrated on {} sequences\n", file.path.filename().string(), sequences.size());
  }
  return 0;
}

int train_model(const Options& options) {
  auto read = read_data(options);
  if (!read.has_value()) {
    return train_program::failed(program, read.error());
  }
  const Data data = std::move(read).value();
  fmt::print("{} sequences to train with, {} held out\n", data.training.size(),
             data.held_out.size());
  std::vector<network_training::LstmCrf> networks;
  std::string curve = "network,epoch,training_loss,held_out_loss,seconds\n";
  for (int i = 0; i < options.networks; ++i) {
    network_training::TrainingPlan plan = options.plan;
    plan.seed = options.plan.seed + static_cast<std::uint64_t>(i);
    const fs::path state = fmt::format("{}.network{}.state", options.output, i);
    auto network = network_training::trained(
        data.training, data.held_out, plan, state,
        [&](const network_training::Epoch& now) {
          const double held_out = now.held_out.value_or(std::nan(""));
          curve += fmt::format("{},{},{:.5f},{:.5f},{:.1f}\n", i, now.number, now.loss, held_out,
                               now.seconds);
          fmt::print("network {} of {}, epoch {} of {}: loss {:.4f}, held out {:.4f}, {:.1f} s\n",
                     i + 1, options.networks, now.number, plan.epochs, now.loss, held_out,
                     now.seconds);
          std::fflush(stdout);
          return !train_program::is_to_stop();
        },
        data.lessons);
    if (!network.has_value()) {
      return train_program::failed(program, network.error());
    }
    if (train_program::is_to_stop()) {
      return train_program::stopped(program);
    }
    networks.push_back(network.value());
  }
  const formats::Tensors tensors = described(options, network_training::model_tensors(networks));
  if (const auto problem = train_program::write_trained(options.output, tensors, curve)) {
    return train_program::failed(program, *problem);
  }
  for (int i = 0; i < options.networks; ++i) {
    fs::remove(fmt::format("{}.network{}.state", options.output, i));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  train_program::begin(argv);
  CLI::App app("Trains the model of intentions: an LSTM-CRF, with libtorch");
  Options options;
  app.add_option("sequences", options.sequences, "HDF5 file of `saca intent examples`")->required();
  CLI::Option* const output =
      app.add_option("--output", options.output, "safetensors file of the weights");
  CLI::Option* const calibrate = app.add_option("--calibrate", options.calibrate,
                                                "Train nothing, but calibrate all models of this "
                                                "folder, one of which has left out each split");
  output->excludes(calibrate);
  app.add_option("--leave-out", options.leave_out,
                 "A split or a site of the file that is not to be seen");
  CLI::Option* const teachers = app.add_option(
      "--teachers", options.teachers,
      "HDF5 file of forecasts by models that have seen neither the sequence nor what is left out: "
      "learn from them as well");
  app.add_option("--taught-share", options.taught_share,
                 "Of the teachers in what a label is taken for")
      ->check(CLI::Range(0.0, 1.0))
      ->needs(teachers)
      ->capture_default_str();
  app.add_option("--networks", options.networks, "Trained from seeds one after the other")
      ->check(CLI::Range(1, static_cast<int>(intent::Model::max_networks)))
      ->capture_default_str();
  app.add_option("--seed", options.plan.seed)->capture_default_str();
  app.add_option("--epochs", options.plan.epochs)
      ->check(CLI::Range(1, 1'000))
      ->capture_default_str();
  app.add_option(
         "--speed-noise-mps", options.plan.speed_noise,
         "The most noise that a piece's speed is given, root mean square, for sites never seen")
      ->check(CLI::Range(0.0, 5.0))
      ->capture_default_str();
  app.add_flag_callback(
      "--without-chain", [&options] { options.plan.chain = saca::network_training::Chain::none; },
      "Train each frame for itself: the LSTM without the CRF, for comparison");
  CLI11_PARSE(app, argc, argv);
  if (!options.calibrate.empty()) {
    return calibrate_models(options);
  }
  if (options.output.empty()) {
    return train_program::failed(program,
                                 {Error::Code::out_of_range, "want --output or --calibrate"});
  }
  return train_model(options);
}
