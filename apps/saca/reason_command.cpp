#include <chrono>

#include "apps/saca/options.h"
#include "saca/lab/model_trials/reason_report.h"
#include "saca/lab/model_trials/reasoning.h"
#include "saca/lab/model_trials/reply_stream.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::app {
namespace {

using model_trials::ForecastReply;
using model_trials::Reasoning;

struct ReasonOptions {
  std::string scenario;
  std::string model = "local";
  int deadline = 4'000;  ///< [ms]
  bool stream = false;
  bool as_json = false;
};

/// Asks, telling the text while it comes if that is wanted.
std::vector<ForecastReply> ask(const Reasoning& about, const ReasonOptions& options,
                               const Clock& clock) {
  if (about.asked.empty()) {
    return {};
  }
  const bool streams = options.stream && !options.as_json;
  model_trials::ReplyStream stream(about.asked.size(),
                                   [](const std::string& text) { tell_meanwhile(false, text); });
  auto replies = model_trials::replies_about(about.asked, *about.model,
                                             std::chrono::milliseconds(options.deadline), clock,
                                             [&](std::size_t number, std::string_view text) {
                                               if (streams) {
                                                 stream.take(number, text);
                                               }
                                             });
  if (streams) {
    stream.end();
  }
  return model_trials::considered(about.asked, need(std::move(replies), too_slow), about.tools,
                                  *about.model, clock);
}

void reason(const ReasonOptions& options) {
  SteadyClock clock;
  const auto about =
      need(model_trials::open_reasoning(here(), options.scenario, options.model, clock));
  const scenario::Scenario& scenario = about->inputs.scenario;
  const std::string description = about->model->description();
  tell_meanwhile(options.as_json,
                 fmt::format("{}\nLanguage model: {}.\n\n{}", scenario.title, description,
                             model_trials::question_text(about->asked)));
  const auto replies = ask(*about, options, clock);
  tell(options.as_json,
       model_trials::reason_json({.scenario = scenario.name,
                                  .model = description,
                                  .deadline = options.deadline,
                                  .system = language_model::system_part(about->inputs.harm)},
                                 replies),
       model_trials::replies_text(replies, options.stream ? model_trials::ReasoningText::seen
                                                          : model_trials::ReasoningText::told));
}

}  // namespace

void add_reason(CLI::App& line) {
  const auto [command, options] = add_command<ReasonOptions>(
      line, "reason",
      "Ask the language model what an encounter's first previews ask, and show it think", reason);
  add_scenario(command, options.scenario);
  add_needed_model(command, options.model);
  add(command, "--deadline-ms", options.deadline,
      "From the question to the last answer; in an encounter about 4 s. Reasons that do not hold "
      "are asked for again afterwards",
      CLI::Range(1, 3'600'000));
  command.add_flag("--stream", options.stream, "Write the reasoning while it comes");
  add_json(command, options.as_json);
}

}  // namespace saca::app
