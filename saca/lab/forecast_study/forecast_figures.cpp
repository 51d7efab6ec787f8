#include "saca/lab/forecast_study/forecast_figures.h"

#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

namespace saca::forecast_study {
namespace {

using eval::forecast_times;
using eval::ForecastSample;
using eval::MotionModel;

/// Is it in the central region along or across that holds so many per cent?
template <double eval::PlaceScore::*pit, int percent>
double is_within(const ForecastSample& sample, std::size_t model, std::size_t time) {
  return std::abs(sample.scores[model][time].*pit - 0.5) < 0.005 * percent ? 1.0 : 0.0;
}

constexpr std::array<ForecastFigure, 9> score_figures{{
    {"nll", "negative log likelihood", true,
     [](const ForecastSample& s, std::size_t m, std::size_t t) { return s.scores[m][t].nll; }},
    {"miss_of_6", "least miss of 6 [m]", true,
     [](const ForecastSample& s, std::size_t m, std::size_t t) { return s.scores[m][t].miss; }},
    {"missed", "share more than 2 m off", true,
     [](const ForecastSample& s, std::size_t m, std::size_t t) {
       return s.scores[m][t].miss > 2.0 ? 1.0 : 0.0;
     }},
    {"within_50_along", "in the 50 % region along", true,
     is_within<&eval::PlaceScore::pit_along, 50>},
    {"within_90_along", "in the 90 % region along", true,
     is_within<&eval::PlaceScore::pit_along, 90>},
    {"within_50_across", "in the 50 % region across", true,
     is_within<&eval::PlaceScore::pit_across, 50>},
    {"within_90_across", "in the 90 % region across", true,
     is_within<&eval::PlaceScore::pit_across, 90>},
    {"mean_miss_of_6", "least mean miss of 6 [m]", false,
     [](const ForecastSample& s, std::size_t m, std::size_t) { return s.mean_miss_of_6[m]; }},
    {"mean_miss_of_12", "least mean miss of 12 [m]", false,
     [](const ForecastSample& s, std::size_t m, std::size_t) { return s.mean_miss_of_12[m]; }},
}};

/// Which road users count, and in which figures.
struct Selection {
  std::string name;
  std::function<bool(const EncounterForecasts&)> encounter;
  std::function<bool(const ForecastSample&)> sample;
  std::size_t num_figures = score_figures.size();  ///< the first of them
};

/// What an encounter counts for in one figure of one model; nullopt: nobody in it counts.
std::optional<double> mean_in(const EncounterForecasts& encounter, const Selection& selection,
                              const FigureLine& line) {
  if (!selection.encounter(encounter)) {
    return std::nullopt;
  }
  double sum = 0.0;
  int n = 0;
  for (const ForecastSample& one : encounter.samples) {
    if (selection.sample(one)) {
      sum += score_figures[line.figure].value(one, static_cast<std::size_t>(line.model), line.time);
      ++n;
    }
  }
  return n == 0 ? std::nullopt : std::optional(sum / n);
}

using Values = std::vector<std::optional<double>>;  // one for each encounter

Values differences(const Values& values, const Values& from) {
  Values above = values;
  for (std::size_t i = 0; i < above.size(); ++i) {
    above[i] = above[i] ? std::optional(*above[i] - *from[i]) : std::nullopt;
  }
  return above;
}

/// Of all models, one figure at one time.
void add_models(const ForecastStudy& study, const Selection& selection, FigureLine line,
                std::uint64_t seed, std::vector<FigureLine>& lines) {
  std::array<Values, eval::motion_models.size()> values;
  for (std::size_t m = 0; m < values.size(); ++m) {
    line.model = eval::motion_models[m];
    for (const EncounterForecasts& one : study.encounters) {
      values[m].push_back(mean_in(one, selection, line));
    }
  }
  const Values& shipped = values[static_cast<std::size_t>(MotionModel::shipped)];
  for (std::size_t m = 0; m < values.size(); ++m) {
    line.model = eval::motion_models[m];
    line.mean = eval::mean_over_encounters(values[m], seed);
    line.above_shipped =
        line.figure == 0 && line.model != MotionModel::shipped
            ? std::optional(eval::mean_over_encounters(differences(values[m], shipped), seed))
            : std::nullopt;
    lines.push_back(line);
  }
}

std::vector<Selection> selections_of(const ForecastStudy& study) {
  const auto any = [](const EncounterForecasts&) { return true; };
  const auto acts = [](const ForecastSample& one) { return one.acts; };
  std::vector<Selection> selections{
      {"all", any, [](const ForecastSample&) { return true; }},
      {"acting", any, acts},
      {"aside", any, [](const ForecastSample& one) { return one.aside; }}};
  std::set<std::string> families;
  for (const EncounterForecasts& one : study.encounters) {
    families.insert(one.family);
  }
  for (const std::string& family : families) {
    selections.push_back({family + "_acting",
                          [family](const EncounterForecasts& one) { return one.family == family; },
                          acts, 1});
  }
  return selections;
}

}  // namespace

std::span<const ForecastFigure> forecast_figures() {
  return score_figures;
}

StudyFigures figures_of(const ForecastStudy& study, std::uint64_t seed) {
  StudyFigures figures{.num_encounters = study.encounters.size(), .groups = {}};
  for (const EncounterForecasts& one : study.encounters) {
    figures.num_failed += one.problem.empty() ? 0 : 1;
    figures.num_forecasts += one.samples.size();
    for (const ForecastSample& sample : one.samples) {
      figures.num_acting += sample.acts ? 1U : 0U;
    }
  }
  for (const Selection& selection : selections_of(study)) {
    FigureGroup group{.name = selection.name, .lines = {}};
    for (std::size_t f = 0; f < selection.num_figures; ++f) {
      for (std::size_t t = 0; t < (score_figures[f].each_time ? forecast_times.size() : 1); ++t) {
        add_models(study, selection, {.figure = f, .time = t, .mean = {}}, seed, group.lines);
      }
    }
    figures.groups.push_back(std::move(group));
  }
  return figures;
}

std::vector<std::string> problems_of(const ForecastStudy& study) {
  std::vector<std::string> problems;
  for (const EncounterForecasts& one : study.encounters) {
    if (!one.problem.empty()) {
      problems.push_back(one.problem);
    }
  }
  return problems;
}

}  // namespace saca::forecast_study
