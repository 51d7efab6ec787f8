#include "saca/lab/suites/ladder.h"

#include <array>
#include <utility>

#include "saca/lab/suites/method_list.h"

namespace saca::suites {
namespace {

constexpr std::array<Rung, 12> usual_rungs{{
    {"oracle", nullptr, "Best in hindsight."},
    {"true_rolled_out", "oracle", "not knowing the grip, nor how the car differs from its data"},
    {"true_atlas", "true_rolled_out",
     "the atlas in place of full dynamics: first contacts only, and "
     "nobody reacts to what is done"},
    {"beliefs_rolled_out", "true_rolled_out", "believing in place of knowing what the others do"},
    {"beliefs_atlas", "beliefs_rolled_out", "the atlas in place of full dynamics"},
    {"going_on_atlas", "beliefs_atlas", "taking all others to go on as they do"},
    {"newest_forecast", "going_on_atlas",
     "choosing from the newest forecast, not from the scene at T1"},
    {"first_forecast", "newest_forecast", "choosing from the first forecast, some seconds earlier"},
    {"aeb", "first_forecast", "always braking"},
    {"beliefs_and_grip", "beliefs_rolled_out", "told the true grip and car"},
    {"beliefs_and_followers", "beliefs_rolled_out", "told how followers react"},
    {"beliefs_and_hidden", "beliefs_rolled_out", "seeing everybody without noise or latency"},
}};

/// Where there is a memory or a model; without either SACA always brakes.
constexpr Rung saca_rung{"saca", "aeb", "what memory and model hold, in place of always braking"};

/// Where there is a memory.
constexpr std::array<Rung, 2> experience_rungs{{
    {"beliefs_drawn", "beliefs_rolled_out", "over draws of all that is not known of the others"},
    {"beliefs_and_experience", "beliefs_drawn", "corrected by what happened in like cases"},
}};

/// Where there are weights of V_h.
constexpr std::array<Rung, 3> danger_rungs{{
    {"least_danger", "going_on_atlas", "how much room is left in place of harm"},
    {"least_joint_danger", "least_danger", "V_h beside all in place of the highest single one"},
    {"beliefs_and_danger", "beliefs_atlas", "what harms alike goes by V_h, not by mildness"},
}};

}  // namespace

std::vector<Rung> rungs_with(const ThinkingOptions& thinking, const std::string& danger) {
  std::vector<Rung> rungs(usual_rungs.begin(), usual_rungs.end());
  if (!danger.empty()) {
    rungs.insert(rungs.end(), danger_rungs.begin(), danger_rungs.end());
  }
  if (!thinking.memory.empty()) {
    rungs.insert(rungs.end(), experience_rungs.begin(), experience_rungs.end());
  }
  if (!thinking.memory.empty() || thinking.model != "off") {
    rungs.push_back(saca_rung);
  }
  return rungs;
}

std::vector<std::string> names_of(const std::vector<Rung>& rungs) {
  std::vector<std::string> names;
  names.reserve(rungs.size());
  for (const Rung& rung : rungs) {
    names.emplace_back(rung.method);
  }
  return names;
}

std::vector<RungFigures> climb(const SuiteRun& run, const std::vector<Rung>& rungs,
                               std::uint64_t seed) {
  std::vector<const eval::SuiteRow*> all;
  for (const eval::SuiteRow& row : run.rows) {
    all.push_back(&row);
  }
  const auto at = [&](const char* name) { return index_of(run.methods, name).value(); };
  auto figures = eval::suite_figures(all, run.methods, at("aeb"), seed);
  std::vector<RungFigures> climbed;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    climbed.push_back({rungs[i], std::move(figures[i]), std::nullopt});
    if (rungs[i].above != nullptr) {
      climbed.back().step = eval::harm_above(run.rows, i, at(rungs[i].above), seed);
    }
  }
  return climbed;
}

}  // namespace saca::suites
