#include "apps/saca/options.h"
#include "saca/lab/intention_scoring/evaluation.h"
#include "saca/lab/intention_scoring/predict.h"
#include "saca/lab/intention_scoring/sequence_file.h"
#include "saca/lab/intention_study/evaluation.h"
#include "saca/lab/intention_study/evaluation_json.h"
#include "saca/lab/intention_study/evaluation_text.h"
#include "saca/lab/intention_study/example_set.h"
#include "saca/lab/intention_study/motion_study.h"
#include "saca/lab/intention_study/sample_page.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/recordings/set_file.h"
#include "saca/lab/report/intention_chart.h"
#include "saca/lab/report/intention_page.h"

namespace saca::app {
namespace {

struct ExamplesOptions {
  intention_study::ExampleRequest request;
  std::string output;
};

void make_examples(const ExamplesOptions& options) {
  for (const std::string& set : options.request.sets) {
    need_distinct({{"--output", options.output}}, {{"the sets", set}});
  }
  need_writable({options.output});
  const auto all = need(intention_study::example_set(options.request, usual_threads()));
  if (const auto rule = intention_scoring::broken_rule(all)) {
    refuse(bad_input, fmt::format("{}: {}", options.request.sets.front(), *rule));
  }
  need(long_work::make_folder_of(options.output));
  need(intention_scoring::write_sequences(options.output, all));
  app::print("{}", intention_study::shares_text(all));
}

void add_examples(CLI::App& intent) {
  const auto [command, options] = add_command<ExamplesOptions>(
      intent, "examples",
      "Label recorded traffic, add simulated vehicles: what a model is trained with",
      make_examples);
  add_needed(command, "sets", options.request.sets, "HDF5 files of `saca traffic pack`");
  add_needed(command, "-o,--output", options.output, "The sequences (HDF5)");
  add(command, "--parts", options.request.parts, "Into so many the recordings are split",
      CLI::Range(2, 100));
  add(command, "--simulated", options.request.simulated, "Simulated vehicles to train with",
      CLI::Range(2, 100'000));
  add(command, "--seed", options.request.seed, "");
}

struct EvalIntentOptions {
  std::string sequences;
  std::string models;
  intention_study::Rivals rivals;
  std::string svg;
  std::uint64_t seed = 1;
  bool as_json = false;
};

void evaluate_models(const EvalIntentOptions& options) {
  need_distinct({{"--svg", options.svg}}, {{"the sequences", options.sequences}});
  const auto set = need(intention_scoring::read_sequences(options.sequences));
  need_writable({options.svg});
  const auto models = need(intention_scoring::read_models(
      options.models.empty() ? here().root / "models" / "intent" : fs::path(options.models)));
  const auto evaluation =
      need(intention_study::evaluate(set, models, options.rivals, options.seed, usual_threads()));
  if (!options.svg.empty()) {
    write(options.svg, intention_study::confusion_svg(evaluation));
  }
  tell(options.as_json, intention_study::evaluation_json(evaluation),
       intention_study::evaluation_text(evaluation));
}

void add_intent_eval(CLI::App& intent) {
  const auto [command, options] = add_command<EvalIntentOptions>(
      intent, "eval", "Score models of intentions on what they have not seen, beside baselines",
      evaluate_models);
  add_needed(command, "sequences", options.sequences, "HDF5 file of `saca intent examples`");
  add(command, "--models", options.models,
      "Folder of weights, one per part left out; default: the shipped ones");
  add(command, "--plain-models", options.rivals.plain_models,
      "Likewise, trained without the CRF and not calibrated, for comparison");
  add(command, "--other-models", options.rivals.other_models,
      "Folder of weights of another training, as they are, for comparison");
  add(command, "--forecasts", options.rivals.forecasts,
      "Forecasts of other models (saca.forecasts/1), for comparison");
  add(command, "--svg", options.svg, "A picture of the confusion of recorded vehicles");
  add(command, "--seed", options.seed, "Of the groups drawn for intervals");
  add_json(command, options.as_json);
}

struct MotionOptions {
  std::vector<std::string> sets;
  bool as_json = false;
};

void fit_motion(const MotionOptions& options) {
  intention_study::MotionStudy study;
  for (const std::string& file : options.sets) {
    study.add(need(recordings::read_set(file)));
  }
  const auto sites = study.sites();
  tell(options.as_json, intention_study::motion_json(sites), intention_study::motion_text(sites));
}

void add_motion(CLI::App& intent) {
  const auto [command, options] = add_command<MotionOptions>(
      intent, "motion", "Measure how people really brake and change lanes", fit_motion);
  add_needed(command, "sets", options.sets, "HDF5 files of `saca traffic pack`");
  add_json(command, options.as_json);
}

struct ShowIntentOptions {
  intention_study::SampleRequest request;
  std::string output;
  std::string model;
};

void show_samples(const ShowIntentOptions& options) {
  need_distinct({{"--output", options.output}},
                {{"the sequences", options.request.source}, {"--model", options.model}});
  const auto set = need(intention_scoring::read_sequences(options.request.source));
  need_writable({options.output});
  const auto chosen = intention_study::drawn_samples(set, options.request);
  if (chosen.empty()) {
    refuse(bad_input, fmt::format("{}: want sequences that fit --split and --name, got none",
                                  options.request.source));
  }
  std::vector<intention_scoring::Forecasts> forecasts;
  if (!options.model.empty()) {
    forecasts =
        intention_scoring::predicted(need(intent::read_model(options.model)),
                                     intention_study::sequences_of(set, chosen), usual_threads());
  }
  const auto page = intention_study::sample_page(set, options.request, chosen, forecasts);
  const bool as_svg = fs::path(options.output).extension() == ".svg";
  write(options.output,
        as_svg ? report::intention_sample_svg(page.samples.front()) : report::intention_page(page));
  app::print("{}: {} samples\n", options.output, as_svg ? 1 : page.samples.size());
}

void add_intent_show(CLI::App& intent) {
  const auto [command, options] = add_command<ShowIntentOptions>(
      intent, "show", "Draw sequences with their labels, and what a model believes", show_samples);
  add_needed(command, "sequences", options.request.source, "HDF5 file of `saca intent examples`");
  add_needed(command, "-o,--output", options.output, "A page (.html), or its first sample (.svg)");
  add(command, "--model", options.model, "Weights whose beliefs are shown");
  add(command, "--split", options.request.split, "Only of this one; default: what was recorded");
  add(command, "--name", options.request.name, "Only the sequence of this name");
  add(command, "--samples", options.request.samples, "How many are drawn; each class in turn",
      CLI::Range(1, 1'000));
  add(command, "--seed", options.request.seed, "");
}

}  // namespace

void add_intent(CLI::App& line) {
  CLI::App& intent =
      add_group(line, "intent", "What road users are about to do: examples, scores, pictures");
  add_examples(intent);
  add_intent_eval(intent);
  add_motion(intent);
  add_intent_show(intent);
}

}  // namespace saca::app
