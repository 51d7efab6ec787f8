#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/model.h"
#include "apps/saca/model_commands.h"
#include "apps/saca/printing.h"
#include "saca/base/core/percentile.h"
#include "saca/thinking/language_model/child_model.h"
#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::app {
namespace {

using language_model::Answer;
using language_model::ChildModel;
using language_model::LanguageModel;
using language_model::Progress;
using language_model::Reply;

constexpr double preview_time = 4.2;    // [s]: T2 - T1 of the paper
constexpr double without_haste = 60.0;  // [s]

// Three forecasts that differ as previews do: in what the truck does, and what that leads to.
std::vector<std::string> example_scenes() {
  std::vector<std::string> scenes;
  for (const double speed : {7.5, 5.0, 2.5}) {
    preview::Situation situation = language_model::example_situation();
    situation.scene_at_trigger.actors[0].v_W.y = -speed;
    situation.facts[1].outcome().contact->relative_speed += speed;
    scenes.push_back(language_model::scene_part(situation, std::nullopt, 0.0));
  }
  return scenes;
}

/// What one question took.
struct QuestionTiming {
  double first = 0.0;  ///< until each scene had its first answer [s]
  double whole = 0.0;  ///< until the call returned [s]
  int missing = 0;     ///< scenes without any answer
  int forced = 0;      ///< scenes whose reply the deadline or the length cut
  std::vector<Reply> replies;
  std::optional<Error> error;                 ///< of the whole question
  language_model::ChildModelFigures figures;  ///< where the model is a child process
};

QuestionTiming ask(LanguageModel& model, const std::vector<std::string>& scenes, double budget,
                   Clock& clock) {
  QuestionTiming asked;
  std::vector<bool> answered(scenes.size());
  const Clock::Time begin = clock.now();
  const auto replies =
      model.ask(scenes, begin + from_seconds(budget), [&](const Progress& progress) {
        if (progress.answer != nullptr && !answered[progress.prompt]) {
          answered[progress.prompt] = true;
          asked.first = to_seconds(clock.now() - begin);
        }
      });
  asked.whole = to_seconds(clock.now() - begin);
  asked.missing = static_cast<int>(scenes.size());
  if (replies.has_value()) {
    asked.replies = replies.value();
    for (const Reply& reply : asked.replies) {
      asked.missing -= reply.answers.empty() ? 0 : 1;
      asked.forced += !reply.answers.empty() && reply.answers.back().kind == Answer::Kind::forced;
    }
  } else {
    asked.error = replies.error();
  }
  return asked;
}

class BenchFigures {
 public:
  void put(const std::string& name, double value) {
    numbers_.emplace_back("reason." + name, value);
  }
  void put_times(const std::string& name, const std::vector<double>& values) {
    put(name + ".p50", percentile(values, 0.5));
    put(name + ".p99", percentile(values, 0.99));
    put(name + ".max", percentile(values, 1.0));
    put(name + ".n", static_cast<double>(values.size()));
  }
  void put_text(const std::string& name, const std::string& text) {
    texts_.emplace_back("meta." + name, text);
  }
  void print(bool as_json) const {
    if (as_json) {
      nlohmann::ordered_json document;
      for (const auto& [name, value] : numbers_) {
        document[name] = value;
      }
      for (const auto& [name, text] : texts_) {
        document[name] = text;
      }
      app::print_json(document);
      return;
    }
    for (const auto& [name, text] : texts_) {
      app::print("{:36} {}\n", name, text);
    }
    for (const auto& [name, value] : numbers_) {
      app::print("{:36} {:.4g}\n", name, value);
    }
  }

