// saca-train-imitator: from cases to the weights that imitate what was best in them
// (eval/imitator.h).
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/train/program.h"
#include "saca/base/core/fnv.h"
#include "saca/base/formats/compressed_text.h"
#include "saca/lab/eval/transfer.h"
#include "saca/lab/network_training/imitator_net.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/experience.h"

namespace {

namespace fs = std::filesystem;
using namespace saca;

constexpr std::string_view program = "saca-train-imitator";

struct Options {
  std::string cases;
  std::string output;
  double dropout = 0.2;
  network_training::Schedule schedule{.seed = 1, .epochs = 200, .batch = 256, .step = 2e-3};
};

constexpr std::size_t many_bytes = std::size_t{1} << 30U;

/// One in so many encounters is not learnt from but watched.
constexpr std::uint64_t held_out_share = 8;

/// An encounter and its twin without risk belong together.
bool is_held_out(const memory::Case& one) {
  Fnv hash;
  hash.add(eval::encounter_of(one));
  return hash.value() % held_out_share == 0;
}

/// How often the likeliest policy is the one that was the best, and as good as the best.
struct Right {
  double best = 0.0;
  double as_good = 0.0;
};
Right right_in(const eval::Imitator& imitator, const std::vector<memory::Case>& cases) {
  Right right;
  for (const memory::Case& one : cases) {
    const manoeuvre::PolicyId choice = imitator.choice(one.scene);
    right.best += choice == one.best ? 1.0 : 0.0;
    right.as_good +=
        one.happened && memory::as_good_as_best(*one.happened).test(manoeuvre::index(choice)) ? 1.0
                                                                                              : 0.0;
  }
  right.best /= static_cast<double>(cases.size());
  right.as_good /= static_cast<double>(cases.size());
  return right;
}

/// Cases to show, and others that are held out.
struct Lessons {
  std::vector<memory::Case> shown;
  std::vector<memory::Case> watched;
};

Result<Lessons> read_lessons(const std::string& file) {
  const auto text = formats::read_compressed(file, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  auto read = memory::cases_from_text(text.value(), file);
  if (!read.has_value()) {
    return read.error();
  }
  Lessons lessons;
  for (memory::Case& one : std::move(read).value()) {
    (is_held_out(one) ? lessons.watched : lessons.shown).push_back(std::move(one));
  }
  if (lessons.shown.empty() || lessons.watched.empty()) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want cases of several encounters, to show and to watch by, got "
                             "{} and {}",
                             file, lessons.shown.size(), lessons.watched.size())};
  }
  return lessons;
}

int train_imitator(const Options& options) {
  const auto lessons = read_lessons(options.cases);
  if (!lessons.has_value()) {
    return train_program::failed(program, lessons.error());
  }
  const auto& [shown, watched] = lessons.value();
  fmt::print("{} cases to train with, {} held out\n", shown.size(), watched.size());
  std::fflush(stdout);
  std::string curve = "epoch,training_loss,held_out_loss\n";
  const std::string state = options.output + ".state";
  const auto network = network_training::trained_imitator(
      network_training::imitator_pieces(shown), network_training::imitator_pieces(watched),
      options.schedule, options.dropout, state, [&](const network_training::Epoch& now) {
        const double other = now.held_out.value_or(std::nan(""));
        curve += fmt::format("{},{:.5f},{:.5f}\n", now.number, now.loss, other);
        return train_program::show_epoch(now, options.schedule.epochs);
      });
  if (!network.has_value()) {
    return train_program::failed(program, network.error());
  }
  if (train_program::is_to_stop()) {
    return train_program::stopped(program);
  }
  formats::Tensors tensors = network.value()->tensors();
  const auto imitator = eval::Imitator::from(tensors, options.output);
  if (!imitator.has_value()) {
    return train_program::failed(program, imitator.error());
  }
  const Right held_out = right_in(imitator.value(), watched);
  tensors.words = {{"cases", std::to_string(shown.size())},
                   {"seed", std::to_string(options.schedule.seed)},
                   {"epochs", std::to_string(options.schedule.epochs)},
                   {"held_out", std::to_string(watched.size())},
                   {"held_out_right", fmt::format("{:.4f}", held_out.best)},
                   {"held_out_as_good", fmt::format("{:.4f}", held_out.as_good)},
                   {"digest", fmt::format("{:016x}", imitator.value().digest())}};
  if (const auto problem = train_program::write_trained(options.output, tensors, curve)) {
    return train_program::failed(program, *problem);
  }
  fs::remove(state);
  fmt::print(
      "of the cases held out the best in {:.1f} %, as good as it in {:.1f} %; of the others "
      "the best in {:.1f} %\n",
      100.0 * held_out.best, 100.0 * held_out.as_good,
      100.0 * right_in(imitator.value(), shown).best);
  return train_program::success;
}

}  // namespace

int main(int argc, char** argv) {
  train_program::begin(argv);
  CLI::App app("Trains what imitates the best choices of cases: behaviour cloning, with libtorch");
  Options options;
  app.add_option("cases", options.cases, "What `saca memory build` or `export` wrote")->required();
  app.add_option("--output", options.output, "safetensors file of the weights")->required();
  app.add_option("--seed", options.schedule.seed)->capture_default_str();
  app.add_option("--epochs", options.schedule.epochs)
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return train_imitator(options);
}
