#include <unistd.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/danger_making.h"
#include "apps/saca/first_question.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/model.h"
#include "apps/saca/printing.h"
#include "saca/thinking/arbitration/check.h"
#include "saca/thinking/arbitration/event.h"
#include "saca/thinking/language_model/explanation_json.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/truth.h"
#include "saca/thinking/language_model/truth_json.h"

namespace saca::app {
namespace {

using arbitration::Preview;
using language_model::Answer;
using language_model::Progress;
using language_model::Reply;
using manoeuvre::PolicyId;
using nlohmann::json;

struct ReasonOptions {
  std::string scenario;
  std::string model = "local";
  int deadline = 4000;  ///< [ms]
  bool stream = false;
  bool as_json = false;
};

double milliseconds(Clock::Time time) {
  return 1e3 * to_seconds(time);
}

/// Writes what several replies say while they grow: one as it comes, more of them line by line.
class Stream {
 public:
  explicit Stream(std::size_t num_scenes) : lines_(num_scenes) {}

  void take(std::size_t scene, std::string_view text) {
    if (lines_.size() == 1) {
      app::print("{}", text);
      std::fflush(stdout);
      return;
    }
    std::string& line = lines_.at(scene);
    line += text;
    for (std::size_t end = line.find('\n'); end != std::string::npos; end = line.find('\n')) {
      tell(scene, line.substr(0, end));
      line.erase(0, end + 1);
    }
  }
  void end() {
    for (std::size_t scene = 0; scene < lines_.size(); ++scene) {
      if (lines_.size() > 1 && !lines_[scene].empty()) {
        tell(scene, lines_[scene]);
      }
    }
    app::print("\n");
  }

 private:
  static void tell(std::size_t scene, std::string_view line) {
    app::print("{} | {}\n", scene + 1, line);
    std::fflush(stdout);
  }

