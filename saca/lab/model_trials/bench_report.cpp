#include "saca/lab/model_trials/bench_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "saca/base/core/percentile.h"

namespace saca::model_trials {

using language_model::ChildModel;
using language_model::Reply;

namespace {

void put(BenchFigures& figures, const std::string& name, double value) {
  figures.numbers.emplace_back("reason." + name, value);
}

void put_times(BenchFigures& figures, const std::string& name, const std::vector<double>& values) {
  put(figures, name + ".p50", percentile(values, 0.5));
  put(figures, name + ".p99", percentile(values, 0.99));
  put(figures, name + ".max", percentile(values, 1.0));
  put(figures, name + ".n", static_cast<double>(values.size()));
}

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
void put_child_figures(BenchFigures& figures, const Bench& bench, ChildModel& child,
                       const Clock& clock) {
  using Parts = language_model::ChildModelFigures;
  put(figures, "load_s", bench.load);
  put(figures, "system_tokens", child.figures().system_tokens);
  put(figures, "restarts", child.restarts());
  put(figures, "prompt_tokens_per_s", rate(bench.one, &Reply::prompt_tokens, &Parts::prompt_time));
  put(figures, "reply_tokens_per_s", rate(bench.one, &Reply::reply_tokens, &Parts::reply_time));
  put(figures, "three_reply_tokens_per_s",
      rate(bench.three, &Reply::reply_tokens, &Parts::reply_time));
  std::vector<double> rest(bench.one.size());
  std::transform(bench.one.begin(), bench.one.end(), rest.begin(), [](const QuestionTiming& asked) {
    return asked.whole - asked.figures.prompt_time - asked.figures.reply_time;
  });
  put(figures, "answers_and_process_s", percentile(rest, 0.5));
  if (const auto info = child.info(clock.now() + from_seconds(1.0)); info.has_value()) {
    constexpr double mebi = 1024.0 * 1024.0;
    put(figures, "child_resident_mib", static_cast<double>(info.value().resident_bytes) / mebi);
  }
}

}  // namespace

BenchFigures bench_figures(const Bench& bench, language_model::LanguageModel& model,
                           const Clock& clock) {
  BenchFigures figures;
  figures.texts.emplace_back("meta.model", model.description());
  put(figures, "prompt_tokens", bench.one.front().replies[0].prompt_tokens);
  put_times(figures, "first_answer_s", of(bench.one, &QuestionTiming::first));
  put_times(figures, "full_answer_s", of(bench.one, &QuestionTiming::whole));
  const std::vector<QuestionTiming>& three = bench.three;
  if (!of(three, &QuestionTiming::whole).empty()) {
    put_times(figures, "three_first_answers_s", of(three, &QuestionTiming::first));
    put_times(figures, "three_previews_s", of(three, &QuestionTiming::whole));
  }
  const auto misses = std::count_if(three.begin(), three.end(), [](const QuestionTiming& asked) {
    return asked.missing > 0 || asked.whole > preview_time;
  });
  const auto overruns = std::count_if(
      three.begin(), three.end(), [](const QuestionTiming& a) { return a.whole > preview_time; });
  put(figures, "deadline_misses", static_cast<double>(misses));
  put(figures, "returned_after_deadline", static_cast<double>(overruns));
  const auto forced = [](int sum, const QuestionTiming& asked) { return sum + asked.forced; };
  put(figures, "forced_share",
      std::accumulate(three.begin(), three.end(), 0, forced) /
          (3.0 * static_cast<double>(three.size())));
  if (auto* const child = dynamic_cast<ChildModel*>(&model)) {
    put_child_figures(figures, bench, *child, clock);
  }
  return figures;
}

nlohmann::ordered_json bench_json(const BenchFigures& figures) {
  nlohmann::ordered_json document;
  for (const auto& [name, value] : figures.numbers) {
    document[name] = value;
  }
  for (const auto& [name, text] : figures.texts) {
    document[name] = text;
  }
  return document;
}

std::string bench_text(const BenchFigures& figures) {
  std::string lines;
  for (const auto& [name, text] : figures.texts) {
    lines += fmt::format("{:36} {}\n", name, text);
  }
  for (const auto& [name, value] : figures.numbers) {
    lines += fmt::format("{:36} {:.4g}\n", name, value);
  }
  return lines;
}

}  // namespace saca::model_trials
