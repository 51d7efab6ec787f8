#include "saca/lab/curricula/curriculum_json.h"

#include <fmt/core.h>

#include <array>

#include "saca/lab/eval/estimate_text.h"

namespace saca::curricula {
namespace {

using eval::add_estimate;
using eval::curriculum_methods;
using eval::Episode;
using eval::Episodes;
using eval::Learner;
using nlohmann::json;

struct NamedMeasure {
  const char* key;
  eval::EpisodeMeasure value;
};
constexpr std::array<NamedMeasure, 4> episode_measures{{
    {"harm", eval::episode_harm},
    {"regret", eval::episode_regret},
    {"materially_worse_than_aeb", eval::episode_worse_than_aeb},
    {"acts", eval::episode_acts},
}};

std::string key_of(const eval::MethodPair& pair, const std::string& block = "") {
  return fmt::format("{}.{}harm_over_{}", curriculum_methods.at(pair.method), block,
                     curriculum_methods.at(pair.other));
}

/// What only those who remember have.
void add_learner(json& out, const std::string& place, const std::vector<Episodes>& all,
                 std::size_t learner) {
  const encounter::ThinkingFigures thinking = eval::thought(all, learner);
  out[place + "forecasts"] = thinking.forecasts;
  out[place + "from_memory"] = thinking.from_memory;
  out[place + "asked_model"] = thinking.asked;
  out[place + "cases"] = eval::mean_size(all.back(), static_cast<Learner>(learner));
  out[place + "refuted"] = eval::count_episodes(all, [&](const Episode& one) {
    return one.row.fault.empty() && one.refuted.at(learner).has_value();
  });
}

}  // namespace

json json_of(const std::vector<Episodes>& all, const std::string& suite) {
  const std::string head = "learn." + suite + ".";
  const auto blocks = eval::blocks_of(all);
  json out;
  for (std::size_t m = 0; m < curriculum_methods.size(); ++m) {
    const std::string place = fmt::format("{}{}.", head, curriculum_methods.at(m));
    for (const NamedMeasure& measure : episode_measures) {
      add_estimate(out, place + measure.key, eval::over_seeds(all, m, measure.value));
    }
    if (m < eval::num_learners) {
      add_learner(out, place, all, m);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      add_estimate(out, fmt::format("{}block{}.regret", place, b + 1),
                   eval::over_seeds(blocks[b], m, eval::episode_regret));
    }
  }
  for (const eval::MethodPair& pair : eval::curriculum_pairs) {
    add_estimate(out, head + key_of(pair), eval::harm_over(all, pair));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      add_estimate(out, head + key_of(pair, fmt::format("block{}.", b + 1)),
                   eval::harm_over(blocks[b], pair));
    }
  }
  out[head + "lies"] = eval::count_episodes(all, eval::misleads);
  out[head + "episodes"] = all.size();
  out[head + "seeds"] = all.front().of.size();
  out[head + "faults"] =
      eval::count_episodes(all, [](const Episode& one) { return !one.row.fault.empty(); });
  return out;
}

}  // namespace saca::curricula