  std::vector<std::string> lines_;
};

/// One forecast, and what was said of it.
struct ForecastReply {
  const Preview* preview = nullptr;
  Reply reply;
  language_model::Truth truth;
  std::optional<arbitration::Check> check;                 ///< of what was last chosen
  std::optional<language_model::Explanation> explanation;  ///< of that, where it can be driven
};

json considered_json(const ForecastReply& one) {
  json answers = json::array();
  for (const Answer& answer : one.reply.answers) {
    answers.push_back({{"after_ms", milliseconds(answer.time)},
                       {"kind", name(answer.kind)},
                       {"policy", manoeuvre::index(likeliest_policy(answer))},
                       {"probability", answer.probability}});
  }
  return {{"probability", one.preview->situation.probability},
          {"trigger_s", one.preview->situation.scene_at_trigger.time},
          {"prompt", one.preview->prompt},
          {"reasoning", one.reply.reasoning},
          {"answers", answers},
          {"prompt_tokens", one.reply.prompt_tokens},
          {"reply_tokens", one.reply.reply_tokens},
          {"truth", truth_json(one.truth)},
          {"explanation", explanation_json(one.explanation)},
          {"check",
           one.check ? json{{"passed", one.check->passed}, {"text", one.check->text}} : json()}};
}

void tell_considered(std::size_t number, const ForecastReply& one, bool with_text) {
  app::print("--- Forecast {} ---\n", number);
  if (with_text) {
    app::print("{}\n", one.reply.reasoning);
  }
  app::print("{:>9} {:>7}", "after", "answer");
  for (const PolicyId policy : manoeuvre::all_policies) {
    app::print(" {:>7}", name(policy));
  }
  app::print("\n");
  for (const Answer& answer : one.reply.answers) {
    app::print("{:>6.0f} ms {:>7}", milliseconds(answer.time), name(answer.kind));
    for (const double p : answer.probability) {
      app::print(" {:>5.0f} %", 100.0 * p);
    }
    app::print("\n");
  }
  const auto num_checked = static_cast<std::size_t>(one.truth.num_checked);
  app::print("Truth: {} of {} statements that can be checked.\n",
             num_checked - one.truth.wrong.size(), num_checked);
  for (const language_model::FalseStatement& each : one.truth.wrong) {
    app::print("  false{}: \"{}\": {}\n", each.load_bearing ? ", and the choice rests on it" : "",
               each.text, each.why);
  }
  if (one.reply.answers.empty()) {
    app::print("No answer in time.\n\n");
    return;
  }
  const PolicyId chosen = likeliest_policy(one.reply.answers.back());
  if (one.explanation) {
    const std::string in_try =
        one.explanation->tries > 1 ? fmt::format(", try {}", one.explanation->tries) : "";
    app::print("Reasons, {}{}:\n{}",
               one.explanation->from == language_model::Explanation::From::facts ? "by the figures"
                                                                                 : "as far as true",
               in_try, one.explanation->text);
  }
  app::print("Choice: {} {}; rollout check {}: {}.\n{} tokens read, {} written.\n\n",
             manoeuvre::index(chosen), name(chosen), one.check->passed ? "passed" : "failed",
             one.check->text, one.reply.prompt_tokens, one.reply.reply_tokens);
}

void tell_question(const std::vector<Preview>& previews) {
  for (const Preview& preview : previews) {
    const preview::Situation& situation = preview.situation;
    app::print("--- Forecast {} of {}: {:.0f} % likely, trigger at {:.2f} s ---\n{}\n",
               preview.number + 1, previews.size(), 100.0 * situation.probability,
               situation.scene_at_trigger.time, preview.prompt);
  }
}

/// Asks, telling the text while it comes if that is wanted. Answers are dated from the question.
Result<std::vector<Reply>> ask(language_model::LanguageModel& model,
                               const std::vector<Preview>& previews, const ReasonOptions& options,
                               const Clock& clock) {
  std::vector<std::string> scenes;
  scenes.reserve(previews.size());
  for (const Preview& preview : previews) {
    scenes.push_back(preview.prompt);
  }
  Stream stream(scenes.size());
  const bool streams = options.stream && !options.as_json;
  const Clock::Time begin = clock.now();
  auto replies = model.ask(scenes, begin + std::chrono::milliseconds(options.deadline),
                           [&](const Progress& news) {
                             if (streams && !news.text.empty()) {
                               stream.take(news.prompt, news.text);
                             }
                           });
  if (streams) {
    stream.end();
  }
  if (replies.has_value()) {
    std::vector<Reply> dated = std::move(replies).value();
    for (Reply& reply : dated) {
      for (Answer& answer : reply.answers) {
        answer.time -= begin;
      }
    }
    return dated;
  }
  return replies;
}

int reason_about(const ReasonOptions& options) {
  const auto inputs = read_scenario_inputs(options.scenario);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  SteadyClock clock;
  const auto model =
      open_needed_model(inputs.value().places, options.model, runtime::Pace::real, clock);
  if (!model.has_value()) {
    return refused(model.error());
  }
  const atlas::Atlas atlas = usual_atlas(inputs.value());
  const auto danger = usual_danger(inputs.value(), false);
  if (!danger.has_value()) {
    return refused(danger.error());
  }
  const preview::ForecastTools tools{.car = &inputs.value().car,
                                     .harm = &inputs.value().harm,
                                     .atlas = &atlas,
                                     .danger = danger.value() ? &*danger.value() : nullptr,
                                     .cues = &inputs.value().cues};
  const auto asked = first_question(inputs.value(), tools, clock);
  if (!asked.has_value()) {
    return refused(asked.error());
  }
  const std::vector<Preview>& previews = asked.value().previews;
  if (!options.as_json) {
    app::print("{}\nLanguage model: {}.\n\n", inputs.value().scenario.title,
               model.value()->description());
    tell_question(previews);
  }
  std::vector<ForecastReply> all;
  if (!previews.empty()) {
    auto replies = ask(*model.value(), previews, options, clock);
    if (!replies.has_value()) {
      return unanswered(replies.error());
    }
    std::vector<Reply> said = std::move(replies).value();
    for (std::size_t i = 0; i < said.size(); ++i) {
      ForecastReply one{.preview = &previews[i], .reply = std::move(said[i])};
      const preview::Situation& situation = one.preview->situation;
      if (!one.reply.answers.empty()) {
        const PolicyId chosen = likeliest_policy(one.reply.answers.back());
        one.check =
            arbitration::check(situation.facts[manoeuvre::index(chosen)].plan, situation, tools);
      }
      one.truth = language_model::truth_of(one.reply, one.preview->prompt, situation);
      Preview replied = *one.preview;
      replied.reply = one.reply;
      one.explanation = arbitration::retold(replied, *model.value(), clock);
      all.push_back(std::move(one));
    }
  }
  if (options.as_json) {
    json document = {{"schema", "saca.reason/1"},
                     {"scenario", inputs.value().scenario.name},
                     {"model", model.value()->description()},
                     {"deadline_ms", options.deadline},
                     {"system", language_model::system_part(inputs.value().harm)},
                     {"forecasts", json::array()}};
    for (const ForecastReply& one : all) {
      document["forecasts"].push_back(considered_json(one));
    }
    app::print_json(document);
    return success;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    tell_considered(i + 1, all[i], !options.stream);
  }
  if (all.empty()) {
    app::print("Nothing threatens in this scenario: there is nothing to ask.\n");
  }
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
