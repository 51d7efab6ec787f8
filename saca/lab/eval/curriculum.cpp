#include "saca/lab/eval/curriculum.h"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/lab/encounter/learnt_case.h"
#include "saca/lab/encounter/saca_method.h"
#include "saca/lab/eval/methods.h"
#include "saca/lab/scenario/chance.h"
#include "saca/onboard/reflex/verdict.h"
#include "saca/thinking/memory/case_json.h"
#include "saca/thinking/memory/experience.h"

namespace saca::eval {
namespace {

using memory::Case;
using memory::PolicyHarms;
using nlohmann::json;

constexpr std::array all_learners{Learner::frozen, Learner::learning, Learner::poisoned};

std::size_t index(Learner who) {
  return static_cast<std::size_t>(who);
}

void mirror(PolicyHarms& harms) {
  double least = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const auto& harm : harms) {
    if (harm) {
      least = std::min(least, *harm);
      largest = std::max(largest, *harm);
    }
  }
  for (auto& harm : harms) {
    if (harm) {
      harm = least + largest - *harm;
    }
  }
}

manoeuvre::PolicyId harms_least(const PolicyHarms& harms) {
  const auto* const least =
      std::min_element(harms.begin(), harms.end(), [](const auto& a, const auto& b) {
        return a && (!b || *a < *b);  // who cannot be driven is last
      });
  return manoeuvre::policy_from(static_cast<int>(least - harms.begin())).value();
}

/// "; told most wrongly AES-L: 0.0312 told, 0.4000 happened"; empty where all was as told.
std::string most_wrong(const Case& one) {
  std::optional<std::size_t> most;
  const auto error = [&](std::size_t k) {
    const auto& told = one.told->at(k);
    const auto& happened = one.happened->at(k);
    return told && happened ? std::abs(*happened - *told) : 0.0;
  };
  for (std::size_t k = 0; one.told && one.happened && k < manoeuvre::num_policies; ++k) {
    if (error(k) > memory::as_good && (!most || error(k) > error(*most))) {
      most = k;
    }
  }
  return most ? fmt::format("; told most wrongly {}: {:.4f} told, {:.4f} happened",
                            name(manoeuvre::policy_from(static_cast<int>(*most)).value()),
                            *one.told->at(*most), *one.happened->at(*most))
              : std::string();
}

/// What is drawn for an encounter besides its chance.
class EpisodeDraws {
 public:
  EpisodeDraws(std::uint64_t seed, std::uint64_t number)
      : rng_(scenario::generator(~seed, number)) {}
  [[nodiscard]] bool happens(double probability) {
    return std::generate_canonical<double, 53>(rng_) < probability;
  }

 private:
  std::mt19937_64 rng_;
};

json json_of(const std::optional<match::CaseId>& id) {
  return id ? json(*id) : json();
}

}  // namespace

Case upside_down(Case one) {
  if (one.happened) {
    mirror(*one.happened);
    one.told = one.happened;  // or the two would contradict each other, and nothing be believed
    one.best = harms_least(*one.happened);
    one.best_harm = one.happened->at(manoeuvre::index(one.best)).value_or(one.best_harm);
  }
  return one;
}

bool misleads(const Episode& episode) {
  return episode.one && episode.is_lie &&
         memory::contradict(*episode.one, upside_down(*episode.one));
}

Case taught(const Episode& episode, Learner who) {
  expects(episode.one.has_value(), "the episode teaches something");
  Case one = *episode.one;
  const MethodRun& run = episode.row.risk.runs.at(index(who));
  one.plan = run.plan.value_or(manoeuvre::doing_nothing);
  one.harm = run.harm;
  one.collision_loss = run.collision_loss;
  one.origin = memory::Origin::own;
  if (who == Learner::poisoned && episode.is_lie) {
    one = upside_down(std::move(one));
  }
  one.review = fmt::format("{}: harm {:.4f}; best {}: {:.4f}{}", name(one.plan.policy), one.harm,
                           name(one.best), one.best_harm, most_wrong(one));
  return one;
}

json to_json(const Episode& episode) {
  json refuted = json::array();
  for (const auto& id : episode.refuted) {
    refuted.push_back(json_of(id));
  }
  return {{"row", to_json(episode.row)},
          {"case", episode.one ? memory::to_json(*episode.one) : json()},
          {"lie", episode.is_lie},
          {"refuted", std::move(refuted)}};
}

Result<Episode> episode_from_json(const json& in) {
  try {
    auto row = suite_row_from_json(in.at("row"), curriculum_methods.size());
    if (!row.has_value()) {
      return row.error();
    }
    Episode episode{.row = std::move(row).value(),
                    .one = std::nullopt,
                    .is_lie = in.at("lie").get<bool>(),
                    .refuted = {}};
    if (!in.at("case").is_null()) {
      auto one = memory::case_from_json(in.at("case"));
      if (!one.has_value()) {
        return one.error();
      }
      episode.one = std::move(one).value();
    }
    for (std::size_t i = 0; i < num_learners; ++i) {
      const json& id = in.at("refuted").at(i);
      episode.refuted.at(i) = id.is_null() ? std::nullopt : std::optional(id.get<match::CaseId>());
    }
    return episode;
  } catch (const std::exception& problem) {
    return Error{Error::Code::malformed,
                 fmt::format("want one episode of a curriculum: {}", problem.what())};
  }
}

