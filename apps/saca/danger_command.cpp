#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/danger_check.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/journal.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/learned_danger/transition_file.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using learned_danger::Part;
using nlohmann::json;

struct DatasetOptions {
  std::string folder;
  std::string car = "compact_rwd_ev";
  std::int64_t transitions = 31'000'000;
  std::uint64_t seed = 1;
  int drives_per_part = 500;
  bool no_tables = false;
  std::string by;  ///< weights; empty: none
  bool outcomes = false;
  int threads = usual_threads();
  bool as_json = false;
};

/// What the journal remembers of a part.
struct PartLine {
  std::int64_t transitions = 0;
  std::int64_t drives = 0;
  std::int64_t situations = 0;
  std::int64_t near = 0;
  std::int64_t bytes = 0;
};

std::string line_of(std::size_t part, const PartLine& one) {
  return fmt::format("{} {} {} {} {} {}", part, one.transitions, one.drives, one.situations,
                     one.near, one.bytes);
}

std::optional<std::pair<std::size_t, PartLine>> parsed(const std::string& line) {
  std::array<std::int64_t, 6> numbers{};
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  for (std::int64_t& number : numbers) {
    const auto read = std::from_chars(at, end, number);
    if (read.ec != std::errc() || number < 0) {
      return std::nullopt;
    }
    at = read.ptr == end ? end : read.ptr + 1;
  }
  const auto [part, transitions, drives, situations, near, bytes] = numbers;
  return std::pair{static_cast<std::size_t>(part),
                   PartLine{transitions, drives, situations, near, bytes}};
}

fs::path file_of(const DatasetOptions& options, std::size_t part) {
  return fs::path(options.folder) / fmt::format("part_{:05}.h5", part);
}

std::string card(const DatasetOptions& options, const PartLine& all) {
  return fmt::format(
      "# Transitions of a simulated car\n\n"
      "Nothing here was driven by anybody: all of it is simulated by `saca danger dataset` "
      "(car {}, seed {}), the car by a double track with combined slip, load transfer, actuators "
      "with lag and an anti-lock brake, its obstacles as bodies that hold their acceleration and "
      "curvature. Roads, edges and reactions of others are not in it.\n\n"
      "{} transitions of 0.1 s in {} situations, {} of which start within 2 m of the boundary "
      "between what a point mass can evade and what it cannot, beside {} different drives of the "
      "car; the other situations are the same drives beside other obstacles. {} bytes.\n\n"
      "Each `part_*.h5` is HDF5 in the layout of DSRL: observations, next_observations, actions, "
      "rewards, costs, terminals, timeouts; and h, next_h (signed, in metres) and drives. The text "
      "`features` names the numbers of an observation, in SI units and radians.\n",
      options.car, options.seed, all.transitions, all.situations, all.near, all.drives, all.bytes);
}

/// Parts, one after another, until there are enough transitions; those of the journal are kept.
class Making {
 public:
  Making(const DatasetOptions& options, const Inputs& inputs, const danger::DangerModel& model,
         const learned_danger::Network* network, Journal journal)
      : options_(options),
        inputs_(inputs),
        model_(model),
        network_(network),
        journal_(std::move(journal)) {
    for (const std::string& line : journal_.lines()) {
      const auto one = parsed(line);
      if (one && fs::exists(file_of(options, one->first))) {
        made_[one->first] = one->second;
      }
    }
  }

