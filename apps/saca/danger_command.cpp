#include "apps/saca/options.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/units.h"
#include "saca/lab/danger_study/beside_exact.h"
#include "saca/lab/danger_study/danger_requests.h"
#include "saca/lab/danger_study/data_set.h"
#include "saca/lab/danger_study/usual_danger.h"
#include "saca/lab/learned_danger/coverage.h"
#include "saca/lab/learned_danger/point_mass.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::app {
namespace {

using danger_study::TableUse;

struct DatasetOptions {
  std::string folder;
  std::string car = "compact_rwd_ev";
  std::int64_t transitions = 31'000'000;
  std::uint64_t seed = 1;
  int drives_per_part = 500;
  bool no_tables = false;
  std::string by;  ///< weights; empty: none
  bool outcomes = false;
  int threads = usual_threads();
  bool as_json = false;
};

void make_dataset(const DatasetOptions& options) {
  long_work::watch_for_interrupt();
  const auto inputs = read_inputs(options.car);
  const danger_study::DataSetTask task{
      .folder = options.folder,
      .car_as_asked_for = options.car,
      .car = {inputs.car_name, inputs.car},
      .transitions = options.transitions,
      .seed = options.seed,
      .drives_per_part = options.drives_per_part,
      .tables = options.no_tables ? TableUse::none : TableUse::solved,
      .network = need(danger_study::network_by(here(), options.by, inputs.car_name)),
      .outcomes = options.outcomes,
      .threads = options.threads,
      .display = here().display};
  danger_study::DataSet set = need(danger_study::DataSet::open(task));
  const auto model =
      need(danger_study::model_of_drawn(danger_study::danger_sources(here(), inputs), task.tables));
  const SteadyClock clock;
  const auto start = clock.now();
  const auto all = need(set.make(model), was_interrupted);
  tell(options.as_json, danger_study::json_of(task, all, to_seconds(clock.now() - start)),
       danger_study::text_of(task, all));
}

void add_dataset(CLI::App& danger) {
  const auto [command, options] = add_command<DatasetOptions>(
      danger, "dataset",
      "Simulate transitions of the full vehicle beside obstacles; can be interrupted",
      make_dataset);
  add_needed(command, "FOLDER", options.folder, "Of the parts; made if it is not there");
  add(command, "--transitions", options.transitions, "At least so many",
      CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}));
  add_car(command, options.car);
  add(command, "--seed", options.seed, "");
  add(command, "--part-drives", options.drives_per_part, "Drives of the ego in a part",
      CLI::Range(1, 100'000));
  command.add_flag("--no-tables", options.no_tables,
                   "Look for the boundary and the way out by arcs, not by solved tables of danger");
  add(command, "--by", options.by, "Weights of saca-train-danger: evasions are driven by their Q");
  command
      .add_flag("--outcomes", options.outcomes,
                "All drives by their Q to the end: what it comes to")
      ->needs("--by");
  add_threads(command, options.threads, "They do not change what is made");
  add_json(command, options.as_json);
}

struct CheckDangerOptions : danger_study::SituationsRequest {
  bool as_json = false;
};

void check_danger(const CheckDangerOptions& options) {
  long_work::watch_for_interrupt();
  const auto [report, car] = need(danger_study::check_weights(here(), options), was_interrupted);
  nlohmann::json figures = danger_study::json_of(report);
  figures.update({{"meta.weights", options.weights},
                  {"meta.car", car},
                  {"meta.situations", options.situations},
                  {"meta.seed", std::to_string(options.seed)}});
  tell(options.as_json, figures, danger_study::text_of(report));
}

void add_danger_check(CLI::App& danger) {
  const auto [command, options] = add_command<CheckDangerOptions>(
      danger, "check",
      "Drive the full vehicle by learnt V_h and Q_h, and tell how often they are wrong",
      check_danger);
  add_needed(command, "WEIGHTS", options.weights, "safetensors file of saca-train-danger");
  add(command, "--situations", options.situations, "", CLI::Range(2, 10'000'000));
  add(command, "--seed", options.seed, "");
  add_threads(command, options.threads, "They do not change the figures");
  add_json(command, options.as_json);
}

struct CoverageOptions : danger_study::CoverageTask {
  bool as_json = false;
};

void tell_coverage(const CoverageOptions& options) {
  long_work::watch_for_interrupt();
  danger_study::CoverageTask task = options;
  task.display = here().display;
  const auto [bins, car] = need(danger_study::coverage_in(here(), task), was_interrupted);
  nlohmann::json figures = danger_study::json_of(bins);
  figures.update({{"meta.car", car}, {"meta.threads", options.threads}});
  tell(options.as_json, figures, danger_study::text_of(bins));
}

void add_coverage(CLI::App& danger) {
  const auto [command, options] = add_command<CoverageOptions>(
      danger, "coverage",
      "How near the inputs of a data set come to the exact best ones, by speed and grip",
      tell_coverage);
  add_needed(command, "FOLDER", options.folder, "Of the parts that `saca danger dataset` made");
  add(command, "--states", options.states, "Of each bin, whose best inputs are looked for, at most",
      CLI::Range(1, 100'000));
  add(command, "--among", options.others, "Likewise, among which they are looked for",
      CLI::Range(static_cast<int>(learned_danger::CoverageSurvey::num_alike), 10'000'000));
  add_threads(command, options.threads, "They do not change the figures");
  add_json(command, options.as_json);
}

struct MarginOptions : danger_study::SituationsRequest {
  std::string output;  ///< empty: the weights
  bool as_json = false;
};

void fit_margins(const MarginOptions& options) {
  long_work::watch_for_interrupt();
  const auto report =
      need(danger_study::fit_margins(here(), options, options.output), was_interrupted);
  nlohmann::json figures = danger_study::json_of(report);
  figures.update({{"meta.weights", options.weights},
                  {"meta.situations", report.situations},
                  {"meta.seed", std::to_string(options.seed)}});
  tell(options.as_json, figures, danger_study::text_of(report));
}

void add_margins(CLI::App& danger) {
  const auto [command, options] = add_command<MarginOptions>(
      danger, "margins",
      "Fit what is added to learnt V_h, so that what it tells safe is hardly ever hit",
      fit_margins);
  options.situations = 400'000;
  add_needed(command, "WEIGHTS", options.weights, "safetensors file of saca-train-danger");
  add(command, "--output", options.output, "The same weights with margins; else WEIGHTS");
  add(command, "--situations", options.situations, "Driven where they are told safe",
      CLI::Range(1, 100'000'000));
  add(command, "--seed", options.seed, "");
  add_threads(command, options.threads, "They do not change the margins");
  add_json(command, options.as_json);
}

struct ShowDangerOptions {
  std::string weights;
  std::string table;
  std::string output = "reach/learnt.png";
  std::vector<double> speeds_mps{10.0, 18.0};
  double course_deg = 0.0;
};

void show_danger(const ShowDangerOptions& options) {
  if (fs::path(options.output).extension() != ".png") {
    refuse(wrong_command_line,
           fmt::format("--output: want a name that ends in .png, got '{}'", options.output));
  }
  need_distinct({{"--output", options.output}},
                {{"the weights", options.weights}, {"--table", options.table}});
  const auto weights = need(danger_study::read_network(options.weights));
  const auto exact = need(learned_danger::read_exact_point_mass(options.table));
  need_writable({options.output});
  write(options.output,
        need(danger_study::beside_exact_png(weights, exact,
                                            {.weights = options.weights,
                                             .table = options.table,
                                             .speeds = options.speeds_mps,
                                             .course = from_degrees(options.course_deg)})));
  app::print("{}\n", fs::absolute(options.output).string());
}

void add_danger_show(CLI::App& danger) {
  const auto [command, options] = add_command<ShowDangerOptions>(
      danger, "show",
      "Draw learnt V_h, without its margins, beside the exact value of a point mass", show_danger);
  add_needed(command, "WEIGHTS", options.weights, "safetensors file");
  add_needed(command, "--table", options.table,
             "Solved values beside an obstacle at rest (`saca reach solve`)");
  add(command, "--output", options.output, "A picture (.png)");
  add(command, "--speed-mps", options.speeds_mps, "A row of maps for each", within(0.0, 40.0));
  add(command, "--course-deg", options.course_deg, "Of the ego, one for all",
      within(-180.0, 180.0));
}

}  // namespace

void add_danger(CLI::App& line) {
  CLI::App& danger = add_group(
      line, "danger", "V_h and Q_h, learnt: what they are learnt from, and what they are worth");
  add_dataset(danger);
  add_danger_check(danger);
  add_coverage(danger);
  add_margins(danger);
  add_danger_show(danger);
}

}  // namespace saca::app
