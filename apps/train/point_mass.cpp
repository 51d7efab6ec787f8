// saca-train-point-mass: how far learning gets where V_h is known: beside an exact table, fitted
// iteration with known dynamics, and learning from data alone, as saca-train-danger does it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "apps/train/program.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/learned_danger/experience.h"
#include "saca/lab/learned_danger/point_mass.h"
#include "saca/lab/network_training/danger_training.h"
#include "saca/lab/verification/authors_comparison.h"
#include "saca/thinking/danger/value_table.h"

namespace {

namespace fs = std::filesystem;
using namespace saca;
using nlohmann::json;

constexpr std::string_view program = "saca-train-point-mass";

struct Options {
  std::string table;
  std::string output;
  int drives = 200'000;
  int states = 300'000;
  int threads = usual_threads();
  network_training::DangerPlan plan;
};

/// Prints the points of a curve, and keeps them as a table.
class Curve {
 public:
  explicit Curve(std::string name) : name_(std::move(name)) {}

  bool add(const network_training::DangerProgress& now) {
    seconds_ += now.seconds;
    text_ += fmt::format("{},{:.5f},{:.5f},{:.4f},{:.1f}\n", now.step, now.v_loss, now.q_loss,
                         now.mean_v, now.seconds);
    fmt::print("{}: step {} of {}: losses {:.4f} and {:.4f}, mean V {:.3f} m, {:.0f} s\n", name_,
               now.step, now.steps, now.v_loss, now.q_loss, now.mean_v, seconds_);
    std::fflush(stdout);
    return !train_program::is_to_stop();
  }
  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string name_;
  double seconds_ = 0.0;
  std::string text_ = "step,v_loss,q_loss,mean_v_m,seconds\n";
};

/// What can be told of values beside the exact ones.
json figures_of(const learned_danger::ExactPointMass& exact, const danger::ValueAt& value,
                const learned_danger::Values& values) {
  json all;
  constexpr int states = 100'000;
  for (const double fastest : {18.0, 30.0}) {
    const learned_danger::ValueErrors errors =
        learned_danger::value_errors(exact.problem, value, values, fastest, states, 1);
    all[fmt::format("up_to_{:g}mps", fastest)] = {{"states", errors.states},
                                                  {"mean_error_m", errors.mean_size},
                                                  {"p99_error_m", errors.p99_size},
                                                  {"bias_m", errors.bias},
                                                  {"same_sign", errors.same_sign}};
  }
  return all;
}

json lattice_figures(const verification::AuthorsComparison& found) {
  const auto of = [](const verification::Agreement& agreement) {
    return json{{"states", agreement.states},
                {"same_sign", agreement.sign_agreement()},
                {"false_safe", agreement.false_safe_share()},
                {"false_alarm", agreement.false_alarm_share()}};
  };
  return {{"all", of(found.all)}, {"at_18mps", of(found.by_speed.back().agreement)}};
}

std::vector<danger::State> states_of(std::span<const verification::AuthorsState> some) {
  std::vector<danger::State> all;
  all.reserve(some.size());
  for (const verification::AuthorsState& one : some) {
    all.push_back({one.x, one.y, one.yaw, one.speed});
  }
  return all;
}

json rung_figures(const learned_danger::ExactPointMass& exact, const danger::ValueAt& value,
                  network_training::DangerNet v) {
  const auto values = [&](std::span<const danger::State> states) {
    std::vector<learned_danger::SeenByNet> seen;
    seen.reserve(states.size());
    for (const danger::State& at : states) {
      seen.push_back(learned_danger::seen_by_net(exact.problem, at));
    }
    return network_training::values_of(v, seen);
  };
  json all = figures_of(exact, value, values);
  all["authors_lattice"] = lattice_figures(verification::compare_with_authors(
      value,
      [&](std::span<const verification::AuthorsState> some) { return values(states_of(some)); }));
  return all;
}

/// What one way of learning came to.
struct Rung {
  json figures;
  formats::Tensors weights;
  std::string curve;
};

/// By fitted iteration.
Result<Rung> fitted_rung(const Options& options, const learned_danger::ExactPointMass& exact) {
  const danger::ValueAt value = exact.value();
  const learned_danger::Outcomes outcomes =
      learned_danger::point_mass_outcomes(exact.problem, value, options.states, options.plan.seed);
  Curve curve("fitted iteration");
  const auto fitted = network_training::fitted_values(
      outcomes, options.plan, options.threads, fs::path(options.output) / "fitted.state",
      [&](const network_training::DangerProgress& now) { return curve.add(now); });
  if (!fitted.has_value()) {
    return fitted.error();
  }
  Rung rung;
  if (train_program::is_to_stop()) {
    return rung;
  }
  fitted.value()->add_to(rung.weights, "v.");
  rung.figures = rung_figures(exact, value, fitted.value());
  rung.figures["seconds"] = curve.seconds();
  rung.curve = curve.text();
  return rung;
}

/// From transitions alone.
Result<Rung> rung_from_data(const Options& options, const learned_danger::ExactPointMass& exact) {
  const danger::ValueAt value = exact.value();
  learned_danger::Experience experience;
  const learned_danger::Transitions made = learned_danger::point_mass_transitions(
      exact.problem, value, options.drives, options.plan.seed + 1);
  learned_danger::add_experience(experience, made, exact.problem.ego, exact.problem.obstacle.shape);
  fmt::print("{} transitions\n", experience.size());
  Curve curve("from data");
  const auto nets = network_training::trained_danger(
      experience, nullptr, options.plan, options.threads,
      fs::path(options.output) / "offline.state",
      [&](const network_training::DangerProgress& now) { return curve.add(now); });
  if (!nets.has_value()) {
    return nets.error();
  }
  Rung rung;
  if (train_program::is_to_stop()) {
    return rung;
  }
  rung.figures = rung_figures(exact, value, nets.value()->v);
  rung.figures["seconds"] = curve.seconds();
  rung.figures["transitions"] = experience.size();
  nets.value()->add_to(rung.weights, "");
  rung.curve = curve.text();
  return rung;
}

int train_point_mass(const Options& options) {
  const auto read = learned_danger::read_exact_point_mass(options.table);
  if (!read.has_value()) {
    return train_program::failed(program, read.error());
  }
  const learned_danger::ExactPointMass& exact = read.value();
  const fs::path folder = options.output;
  std::error_code problem;
  fs::create_directories(folder, problem);
  json figures;
  for (const auto& [learn, key, file] : {std::tuple{&fitted_rung, "fitted_iteration", "fitted"},
                                         std::tuple{&rung_from_data, "from_data", "from_data"}}) {
    const auto rung = learn(options, exact);
    if (!rung.has_value()) {
      return train_program::failed(program, rung.error());
    }
    if (train_program::is_to_stop()) {
      return train_program::stopped(program);
    }
    figures[key] = rung.value().figures;
    fmt::print("{}\n", figures[key].dump());
    for (const auto& [ending, text] :
         {std::pair{".safetensors", formats::tensor_bytes(rung.value().weights)},
          std::pair{".curve.csv", rung.value().curve}}) {
      if (const auto unwritable = write_file(folder / (std::string(file) + ending), text)) {
        return train_program::failed(program, *unwritable);
      }
    }
  }
  if (const auto unwritable = write_file(folder / "figures.json", figures.dump(2) + "\n")) {
    return train_program::failed(program, *unwritable);
  }
  fs::remove(folder / "fitted.state");
  fs::remove(folder / "offline.state");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  train_program::begin(argv);
  CLI::App app("Learns V_h of a point mass in two ways, and holds them against the exact table");
  Options options;
  app.add_option("TABLE", options.table, "Of `saca reach solve`, of an obstacle at rest")
      ->required();
  app.add_option("--output", options.output, "Folder of weights, curves and figures.json")
      ->required();
  app.add_option("--drives", options.drives, "Of the data")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  app.add_option("--states", options.states, "Of fitted iteration")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  app.add_option("--seed", options.plan.seed)->capture_default_str();
  app.add_option("--steps", options.plan.steps)
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  app.add_option("--batch", options.plan.batch, "States or transitions in a step")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  app.add_option("--expectile", options.plan.expectile, "Of V at the end, in (0.5, 1)")
      ->check(CLI::Range(0.5, 0.9999))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return train_point_mass(options);
}
