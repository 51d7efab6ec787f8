#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/intent_commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/recordings/set_file.h"
#include "saca/lab/training/examples.h"
#include "saca/lab/training/sequence_file.h"
#include "saca/lab/training/simulated.h"
#include "saca/lab/training/split.h"

namespace saca::app {
namespace {

using training::Sequence;
using training::SequenceSet;

struct ExamplesOptions {
  std::vector<std::string> sets;
  std::string output;
  int parts = 5;
  std::size_t simulated = 2'000;
  unsigned long seed = 1;
};

void tell_shares(const SequenceSet& set) {
  const std::set<std::string> splits(set.splits.begin(), set.splits.end());
  app::print("{:12} {:>9} {:>8} {:>8} | frames: M, LC, RC, FB, LB, RB; in doubt\n", "split",
             "sequences", "groups", "hours");
  for (const std::string& split : splits) {
    std::vector<std::size_t> frames(training::num_vehicle_classes, 0);
    std::set<std::string> groups;
    std::size_t doubtful = 0;
    std::size_t num = 0;
    std::size_t all = 0;
    for (std::size_t i = 0; i < set.sequences.size(); ++i) {
      const Sequence& sequence = set.sequences[i];
      if (set.splits[i] != split) {
        continue;
      }
      ++num;
      groups.insert(sequence.group);
      all += sequence.labels.size();
      for (std::size_t t = 0; t < sequence.labels.size(); ++t) {
        sequence.scored[t] ? ++frames[sequence.labels[t]] : ++doubtful;
      }
    }
    app::print("{:12} {:9} {:8} {:8.2f} |", split, num, groups.size(),
               static_cast<double>(all) * training::frame_step / 3600.0);
    for (const std::size_t count : frames) {
      app::print(" {}", count);
    }
    app::print("; {}\n", doubtful);
  }
}

/// Recorded sequences in `parts` splits, simulated ones to train with and to test with.
Result<SequenceSet> gathered(const ExamplesOptions& options) {
  std::vector<Sequence> recorded;
  for (const std::string& file : options.sets) {
    const auto set = recordings::read_set(file);
    if (!set.has_value()) {
      return set.error();
    }
    auto some = training::examples_of(set.value());
    std::move(some.begin(), some.end(), std::back_inserter(recorded));
  }
  SequenceSet all;
  for (const int part : training::parts_of(recorded, options.parts)) {
    all.splits.push_back(fmt::format("part-{}", part));
  }
  all.sequences = std::move(recorded);
  // Of other seeds: what is tested was never trained with.
  for (const auto& [split, seed, count] :
       {std::tuple("simulated", options.seed, options.simulated),
        std::tuple("test", options.seed + 1, options.simulated / 2)}) {
    for (Sequence& each : training::simulated_sequences(count, seed, usual_threads())) {
      each.name = fmt::format("{} {}", split, each.name);
      all.sequences.push_back(std::move(each));
      all.splits.emplace_back(split);
    }
  }
  return all;
}

int make_examples(const ExamplesOptions& options) {
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto all = gathered(options);
  if (!all.has_value()) {
    return refused(all.error());
  }
  if (const auto rule = training::broken_rule(all.value())) {
    complain(fmt::format("{}: {}", options.sets.front(), *rule));
    return bad_input;
  }
  if (const auto problem = long_work::make_folder_of(options.output)) {
    return refused(*problem);
  }
  if (const auto problem = training::write_sequences(options.output, all.value())) {
    return refused(*problem);
  }
  tell_shares(all.value());
  return success;
}

void add_examples(CLI::App& intent, int& exit_code) {
  CLI::App* const command = intent.add_subcommand(
      "examples", "Label recorded traffic, add simulated vehicles: what a model is trained with");
  const auto options = std::make_shared<ExamplesOptions>();
  command->add_option("sets", options->sets, "HDF5 files of `saca traffic pack`")->required();
  command->add_option("-o,--output", options->output, "The sequences (HDF5)")->required();
  command->add_option("--parts", options->parts, "Into so many the recordings are split")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  command->add_option("--simulated", options->simulated, "Simulated vehicles to train with")
      ->check(CLI::Range(2, 100'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed)->capture_default_str();
  command->callback([options, &exit_code] { exit_code = make_examples(*options); });
}

}  // namespace

void add_intent(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("intent", "What road users are about to do: examples, scores, pictures");
  command->require_subcommand(1);
  add_examples(*command, exit_code);
  add_intent_eval(*command, exit_code);
  add_intent_motion(*command, exit_code);
  add_intent_show(*command, exit_code);
}

}  // namespace saca::app
