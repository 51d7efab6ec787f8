#include "bench.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <ostream>

#include "saca/core/percentile.h"
#include "saca/reason/child_model.h"
#include "saca/reason/example_situation.h"
#include "saca/reason/prompt.h"
#include "saca/reason/reply.h"

namespace saca::model_host {
namespace {

using reason::Answer;
using reason::ChildModel;
using reason::Progress;
using reason::Reply;

constexpr double preview_time = 4.2;    // [s]: T2 - T1 of the paper
constexpr double without_haste = 60.0;  // [s]
constexpr double longest_load = 60.0;   // [s]

// Three forecasts that differ as previews do: in what the truck does, and what that leads to.
std::vector<std::string> example_scenes() {
  std::vector<std::string> scenes;
  for (const double speed : {7.5, 5.0, 2.5}) {
    preview::Situation situation = reason::example_situation();
    situation.scene_at_trigger.actors[0].v_W.y = -speed;
    situation.facts[1].outcome.contact->relative_speed += speed;
    scenes.push_back(reason::scene_part(situation, std::nullopt, 0.0));
  }
  return scenes;
}

/// What one question took.
struct Asked {
  double first = 0.0;  ///< until each scene had its first answer [s]
  double whole = 0.0;  ///< until the call returned [s]
  int missing = 0;     ///< scenes without any answer
  int forced = 0;      ///< scenes whose reply the deadline or the length cut
  std::vector<Reply> replies;
  reason::ChildModelFigures figures;
};

Asked ask(ChildModel& model, const std::vector<std::string>& scenes, double budget, Clock& clock) {
  Asked asked;
  const Clock::Time begin = clock.now();
  const auto replies =
      model.ask(scenes, begin + from_seconds(budget), [&](const Progress& progress) {
        if (progress.answer != nullptr && progress.answer->kind == Answer::Kind::first) {
          asked.first = to_seconds(clock.now() - begin);
        }
      });
  asked.whole = to_seconds(clock.now() - begin);
  asked.missing = static_cast<int>(scenes.size());
  if (replies.has_value()) {
    asked.replies = replies.value();
    asked.figures = model.figures();
    for (const Reply& reply : asked.replies) {
      asked.missing -= reply.answers.empty() ? 0 : 1;
      asked.forced += !reply.answers.empty() && reply.answers.back().kind == Answer::Kind::forced;
    }
  }
  return asked;
}

class Figures {
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
  void print(bool as_json, std::ostream& out) const {
    nlohmann::ordered_json json;
    for (const auto& [name, value] : numbers_) {
      json[name] = value;
    }
    for (const auto& [name, text] : texts_) {
      json[name] = text;
    }
    out << (as_json ? json.dump() : json.dump(1)) << '\n';
  }

 private:
  std::vector<std::pair<std::string, double>> numbers_;
  std::vector<std::pair<std::string, std::string>> texts_;
};

std::vector<double> of(const std::vector<Asked>& all, double Asked::*what) {
  std::vector<double> values(all.size());
  std::transform(all.begin(), all.end(), values.begin(),
                 [&](const Asked& asked) { return asked.*what; });
  return values;
}

// Sum over all questions of prompt or reply tokens per second of the model's own time.
double rate(const std::vector<Asked>& all, int Reply::*tokens,
            double reason::ChildModelFigures::*time) {
  double sum_tokens = 0.0;
  double sum_time = 0.0;
  for (const Asked& asked : all) {
    for (const Reply& reply : asked.replies) {
      sum_tokens += reply.*tokens;
    }
    sum_time += asked.figures.*time;
  }
  return sum_time > 0.0 ? sum_tokens / sum_time : 0.0;
}

void put_replies(const std::vector<Asked>& all, Figures& figures) {
  double faithful = 0.0;
  int quoting = 0;
  int replies = 0;
  int stated = 0;
  int forced = 0;
  for (const Asked& asked : all) {
    forced += asked.forced;
    const std::vector<std::string> scenes = example_scenes();
    for (std::size_t i = 0; i < asked.replies.size(); ++i) {
      const std::string& text = asked.replies[i].reasoning;
      ++replies;
      stated += text.ends_with("Response to user:") ? 1 : 0;
      if (const auto share = reason::faithful_share(text, scenes[i])) {
        faithful += *share;
        ++quoting;
      }
    }
  }
  const double n = std::max(replies, 1);
  figures.put("forced_share", forced / n);
  figures.put("states_an_answer_share", stated / n);
  figures.put("faithful_numbers", quoting > 0 ? faithful / quoting : 0.0);
  figures.put("faithful_numbers.n", quoting);
}

}  // namespace

int bench(const EngineSettings& settings, int runs, bool json, std::ostream& out) {
  SteadyClock clock;
  ChildModel model({.command = {"/proc/self/exe", "--model", settings.model_path, "--threads",
                                std::to_string(settings.threads)},
                    .system = reason::system_part(),
                    .identity = settings.model_path,
                    .max_tokens = 80},
                   clock);
  if (const auto error = model.wait_until_ready(clock.now() + from_seconds(longest_load))) {
    out << error->message << '\n';
    return 1;
  }
  const std::vector<std::string> scenes = example_scenes();
  std::vector<Asked> one;
  std::vector<Asked> three;
  for (int run = 0; run < runs; ++run) {
    one.push_back(ask(model, {scenes[0]}, without_haste, clock));
    three.push_back(ask(model, scenes, preview_time, clock));
  }
  Figures figures;
  figures.put_text("model", model.description());
  figures.put("load_s", model.figures().load_time);
  figures.put("system_tokens", model.figures().system_tokens);
  figures.put("prompt_tokens",
              one.front().replies.empty() ? 0 : one.front().replies[0].prompt_tokens);
  figures.put_times("first_answer_s", of(one, &Asked::first));
  figures.put_times("full_answer_s", of(one, &Asked::whole));
  figures.put_times("three_first_answers_s", of(three, &Asked::first));
  figures.put_times("three_previews_s", of(three, &Asked::whole));
  const auto misses = std::count_if(three.begin(), three.end(), [](const Asked& asked) {
    return asked.missing > 0 || asked.whole > preview_time;
  });
  const auto overruns = std::count_if(three.begin(), three.end(),
                                      [](const Asked& a) { return a.whole > preview_time; });
  figures.put("deadline_misses", static_cast<double>(misses));
  figures.put("returned_after_deadline", static_cast<double>(overruns));
  figures.put("restarts", model.restarts());
  figures.put("prompt_tokens_per_s",
              rate(one, &Reply::prompt_tokens, &reason::ChildModelFigures::prompt_time));
  figures.put("reply_tokens_per_s",
              rate(one, &Reply::reply_tokens, &reason::ChildModelFigures::reply_time));
  figures.put("three_reply_tokens_per_s",
              rate(three, &Reply::reply_tokens, &reason::ChildModelFigures::reply_time));
  put_replies(three, figures);
  if (const auto info = model.info(clock.now() + from_seconds(1.0)); info.has_value()) {
    figures.put("child_resident_mib", static_cast<double>(info.value().resident_bytes) / (1 << 20));
  }
  figures.print(json, out);
  if (!json && !three.back().replies.empty()) {
    out << "\nWhat it said of the first of three:\n" << three.back().replies[0].reasoning << '\n';
  }
  return 0;
}

}  // namespace saca::model_host