 private:
  std::vector<std::pair<std::string, double>> numbers_;
  std::vector<std::pair<std::string, std::string>> texts_;
};

// Of the questions that had all their answers.
std::vector<double> of(const std::vector<QuestionTiming>& all, double QuestionTiming::*what) {
  std::vector<double> values;
  for (const QuestionTiming& asked : all) {
    if (asked.missing == 0) {
      values.push_back(asked.*what);
    }
  }
  return values;
}

// Sum over all questions of prompt or reply tokens per second of the model's own time.
double rate(const std::vector<QuestionTiming>& all, int Reply::*tokens,
            double language_model::ChildModelFigures::*time) {
  double sum_tokens = 0.0;
  double sum_time = 0.0;
  for (const QuestionTiming& asked : all) {
    for (const Reply& reply : asked.replies) {
      sum_tokens += reply.*tokens;
    }
    sum_time += asked.figures.*time;
  }
  return sum_time > 0.0 ? sum_tokens / sum_time : 0.0;
}

/// The model's own part of each question, and what is left for answers and the way between the
/// processes.
void put_child_figures(ChildModel& child, double load, const std::vector<QuestionTiming>& one,
                       const std::vector<QuestionTiming>& three, const Clock& clock,
                       BenchFigures& figures) {
  using Parts = language_model::ChildModelFigures;
  figures.put("load_s", load);
  figures.put("system_tokens", child.figures().system_tokens);
  figures.put("restarts", child.restarts());
  figures.put("prompt_tokens_per_s", rate(one, &Reply::prompt_tokens, &Parts::prompt_time));
  figures.put("reply_tokens_per_s", rate(one, &Reply::reply_tokens, &Parts::reply_time));
  figures.put("three_reply_tokens_per_s", rate(three, &Reply::reply_tokens, &Parts::reply_time));
  std::vector<double> rest(one.size());
  std::transform(one.begin(), one.end(), rest.begin(), [](const QuestionTiming& asked) {
    return asked.whole - asked.figures.prompt_time - asked.figures.reply_time;
  });
  figures.put("answers_and_process_s", percentile(rest, 0.5));
  if (const auto info = child.info(clock.now() + from_seconds(1.0)); info.has_value()) {
    figures.put("child_resident_mib", static_cast<double>(info.value().resident_bytes) / (1 << 20));
  }
}

struct ModelBenchOptions {
  std::string model = "local";
  int runs = 10;
  bool as_json = false;
};

int model_bench(const ModelBenchOptions& options) {
  const auto places = find_places();
  if (!places.has_value()) {
    return refused(places.error());
  }
  SteadyClock clock;
  const auto opened = open_needed_model(places.value(), options.model, runtime::Pace::real, clock);
  if (!opened.has_value()) {
    return refused(opened.error());
  }
  LanguageModel& model = *opened.value();
  auto* const child = dynamic_cast<ChildModel*>(&model);
  const double load = child == nullptr ? 0.0 : child->figures().load_time;
  const std::vector<std::string> scenes = example_scenes();
  std::vector<QuestionTiming> one;
  std::vector<QuestionTiming> three;
  const auto ask_about = [&](const std::vector<std::string>& some, double budget) {
    QuestionTiming asked = ask(model, some, budget, clock);
    if (child != nullptr && !asked.error) {
      asked.figures = child->figures();
    }
    return asked;
  };
  for (int run = 0; run < options.runs; ++run) {
    one.push_back(ask_about({scenes[0]}, without_haste));
    if (one.back().error) {
      return unanswered(*one.back().error);
    }
    three.push_back(ask_about(scenes, preview_time));
  }
  // Where three at a time never have all their answers in time, that is a figure, too.
  const bool some_in_time = !of(three, &QuestionTiming::whole).empty();
  BenchFigures figures;
  figures.put_text("model", model.description());
  figures.put("prompt_tokens", one.front().replies[0].prompt_tokens);
  figures.put_times("first_answer_s", of(one, &QuestionTiming::first));
  figures.put_times("full_answer_s", of(one, &QuestionTiming::whole));
  if (some_in_time) {
    figures.put_times("three_first_answers_s", of(three, &QuestionTiming::first));
    figures.put_times("three_previews_s", of(three, &QuestionTiming::whole));
  }
  const auto misses = std::count_if(three.begin(), three.end(), [](const QuestionTiming& asked) {
    return asked.missing > 0 || asked.whole > preview_time;
  });
  const auto overruns = std::count_if(
      three.begin(), three.end(), [](const QuestionTiming& a) { return a.whole > preview_time; });
  figures.put("deadline_misses", static_cast<double>(misses));
  figures.put("returned_after_deadline", static_cast<double>(overruns));
  const auto forced = [](int sum, const QuestionTiming& asked) { return sum + asked.forced; };
  figures.put("forced_share", std::accumulate(three.begin(), three.end(), 0, forced) /
                                  static_cast<double>(3 * three.size()));
  if (child != nullptr) {
    put_child_figures(*child, load, one, three, clock, figures);
  }
  figures.print(options.as_json);
  return success;
}

}  // namespace

void add_model_bench(CLI::App& model, int& exit_code) {
  CLI::App* const command = model.add_subcommand(
      "bench", "How fast it answers, about one forecast without haste and three in 4.2 s");
  const auto options = std::make_shared<ModelBenchOptions>();
  command->add_option("--llm", options->model, "As of `saca reason`")->capture_default_str();
  command->add_option("--runs", options->runs)->check(CLI::Range(1, 10'000))->capture_default_str();
  command->add_flag("--json", options->as_json, "One flat object");
  command->callback([options, &exit_code] { exit_code = model_bench(*options); });
}

}  // namespace saca::app