  /// @return  the reason why it stopped before the end; nullopt: all are there
  std::optional<Error> run(SteadyClock& clock) {
    const auto thousands = [](std::int64_t n) { return static_cast<int>(n / 1'000); };
    long_work::ProgressLine line("danger dataset", std::max(1, thousands(options_.transitions)),
                                 clock, progress_display());
    const int remembered = thousands(all().transitions);
    for (std::size_t first = 0; all_until(first).transitions < options_.transitions;
         first += static_cast<std::size_t>(options_.threads)) {
      if (long_work::interrupted()) {
        return Error{Error::Code::too_late, "interrupted; the same command goes on"};
      }
      if (auto problem = make_some(first)) {
        return problem;
      }
      line.show(std::min(thousands(options_.transitions), thousands(all().transitions)), remembered,
                " thousand transitions");
    }
    return std::nullopt;
  }

  [[nodiscard]] PartLine all() const { return all_until(std::numeric_limits<std::size_t>::max()); }

 private:
  [[nodiscard]] PartLine all_until(std::size_t end) const {
    PartLine sum;
    for (const auto& [part, one] : made_) {
      if (part < end) {
        sum.transitions += one.transitions;
        sum.drives += one.drives;
        sum.situations += one.situations;
        sum.near += one.near;
        sum.bytes += one.bytes;
      }
    }
    return sum;
  }

  std::optional<Error> make_some(std::size_t first) {
    std::vector<std::size_t> missing;
    for (std::size_t k = first; k < first + static_cast<std::size_t>(options_.threads); ++k) {
      if (made_.count(k) == 0) {
        missing.push_back(k);
      }
    }
    std::vector<Part> parts(missing.size());
    in_parallel(missing.size(), options_.threads, [&](std::size_t i) {
      Part& part = parts[i];
      part.car = inputs_.car_name;
      Fnv seed;
      seed.add(fmt::format("{} {}", options_.seed, missing[i]));
      part.seed = seed.value();
      if (options_.outcomes) {
        part.mixture = learned_danger::mixture_of_outcomes();
      }
      part.transitions = learned_danger::made_transitions(
          inputs_.car, manoeuvre::footprint(inputs_.car), model_, part.mixture,
          options_.drives_per_part, part.seed, network_);
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (all_until(missing[i]).transitions >= options_.transitions) {
        break;  // how many are made at a time is nothing to whoever reads them
      }
      const fs::path file = file_of(options_, missing[i]);
      if (auto problem = learned_danger::write_part(file, parts[i])) {
        return problem;
      }
      const learned_danger::Transitions& all = parts[i].transitions;
      const PartLine one{
          static_cast<std::int64_t>(all.size()), static_cast<std::int64_t>(all.drives),
          static_cast<std::int64_t>(all.situations), static_cast<std::int64_t>(all.near),
          static_cast<std::int64_t>(fs::file_size(file))};
      if (!journal_.add(line_of(missing[i], one))) {
        return Error{Error::Code::unwritable, options_.folder + ": the journal cannot be written"};
      }
      made_[missing[i]] = one;
    }
    return std::nullopt;
  }

  const DatasetOptions& options_;
  const Inputs& inputs_;
  const danger::DangerModel& model_;
  const learned_danger::Network* network_;
  Journal journal_;
  std::map<std::size_t, PartLine> made_;
};

void tell(const DatasetOptions& options, const PartLine& all, double seconds) {
  if (options.as_json) {
    print_json(json{{"danger.dataset.transitions", all.transitions},
                    {"danger.dataset.drives", all.drives},
                    {"danger.dataset.situations", all.situations},
                    {"danger.dataset.near_boundary", all.near},
                    {"danger.dataset.bytes", all.bytes},
                    {"danger.dataset.seconds", seconds},
                    {"meta.car", options.car},
                    {"meta.seed", std::to_string(options.seed)},
                    {"meta.threads", options.threads}});
    return;
  }
  app::print("{} transitions in {} situations, {} of which start near the boundary, of {} drives\n",
             all.transitions, all.situations, all.near, all.drives);
  app::print("{:.2f} GB in {}\n", 1e-9 * static_cast<double>(all.bytes), options.folder);
}

int make_dataset(const DatasetOptions& options) {
  long_work::watch_for_interrupt();
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  std::optional<learned_danger::Network> network;
  if (!options.by.empty()) {
    auto read = read_danger_weights(options.by);
    if (!read.has_value()) {
      return refused(read.error());
    }
    if (read.value().car_name != inputs.value().car_name) {
      return refused({Error::Code::malformed,
                      fmt::format("{}: want weights of the car {}, got of {}", options.by,
                                  inputs.value().car_name, read.value().car_name)});
    }
    network = std::move(read).value().network;
  }
  const fs::path folder(options.folder);
  const fs::path journal_file = folder / "journal.txt";
  if (const auto problem = long_work::make_folder_of(journal_file)) {
    return refused(*problem);
  }
  auto journal = Journal::open(
      journal_file,
      fmt::format("saca.transitions/1, car {}, seed {}, {} drives a part, {} features{}",
                  inputs.value().car_name, options.seed, options.drives_per_part,
                  learned_danger::num_features, options.no_tables ? ", no tables" : "") +
          (network ? fmt::format(", by {:016x}", network->digest()) : "") +
          (options.outcomes ? ", outcomes" : ""));
  if (!journal.has_value()) {
    return refused(journal.error());
  }
  const auto model = danger_of_drawn(inputs.value(), !options.no_tables);
  if (!model.has_value()) {
    return refused(model.error());
  }
  SteadyClock clock;
  const auto start = clock.now();
  Making making(options, inputs.value(), model.value(), network ? &*network : nullptr,
                std::move(journal).value());
  if (const auto stopped = making.run(clock)) {
    const int code = refused(*stopped);
    return stopped->code == Error::Code::too_late ? static_cast<int>(was_interrupted) : code;
  }
  if (const auto unwritten = write_file(folder / "README.md", card(options, making.all()))) {
    return refused(*unwritten);
  }
  tell(options, making.all(), std::chrono::duration<double>(clock.now() - start).count());
  return success;
}

}  // namespace

void add_danger(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "danger", "V_h and Q_h, learnt: what they are learnt from, and what they are worth");
  command->require_subcommand(1);
  const auto options = std::make_shared<DatasetOptions>();
  CLI::App* const dataset = command->add_subcommand(
      "dataset", "Simulate transitions of the full vehicle beside obstacles; can be interrupted");
  dataset->add_option("FOLDER", options->folder, "Of the parts; made if it is not there")
      ->required();
  dataset->add_option("--transitions", options->transitions, "At least so many")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}))
      ->capture_default_str();
  dataset->add_option("--car", options->car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
  dataset->add_option("--seed", options->seed)->capture_default_str();
  dataset->add_option("--part-drives", options->drives_per_part, "Drives of the ego in a part")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  dataset->add_flag(
      "--no-tables", options->no_tables,
      "Look for the boundary and the way out by arcs, not by solved tables of danger");
  dataset->add_option("--by", options->by,
                      "Weights of saca-train-danger: evasions are driven by their Q");
  dataset
      ->add_flag("--outcomes", options->outcomes,
                 "All drives by their Q to the end: what it comes to")
      ->needs("--by");
  dataset->add_option("--threads", options->threads, "They do not change what is made")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  dataset->add_flag("--json", options->as_json, "For programs");
  dataset->callback([options, &exit_code] { exit_code = make_dataset(*options); });
  add_danger_check(*command, exit_code);
  add_danger_coverage(*command, exit_code);
  add_danger_margins(*command, exit_code);
  add_danger_show(*command, exit_code);
}

}  // namespace saca::app
