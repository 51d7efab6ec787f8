// saca-weights merge BASE SHA256 ADAPTER OUT
//   adds a trained adapter to the weights that it was trained with
// saca-weights make TYPE IN OUT
//   rewrites weights as q8_0 or bf16
// saca-weights choose PROMPTS OUT REFERENCE [CANDIDATE...]
//   measures each file on this processor and writes to OUT which one to use: the fastest of those
//   that decide as REFERENCE does; and whether it is faster with flash attention. Exit code 3: the
//   machine is too busy to measure anything.
//   PROMPTS: the system part, then up to three scenes, each behind a line "====" and before a line
//   "----" and the grammar of what may be said of it.
#include <llama.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <thread>

#include "adapter.h"
#include "engine.h"

namespace {

using saca::model_host::AskFigures;
using saca::model_host::Engine;

constexpr int rounds = 3;                // the best of them counts: the machine may be busy
constexpr int reply_tokens = 100;        // per scene and round, at most: replies end before
constexpr std::size_t usual_reply = 47;  // tokens
// A round that takes longer than this measures how busy the machine is, not the weights [s].
constexpr auto longest_round = std::chrono::seconds(30);
constexpr std::string_view too_busy = "machine too busy to measure";
// What takes less of the other's time by no more than this is as fast: best rounds of the same
// weights differ by 2 %.
constexpr double as_fast = 0.97;
// Largest change of an answer's probability that still counts as deciding alike: rounding alone
// moves the untuned model's flat distribution by 0.03.
constexpr double probability_tolerance = 0.05;

struct Measurement {
  std::string path;
  bool flash_attention = false;
  std::vector<std::vector<double>> probabilities;  // per scene, of the eight answers
  double prompt_rate = 0.0;                        // [tokens/s]
  double reply_rate = 0.0;                         // three scenes together [tokens/s]
  double seconds = 1e9;  // the three scenes, prompts and replies of usual length
};

std::vector<double> softmax(std::vector<double> logits) {
  const double top = *std::max_element(logits.begin(), logits.end());
  double sum = 0.0;
  for (double& x : logits) {
    x = std::exp(x - top);
    sum += x;
  }
  for (double& x : logits) {
    x /= sum;
  }
  return logits;
}

// What is asked: what all scenes share, and each with the grammar of what may be said of it.
struct Prompts {
  std::string system;
  std::vector<std::string> scenes;
  std::vector<std::string> grammars;
};

// nullopt: each scene wants its grammar.
std::optional<Prompts> read_prompts(const std::string& path) {
  std::ifstream file(path);
  Prompts prompts;
  std::string* part = &prompts.system;
  for (std::string line; std::getline(file, line);) {
    if (line == "====" && prompts.scenes.size() == prompts.grammars.size()) {
      part = &prompts.scenes.emplace_back();
    } else if (line == "----" && prompts.scenes.size() == prompts.grammars.size() + 1) {
      part = &prompts.grammars.emplace_back();
    } else {
      *part += line + '\n';
    }
  }
  return prompts.scenes.size() == prompts.grammars.size() ? std::optional(std::move(prompts))
                                                          : std::nullopt;
}

int fail(const std::string& message) {
  std::cerr << "saca-weights: " << message << '\n';
  return 1;
}

int make(const std::string& type, const std::string& in, const std::string& out) {
  const std::map<std::string, llama_ftype> types{{"q8_0", LLAMA_FTYPE_MOSTLY_Q8_0},
                                                 {"bf16", LLAMA_FTYPE_MOSTLY_BF16}};
  if (!types.contains(type)) {
    return fail("make: want q8_0 or bf16, got " + type);
  }
  llama_model_quantize_params params = llama_model_quantize_default_params();
  params.allow_requantize = true;
  params.pure = true;
  params.ftype = types.at(type);
  const std::string unfinished = out + ".part";
  if (llama_model_quantize(in.c_str(), unfinished.c_str(), &params) != 0) {
    return fail("cannot rewrite " + in + " as " + unfinished);
  }
  std::filesystem::rename(unfinished, out);
  return 0;
}

// One round of a file: its best figures so far are kept. Empty, or what went wrong.
std::string measure(Engine& engine, const Prompts& prompts, Measurement& m) {
  saca::SteadyClock clock;
  m.probabilities.resize(prompts.scenes.size());
  const saca::model_host::EngineEvents events{
      [](std::size_t, int) {}, [](std::size_t, std::string_view) {},
      [&](std::size_t scene, saca::model_host::AnswerKind kind, const std::vector<double>& logits) {
        if (kind == saca::model_host::AnswerKind::first) {
          m.probabilities[scene] = softmax(logits);
        }
      }};
  const auto begin = clock.now();
  const auto asked =
      engine.ask(prompts.scenes, begin + longest_round,
                 {.max_tokens = reply_tokens, .grammars = prompts.grammars}, clock, events);
  if (!asked.has_value()) {
    return asked.error().message;
  }
  const AskFigures& f = asked.value();
  const int prompt = std::accumulate(f.prompt_tokens.begin(), f.prompt_tokens.end(), 0);
  const int reply = std::accumulate(f.reply_tokens.begin(), f.reply_tokens.end(), 0);
  if (reply == 0 || clock.now() - begin >= longest_round * 9 / 10) {
    return std::string(too_busy);
  }
  m.prompt_rate = std::max(m.prompt_rate, prompt / f.prompt_seconds);
  m.reply_rate = std::max(m.reply_rate, reply / f.reply_seconds);
  // Replies of other weights are of other length: each token counts as much as its like.
  m.seconds = std::min(
      m.seconds, f.prompt_seconds + f.reply_seconds / reply *
                                        static_cast<double>(usual_reply * prompts.scenes.size()));
  return {};
}

// All files turn by turn, so that a machine that gets busy slows them all.
std::string measure_all(const Prompts& prompts, std::vector<Measurement>& all) {
  saca::SteadyClock clock;
  std::vector<std::shared_ptr<Engine>> engines;
  const int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U));
  for (const Measurement& m : all) {
    const auto loaded = Engine::load(
        {.model_path = m.path, .threads = threads, .flash_attention = m.flash_attention});
    if (!loaded.has_value()) {
      return loaded.error().message;
    }
    engines.push_back(loaded.value());
    if (const auto system = engines.back()->set_system(prompts.system, clock);
        !system.has_value()) {
      return system.error().message;
    }
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (std::string error = measure(*engines[i], prompts, all[i]); !error.empty()) {
        return error;
      }
    }
  }
  return {};
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) {
      return line.substr(line.find(':') + 2);
    }
  }
  return "unknown";
}

