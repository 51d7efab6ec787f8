#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/model.h"
#include "apps/saca/printing.h"
#include "saca/lab/model_trials/first_question.h"
#include "saca/lab/model_trials/reason_report.h"
#include "saca/lab/model_trials/reply_stream.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::app {
namespace {

using model_trials::ForecastReply;

struct ReasonOptions {
  std::string scenario;
  std::string model = "local";
  int deadline = 4000;  ///< [ms]
  bool stream = false;
  bool as_json = false;
};

/// Asks, telling the text while it comes if that is wanted.
Result<std::vector<ForecastReply>> ask(const std::vector<arbitration::Preview>& previews,
                                       language_model::LanguageModel& model,
                                       const preview::ForecastTools& tools,
                                       const ReasonOptions& options, const Clock& clock) {
  if (previews.empty()) {
    return std::vector<ForecastReply>();
  }
  const bool streams = options.stream && !options.as_json;
  model_trials::ReplyStream stream(previews.size(), [](const std::string& text) {
    app::print("{}", text);
    std::fflush(stdout);
  });
  auto replies =
      model_trials::replies_about(previews, model, std::chrono::milliseconds(options.deadline),
                                  clock, [&](std::size_t number, std::string_view text) {
                                    if (streams) {
                                      stream.take(number, text);
                                    }
                                  });
  if (streams) {
    stream.end();
  }
  if (!replies.has_value()) {
    return replies.error();
  }
  return model_trials::considered(previews, std::move(replies).value(), tools, model, clock);
}

void tell(const std::vector<ForecastReply>& replies, const ScenarioInputs& inputs,
          const std::string& model, const ReasonOptions& options) {
  if (options.as_json) {
    app::print_json(model_trials::reason_json({.scenario = inputs.scenario.name,
                                               .model = model,
                                               .deadline = options.deadline,
                                               .system = language_model::system_part(inputs.harm)},
                                              replies));
  } else {
    app::print("{}", model_trials::replies_text(replies, options.stream
                                                             ? model_trials::ReasoningText::seen
                                                             : model_trials::ReasoningText::told));
  }
}

int reason_about(const ReasonOptions& options) {
  const auto read = read_scenario_inputs(options.scenario);
  if (!read.has_value()) {
    return refused(read.error());
  }
  const ScenarioInputs& inputs = read.value();
  SteadyClock clock;
  const auto model = open_needed_model(inputs.places, options.model, runtime::Pace::real, clock);
  if (!model.has_value()) {
    return refused(model.error());
  }
  const atlas::Atlas atlas = usual_atlas(inputs);
  const auto danger = usual_danger(inputs, false);
  if (!danger.has_value()) {
    return refused(danger.error());
  }
  const preview::ForecastTools tools{.car = &inputs.car,
                                     .harm = &inputs.harm,
                                     .atlas = &atlas,
                                     .danger = danger.value() ? &*danger.value() : nullptr,
                                     .cues = &inputs.cues};
  const auto asked = model_trials::first_question({.scenario = &inputs.scenario,
                                                   .car = tools.car,
                                                   .harm = tools.harm,
                                                   .intent = &inputs.intent,
                                                   .atlas = tools.atlas,
                                                   .danger = tools.danger,
                                                   .cues = tools.cues,
                                                   .clock = &clock});
  if (!asked.has_value()) {
    return refused(asked.error());
  }
  const std::string description = model.value()->description();
  if (!options.as_json) {
    app::print("{}\nLanguage model: {}.\n\n{}", inputs.scenario.title, description,
               model_trials::question_text(asked.value()));
  }
  const auto replies = ask(asked.value(), *model.value(), tools, options, clock);
  if (!replies.has_value()) {
    return unanswered(replies.error());
  }
  tell(replies.value(), inputs, description, options);
  return success;
}

}  // namespace

void add_reason(CLI::App& line, int& exit_code) {
  CLI::App* const command = line.add_subcommand(
      "reason", "Ask the language model what an encounter's first previews ask, and show it think");
  const auto options = std::make_shared<ReasonOptions>();
  command
      ->add_option("scenario", options->scenario, "A scenario file, or the name of a shipped one")
      ->required();
  command
      ->add_option("--llm", options->model,
                   "local: the language model of `make model`; local:FILE: other weights, GGUF; "
                   "replay:FILE: recorded replies; "
                   "MODEL@URL: a server with /v1/chat/completions, key in SACA_LLM_KEY")
      ->capture_default_str();
  command
      ->add_option(
          "--deadline-ms", options->deadline,
          "From the question to the last answer; in an encounter about 4 s. Reasons that do not "
          "hold are asked for again afterwards")
      ->check(CLI::Range(1, 3'600'000))
      ->capture_default_str();
  command->add_flag("--stream", options->stream, "Write the reasoning while it comes");
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = reason_about(*options); });
}

}  // namespace saca::app
