#include <fmt/core.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/forecast_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/printing.h"
#include "apps/saca/suite_pages.h"
#include "apps/saca/surveying.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/forecast_score.h"
#include "saca/lab/eval/suite_figures.h"
#include "saca/lab/eval/traffic_drives.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

using eval::Estimate;
using eval::forecast_times;
using eval::ForecastSample;
using eval::MotionModel;
using nlohmann::json;

/// What an encounter had to say, or of recorded traffic all drives that share road users.
struct Heard {
  std::string family;
  std::string problem;
  std::vector<ForecastSample> samples;
};

/// Of all encounters.
struct AllHeard {
  std::vector<Heard> encounters;
  std::vector<std::string> notes;  ///< on where they come from, in sentences
};

using Value = double (*)(const ForecastSample& sample, std::size_t model, std::size_t time);

struct Figure {
  const char* name;
  const char* title;
  bool each_time;
  Value value;
};

/// Is it in the central region along or across that holds so many per cent?
template <double eval::PlaceScore::*pit, int percent>
double is_within(const ForecastSample& sample, std::size_t model, std::size_t time) {
  return std::abs(sample.scores[model][time].*pit - 0.5) < 0.005 * percent ? 1.0 : 0.0;
}

constexpr std::array<Figure, 9> score_figures{{
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

/// Of those that count in an encounter; nullopt: nobody does.
template <class Counts>
std::optional<double> mean_in(const Heard& heard, const Figure& figure, std::size_t model,
                              std::size_t time, const Counts& counts) {
  double sum = 0.0;
  int n = 0;
  for (const ForecastSample& one : heard.samples) {
    if (counts(one)) {
      sum += figure.value(one, model, time);
      ++n;
    }
  }
  return n == 0 ? std::nullopt : std::optional(sum / n);
}

/// All figures of some road users.
struct Group {
  std::string name;
  std::function<bool(const Heard&)> encounter;
  std::function<bool(const ForecastSample&)> sample;
  bool likelihood_only = false;
};

struct Line {
  MotionModel model{};
  std::size_t figure = 0;
  std::size_t time = 0;
  Estimate mean;
  std::optional<Estimate> above_shipped;  ///< paired, of the likelihood
};

std::vector<Line> lines_of(const std::vector<Heard>& all, const Group& group, std::uint64_t seed) {
  std::vector<Line> lines;
  for (std::size_t f = 0; f < (group.likelihood_only ? 1 : score_figures.size()); ++f) {
    for (std::size_t t = 0; t < (score_figures[f].each_time ? forecast_times.size() : 1); ++t) {
      std::array<std::vector<std::optional<double>>, eval::motion_models.size()> values;
      for (const Heard& heard : all) {
        for (std::size_t m = 0; m < values.size(); ++m) {
          values[m].push_back(group.encounter(heard)
                                  ? mean_in(heard, score_figures[f], m, t, group.sample)
                                  : std::nullopt);
        }
      }
      const auto& shipped = values[static_cast<std::size_t>(MotionModel::shipped)];
      for (std::size_t m = 0; m < values.size(); ++m) {
        Line line{.model = eval::motion_models[m],
                  .figure = f,
                  .time = t,
                  .mean = eval::mean_over_encounters(values[m], seed)};
        if (f == 0 && line.model != MotionModel::shipped) {
          auto above = values[m];
          for (std::size_t i = 0; i < above.size(); ++i) {
            above[i] = above[i] ? std::optional(*above[i] - *shipped[i]) : std::nullopt;
          }
          line.above_shipped = eval::mean_over_encounters(above, seed);
        }
        lines.push_back(line);
      }
    }
  }
  return lines;
}

/// In milliseconds: keys have dots between their parts.
std::string time_key(const Line& line) {
  return score_figures[line.figure].each_time
             ? fmt::format("{:.0f}ms", 1e3 * forecast_times[line.time])
             : "over_time";
}

/// @param place  "forecast.NAME.GROUP"
void add_lines(json& out, const std::string& place, const std::vector<Line>& lines) {
  for (const Line& line : lines) {
    const std::string key = fmt::format("{}.{}.{}.{}", place, score_figures[line.figure].name,
                                        time_key(line), name(line.model));
    add_estimate(out, key, line.mean);
    if (line.above_shipped) {
      add_estimate(out, key + ".above_shipped", *line.above_shipped);
    }
  }
}

void print_lines(const std::string& title, const std::vector<Line>& lines) {
  app::print("\n{:28} {:>9}", title, "");
  for (const MotionModel model : eval::motion_models) {
    app::print(" {:>17}", name(model));
  }
  app::print("\n");
  for (std::size_t i = 0; i < lines.size(); i += eval::motion_models.size()) {
    const Figure& figure = score_figures[lines[i].figure];
    app::print("{:28} {:>9}", figure.title,
               figure.each_time ? fmt::format("{:g} s", forecast_times[lines[i].time]) : "");
    for (std::size_t m = 0; m < eval::motion_models.size(); ++m) {
      app::print(" {:17.3f}", lines[i + m].mean.value);
    }
    app::print("\n");
  }
}

struct ForecastCommand {
  SuiteCommandOptions from;  ///< which encounters; nothing is decided in them
  bool as_json = false;
};

void keep(Result<std::vector<ForecastSample>> samples, Heard& heard) {
  if (samples.has_value()) {
    heard.samples = std::move(samples).value();
  } else {
    heard.problem = samples.error().message;
  }
}

/// What was learnt of where vehicles go.
Result<eval::MixtureModel> read_mixture(const Places& places, const std::string& name) {
  return eval::MixtureModel::read(places.root / "models" / "places" / (name + ".safetensors"));
}

Result<AllHeard> heard_in_suite(const SuiteCommandOptions& options) {
  const auto encounters = open_encounters(options, "forecast eval");
  if (!encounters.has_value()) {
    return encounters.error();
  }
  const auto mixture = read_mixture(encounters.value().inputs.places, "model");
  if (!mixture.has_value()) {
    return mixture.error();
  }
  std::vector<Heard> all(static_cast<std::size_t>(encounters.value().count));
  in_parallel(all.size(), options.threads, [&](std::size_t i) {
    if (long_work::interrupted()) {
      return;
    }
    const auto found = played_encounter(encounters.value(), options, i);
    if (!found.has_value()) {
      all[i].problem = found.error().message;
      return;
    }
    all[i].family = found.value().family;
    keep(eval::forecast_samples(
             found.value().stage(encounters.value().inputs),
             {.mixture = &mixture.value(), .seed = eval::encounter_seed(options.seed, i)}),
         all[i]);
  });
  return AllHeard{std::move(all), {}};
}

// --- recorded traffic

constexpr std::string_view traffic_name = "traffic";

/// Weights that have not seen a site.
struct ModelsWithout {
  intent::Model intent;
  eval::MixtureModel mixture;
};
using ModelsBySite = std::map<std::string, ModelsWithout>;  ///< by its name

Result<ModelsBySite> models_without(const std::vector<eval::TrafficDrive>& drives,
                                    const Places& places) {
  ModelsBySite models;
  for (const eval::TrafficDrive& drive : drives) {
    if (models.contains(drive.site)) {
      continue;
    }
    const std::string name = "without_" + drive.site;
    auto intent = intent::read_model(places.root / "models" / "intent" / (name + ".safetensors"));
    if (!intent.has_value()) {
      return intent.error();
    }
    auto mixture = read_mixture(places, name);
    if (!mixture.has_value()) {
      return mixture.error();
    }
    models.emplace(drive.site,
                   ModelsWithout{std::move(intent).value(), std::move(mixture).value()});
  }
  return models;
}

/// What a drive tells with nothing left to chance but what perception gets wrong.
Heard heard_in_drive(const eval::TrafficDrive& drive, std::uint64_t number, const Inputs& inputs,
                     const ModelsWithout& models, const SuiteCommandOptions& options) {
  Heard heard{.family = drive.site, .problem = {}, .samples = {}};
  const auto made = eval::played_drive(drive);
  if (!made.has_value()) {
    heard.problem = made.error().message;
    return heard;
  }
  const eval::SuiteOptions as_suite{.methods = {}, .seed = options.seed, .exact = options.exact};
  const scenario::Scenario world = eval::as_played(made.value().scenario, as_suite);
  const encounter::Stage stage{
      .scenario = &world,
      .car = &inputs.car,
      .harm = &inputs.harm,
      .intent = &models.intent,
      .thresholds = {},
      .chance = {.perception = options.exact ? 0 : eval::encounter_seed(options.seed, number)}};
  keep(eval::forecast_samples(
           stage, {.mixture = &models.mixture, .seed = eval::encounter_seed(options.seed, number)},
           made.value().window),
       heard);
  return heard;
}

/// Drives of one group have road users in common: they count as one encounter.
AllHeard by_group(const eval::FoundDrives& found, std::vector<Heard> drives) {
  std::map<std::pair<std::string, std::string>, Heard> groups;
  std::size_t num_left_out = 0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (drives[i].samples.empty()) {
      ++num_left_out;
      continue;
    }
    Heard& group = groups[{drives[i].family, found.drives[i].group}];
    group.family = drives[i].family;
    std::move(drives[i].samples.begin(), drives[i].samples.end(),
              std::back_inserter(group.samples));
  }
  AllHeard all;
  for (const auto& [reason, count] : found.skipped) {
    all.notes.push_back(fmt::format("Passed over: {} x {}.", count, reason));
  }
  for (auto& [key, group] : groups) {
    all.encounters.push_back(std::move(group));
  }
  all.notes.push_back(fmt::format(
      "{} drives in {} groups that share no road user; {} more gave nothing to hold a forecast "
      "against.",
      drives.size() - num_left_out, groups.size(), num_left_out));
  return all;
}

Result<AllHeard> heard_in_traffic(const SuiteCommandOptions& options) {
  if (options.data.empty()) {
    return Error{Error::Code::out_of_range,
                 "--data: want folders with CommonRoad files (*.xml), got none"};
  }
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  const auto found = eval::traffic_drives({options.data.begin(), options.data.end()},
                                          static_cast<std::size_t>(options.count), options.seed,
                                          [] { return !long_work::interrupted(); });
  if (!found.has_value()) {
    return found.error();
  }
  const std::vector<eval::TrafficDrive>& drives = found.value().drives;
  const auto models = models_without(drives, inputs.value().places);
  if (!models.has_value()) {
    return models.error();
  }
  std::vector<Heard> all(drives.size());
  in_parallel(all.size(), options.threads, [&](std::size_t i) {
    if (!long_work::interrupted()) {
      all[i] =
          heard_in_drive(drives[i], i, inputs.value(), models.value().at(drives[i].site), options);
    }
  });
  return by_group(found.value(), std::move(all));
}

int run(const ForecastCommand& options) {
  const SuiteCommandOptions& from = options.from;
  if (const auto problem = long_work::why_outputs_unwritable({from.output})) {
    return refused(*problem);
  }
  long_work::watch_for_interrupt();
  const auto found = from.name == traffic_name ? heard_in_traffic(from) : heard_in_suite(from);
  if (long_work::interrupted()) {
    complain("interrupted; nothing was kept: the same command begins anew");
    return was_interrupted;
  }
  if (!found.has_value()) {
    return refused(found.error());
  }
  const std::vector<Heard>& all = found.value().encounters;
  std::map<std::string, int> families;
  std::size_t num_samples = 0;
  std::size_t num_acting = 0;
  int num_failed = 0;
  for (const Heard& heard : all) {
    ++families[heard.family];
    num_samples += heard.samples.size();
    for (const ForecastSample& one : heard.samples) {
      num_acting += one.acts ? 1U : 0U;
    }
    if (!heard.problem.empty()) {
      ++num_failed;
      complain(heard.problem);
    }
  }
  std::vector<Group> groups;
  const auto any = [](const Heard&) { return true; };
  const auto acts = [](const ForecastSample& one) { return one.acts; };
  groups.push_back({"all", any, [](const ForecastSample&) { return true; }});
  groups.push_back({"acting", any, acts});
  groups.push_back({"aside", any, [](const ForecastSample& one) { return one.aside; }});
  for (const auto& [family, count] : families) {
    groups.push_back({family + "_acting",
                      [family = family](const Heard& one) { return one.family == family; }, acts,
                      true});
  }
  const std::string place = "forecast." + std::filesystem::path(from.name).filename().string();
  json out{{"meta.command",
            fmt::format("saca forecast eval {} --count {} --split {} --car {} --seed {}{}{}",
                        from.name, from.count, from.split, from.car, from.seed,
                        from.exact ? " --exact" : "", from.data.empty() ? "" : " --data FOLDER")},
           {"meta.seed", std::to_string(from.seed)},
           {"meta.version", SACA_VERSION},
           {place + ".num_encounters", all.size()},
           {place + ".num_failed", num_failed},
           {place + ".num_forecasts", num_samples},
           {place + ".num_acting", num_acting}};
  if (!options.as_json) {
    app::print("{}: {} encounters, {} forecasts, {} of them of road users that act\n", from.name,
               all.size(), num_samples, num_acting);
    for (const std::string& note : found.value().notes) {
      app::print("{}\n", note);
    }
  }
  for (const Group& group : groups) {
    const auto lines = lines_of(all, group, from.seed);
    add_lines(out, place + "." + group.name, lines);
    if (!options.as_json) {
      print_lines(group.name, lines);
    }
  }
  const std::string text = json_text(out) + "\n";
  if (!from.output.empty()) {
    if (const auto problem = long_work::write_output(from.output, text)) {
      return refused(*problem);
    }
  }
  if (options.as_json) {
    app::print("{}", text);
  }
  return num_failed > 0 ? some_failed : success;
}

void add_forecast_eval(CLI::App& forecast, int& exit_code) {
  CLI::App* const command = forecast.add_subcommand(
      "eval", "Hold forecasts against what happens in many encounters, beside simpler ones");
  const auto options = std::make_shared<ForecastCommand>();
  SuiteCommandOptions& from = options->from;
  add_encounter_options(*command, from);
  command->get_option("name")->description(
      "A suite (natural, balanced), a family, a folder of scenarios, 100car, or traffic: others "
      "around recorded cars, judged by intentions that have not seen the site");
  command->get_option("--data")->description(
      "Of 100car the folder of the study's release; of traffic folders with CommonRoad files, of "
      "each site at most --count drives");
  command->add_option("--output", from.output, "The figures as JSON, besides");
  command->add_option("--threads", from.threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace

encounter::Stage PlayedEncounter::stage(const Inputs& inputs) const {
  return {.scenario = &world,
          .car = &inputs.car,
          .harm = &inputs.harm,
          .intent = &inputs.intent,
          .thresholds = {},
          .chance = chance};
}

encounter::Stage PlayedEncounter::twin_stage(const Inputs& inputs) const {
  encounter::Stage as_twin = stage(inputs);
  as_twin.scenario = &twin.value();
  return as_twin;
}

Result<PlayedEncounter> played_encounter(const SuiteEncounters& encounters,
                                         const SuiteCommandOptions& options, std::uint64_t number) {
  const eval::SuiteOptions played{.methods = {}, .seed = options.seed, .exact = options.exact};
  const auto found = encounters.at(number);
  if (!found.has_value()) {
    return found.error();
  }
  const eval::SuiteEncounter& encounter = found.value();
  return PlayedEncounter{.family = encounter.family,
                         .world = eval::as_played(encounter.scenario, played),
                         .chance = eval::chance_of(played, number),
                         .twin = encounter.twin
                                     ? std::optional(eval::as_played(*encounter.twin, played))
                                     : std::nullopt};
}

void add_encounter_options(CLI::App& command, SuiteCommandOptions& from) {
  command
      .add_option("name", from.name,
                  "A suite (natural, balanced), a family, a folder of scenarios, or 100car")
      ->required();
  command.add_option("--data", from.data, "Of 100car the folder of the study's release");
  add_draw_options(command, from.count, from.split, from.test_log, from.car);
  command.add_option("--seed", from.seed, "Of all that is drawn: same seed, same figures")
      ->capture_default_str();
  command.add_flag("--exact", from.exact,
                   "Nothing is left to chance, and perception is as the scenarios have it");
}

void add_forecast(CLI::App& line, int& exit_code) {
  CLI::App* const forecast =
      line.add_subcommand("forecast", "How well it is predicted where road users will be");
  forecast->require_subcommand(1);
  add_forecast_eval(*forecast, exit_code);
  add_forecast_show(*forecast, exit_code);
}

}  // namespace saca::app