std::vector<std::ptrdiff_t> decisions(const Measurement& m) {
  std::vector<std::ptrdiff_t> result;
  for (const std::vector<double>& p : m.probabilities) {
    result.push_back(std::max_element(p.begin(), p.end()) - p.begin());
  }
  return result;
}

double largest_shift(const Measurement& a, const Measurement& b) {
  double shift = 0.0;
  for (std::size_t scene = 0; scene < a.probabilities.size(); ++scene) {
    for (std::size_t i = 0; i < a.probabilities[scene].size(); ++i) {
      shift = std::max(shift, std::abs(a.probabilities[scene][i] - b.probabilities[scene][i]));
    }
  }
  return shift;
}

int choose(const std::string& prompt_file, const std::string& out,
           const std::vector<std::string>& files) {
  const std::optional<Prompts> read = read_prompts(prompt_file);
  if (!read || read->scenes.empty() || read->scenes.size() > saca::model_host::max_scenes) {
    return fail(prompt_file + ": want a system part and 1 to 3 scenes, each with its grammar");
  }
  const Prompts& prompts = *read;
  std::vector<Measurement> all;
  for (const std::string& file : files) {
    all.push_back({.path = file});
  }
  const auto told = [](const std::string& error) {
    fail(error);
    return error == too_busy ? 3 : 1;
  };
  if (const std::string error = measure_all(prompts, all); !error.empty()) {
    return told(error);
  }
  const auto decides_alike = [&](const Measurement& m) {
    return largest_shift(m, all.front()) <= probability_tolerance &&
           decisions(m) == decisions(all.front());
  };
  std::size_t best = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    best = decides_alike(all[i]) && all[i].seconds < all[best].seconds ? i : best;
  }
  // Both again, turn by turn: what came before may have been measured on a busier machine.
  std::vector<Measurement> both{{.path = all[best].path},
                                {.path = all[best].path, .flash_attention = true}};
  if (const std::string error = measure_all(prompts, both); !error.empty()) {
    return told(error);
  }
  const bool flash = decides_alike(both[1]) && both[1].seconds < as_fast * both[0].seconds;
  all.insert(all.end(), both.begin(), both.end());
  nlohmann::ordered_json json{{"schema", "saca.weights/1"}, {"processor", processor()}};
  for (const Measurement& m : all) {
    json["measured"].push_back({{"file", std::filesystem::path(m.path).filename()},
                                {"flash_attention", m.flash_attention},
                                {"prompt_tokens_per_s", std::round(m.prompt_rate)},
                                {"reply_tokens_per_s", std::round(m.reply_rate)},
                                {"three_scenes_s", std::round(m.seconds * 1e3) / 1e3},
                                {"largest_probability_shift", largest_shift(m, all.front())},
                                {"decides_alike", decides_alike(m)}});
  }
  json["weights"] = std::filesystem::path(all[best].path).filename();
  json["flash_attention"] = flash;
  std::ofstream(out + ".part") << json.dump(2) << '\n';
  std::filesystem::rename(out + ".part", out);
  std::cout << json.dump(2) << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  llama_log_set(
      [](ggml_log_level level, const char* text, void*) {
        if (level == GGML_LOG_LEVEL_ERROR) {
          std::cerr << text;
        }
      },
      nullptr);
  const std::vector<std::string> args(argv + 1, argv + argc);
  if (args.size() == 5 && args[0] == "merge") {
    const auto problem = saca::model_host::merge_adapter(args[1], args[2], args[3], args[4]);
    return problem ? fail(problem->message) : 0;
  }
  if (args.size() == 4 && args[0] == "make") {
    return make(args[1], args[2], args[3]);
  }
  if (args.size() >= 4 && args[0] == "choose") {
    return choose(args[1], args[2], {args.begin() + 3, args.end()});
  }
  return fail(
      "want: merge BASE SHA256 ADAPTER OUT, make TYPE IN OUT, or choose PROMPTS OUT REFERENCE "
      "[CANDIDATE...]");
}