Result<Curriculum> Curriculum::begin(CurriculumSetup setup, std::span<const Case> start,
                                     const std::filesystem::path& folder) {
  constexpr std::array<const char*, num_learners> files{"frozen.sqlite", "learning.sqlite",
                                                        "poisoned.sqlite"};
  expects(setup.lies >= 0.0 && setup.lies <= 1.0, "lies are a share");
  Curriculum curriculum(std::move(setup));
  for (const char* const file : files) {
    const std::filesystem::path place = folder / file;
    std::error_code ignored;  // what is in the way is told by who opens it
    for (const char* const part : {"", "-journal"}) {
      std::filesystem::remove(place.string() + part, ignored);
    }
    auto bank = memory::Store::open(place.string(), curriculum.setup_.made_with);
    if (!bank.has_value()) {
      return bank.error();
    }
    curriculum.memories_.push_back(std::move(bank).value());
    if (const auto added = curriculum.memories_.back().add_all(start); !added.has_value()) {
      return added.error();
    }
    if (auto problem = curriculum.memories_.back().catch_up()) {
      return *std::move(problem);
    }
  }
  return curriculum;
}

std::string Curriculum::compare_all(const SuiteEncounter& encounter, const encounter::Stage& stage,
                                    Episode& episode) {
  Hindsight hindsight(*stage.car, *stage.harm);
  const runtime::PlanesSetup shared = with_shared_verdicts(setup_.saca);
  std::vector<std::unique_ptr<encounter::Method>> methods;
  std::vector<const encounter::SacaMethod*> learners;
  for (const Learner who : all_learners) {
    runtime::PlanesSetup saca = shared;
    saca.memory = &of(who);
    auto method = std::make_unique<encounter::SacaMethod>(saca, *setup_.intent);
    learners.push_back(method.get());
    methods.push_back(std::move(method));
  }
  for (const char* const name : {"beliefs_drawn", "beliefs_and_experience", "aeb"}) {
    methods.push_back(make_method(name, {.saca = shared,
                                         .hindsight = &hindsight,
                                         .intent = setup_.intent,
                                         .experience = &of(Learner::learning).experience(),
                                         .seed = encounter_seed(setup_.seed, encounter.number)}));
  }
  auto compared = compare(stage, methods, hindsight);
  if (!compared.has_value()) {
    return compared.error().message;
  }
  episode.row.risk = std::move(compared).value();
  const auto& runs = episode.row.risk.runs;
  const auto faulty = std::find_if(runs.begin(), runs.end(),
                                   [](const MethodRun& run) { return !run.fault.empty(); });
  if (faulty != runs.end()) {
    return faulty->fault;
  }
  for (std::size_t i = 0; i < num_learners; ++i) {
    if (runs.at(i).harm > runs.back().harm + reflex::material_harm) {
      episode.refuted.at(i) = learners.at(i)->followed();
    }
  }
  return {};
}

Episode Curriculum::play(const SuiteEncounter& encounter) {
  EpisodeDraws draws(setup_.seed, encounter.number);
  const bool is_twin = draws.happens(0.5) && encounter.twin.has_value();
  const SuiteOptions how{.methods = {}, .seed = setup_.seed, .exact = setup_.exact};
  Episode episode{.row = {.number = encounter.number,
                          .family = encounter.family,
                          .fault = {},
                          .risk = {},
                          .twin = {},
                          .driver = {}},
                  .one = std::nullopt,
                  .is_lie = draws.happens(setup_.lies),
                  .refuted = {}};
  const scenario::Scenario world = as_played(is_twin ? *encounter.twin : encounter.scenario, how);
  const encounter::Stage stage =
      stage_of(world, encounter.number, how, setup_.saca, *setup_.intent);
  try {
    episode.row.fault = compare_all(encounter, stage, episode);
    if (!episode.row.fault.empty()) {
      return episode;
    }
    JudgingOptions judging = setup_.judging;
    judging.seed = encounter_seed(setup_.seed, encounter.number);
    const auto judged = judged_encounter(stage, setup_.saca.forecast, judging, setup_.made_with);
    if (!judged.has_value()) {
      episode.row.fault = judged.error().message;
    } else if (judged.value()) {
      episode.one = judged.value()->one;
    }
  } catch (const std::exception& fault) {
    episode.row.fault = fault.what();
  }
  return episode;
}

std::optional<Error> Curriculum::learn(const Episode& episode) {
  if (!episode.row.fault.empty()) {
    return std::nullopt;
  }
  for (const Learner who : {Learner::learning, Learner::poisoned}) {
    const std::optional<match::CaseId>& refuted = episode.refuted.at(index(who));
    if (!episode.one) {
      auto problem = refuted ? encounter::quarantine(of(who), *refuted) : std::nullopt;
      if (problem) {
        return problem;
      }
      continue;
    }
    const auto learnt = encounter::learn(of(who), taught(episode, who), refuted);
    if (!learnt.has_value()) {
      return learnt.error();
    }
  }
  return std::nullopt;
}

std::array<std::size_t, num_learners> Curriculum::sizes() const {
  std::array<std::size_t, num_learners> sizes{};
  std::transform(memories_.begin(), memories_.end(), sizes.begin(),
                 [](const memory::Store& one) { return one.size(); });
  return sizes;
}

Estimate mean_over_seeds(std::span<const double> values) {
  expects(!values.empty(), "at least one seed");
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double half = 0.0;
  if (values.size() > 1) {
    double squares = 0.0;
    for (const double value : values) {
      squares += (value - mean) * (value - mean);
    }
    constexpr double upper = 0.975;
    half = boost::math::quantile(boost::math::students_t(n - 1.0), upper) *
           std::sqrt(squares / (n - 1.0) / n);
  }
  return {.value = mean, .low = mean - half, .high = mean + half, .n = static_cast<int>(n)};
}

}  // namespace saca::eval
