#include <span>
#include <string_view>

#include "apps/saca/options.h"
#include "saca/base/core/names.h"
#include "saca/lab/danger_study/scenario_tables.h"
#include "saca/lab/reach_study/authors_report.h"
#include "saca/lab/reach_study/case_solution.h"
#include "saca/lab/reach_study/convergence_report.h"
#include "saca/lab/reach_study/named_problem.h"
#include "saca/lab/reach_study/solution_summary.h"
#include "saca/lab/reach_study/value_picture.h"
#include "saca/lab/reach_study/value_view.h"
#include "saca/lab/report/record_page.h"
#include "saca/lab/report/value_json.h"
#include "saca/lab/verification/authors_network.h"
#include "saca/lab/verification/convergence.h"
#include "saca/thinking/danger/value_file.h"

namespace saca::app {
namespace {

struct CheckReachOptions {
  int grids = 4;
  std::string picture;
  bool as_json = false;
};

void check_solver(const CheckReachOptions& options) {
  need_writable({options.picture});
  const std::vector<verification::Refinement> all =
      verification::refinements(options.grids, usual_threads());
  tell(options.as_json, reach_study::json_of(all), reach_study::text_of(all));
  if (!options.picture.empty()) {
    write(options.picture, reach_study::convergence_chart(all));
  }
}

void add_reach_check(CLI::App& reach) {
  const auto [command, options] = add_command<CheckReachOptions>(
      reach, "check", "Hold the solver to known answers on ever finer grids", check_solver);
  add(command, "--grids", options.grids, "How many, each with half the spacing", CLI::Range(2, 5));
  add(command, "--picture", options.picture, "SVG of errors over spacings");
  add_json(command, options.as_json);
}

struct CompareOptions {
  std::string file;
  std::string network;
  std::string output = "reach/authors_network.html";
  std::vector<double> speeds_mps;
  std::optional<double> course_deg;
  bool as_json = false;
};

void compare_values(const CompareOptions& options) {
  using Format = reach_study::AuthorsRequest::Format;
  need_png_or_html(options.output);
  need_distinct({{"--output", options.output}},
                {{"the values", options.file}, {"--network", options.network}});
  const auto solved = need(danger::read_solved(options.file));
  need(reach_study::why_not_comparable(solved, options.file));
  need_writable({options.output});
  const auto network = need(verification::read_authors_network(options.network));
  const bool as_picture = fs::path(options.output).extension() == ".png";
  const auto report = need(reach_study::authors_report(
      solved, network,
      {.file = options.file,
       .network_name = fs::path(options.network).filename().string(),
       .views = reach_study::authors_views(options.speeds_mps, options.course_deg),
       .format = as_picture ? Format::picture : Format::page}));
  write(options.output, report.drawn);
  tell(options.as_json, reach_study::json_of(report.found),
       fmt::format("{}Maps: {}\n", reach_study::text_of(report.found),
                   fs::absolute(options.output).string()));
}

void add_reach_compare(CLI::App& reach) {
  const auto [command, options] = add_command<CompareOptions>(
      reach, "compare",
      "Hold the value network that the paper's authors published to a solved value",
      compare_values);
  add_needed(command, "file", options.file, "Solved values beside an obstacle at rest (HDF5)");
  add_needed(command, "--network", options.network, "The published safe_value_params.npz");
  add(command, "--output", options.output, "The page (.html), or its maps alone (.png)");
  add(command, "--speed-mps", options.speeds_mps, "Of the pairs of maps; default: some of each",
      within(0.0, 18.0));
  add(command, "--course-deg", options.course_deg, "Likewise, one for all", within(-40.0, 40.0));
  add_json(command, options.as_json);
}

struct SolveOptions {
  std::string name;
  std::string output;
  std::string differences = "weno5";
  std::string steps = "rk3";
  levelset::Scheme scheme{.threads = usual_threads()};
  std::optional<double> memory_mib;  ///< nullopt: what the machine has to spare
  bool without_error = false;
  bool as_json = false;
};

void solve_case(const SolveOptions& options) {
  const auto problem = need(reach_study::named_problem(here(), options.name));
  const std::string output = options.output.empty()
                                 ? "reach/" + fs::path(options.name).stem().string() + ".h5"
                                 : options.output;
  levelset::Scheme scheme = options.scheme;
  scheme.differences =
      value_from<levelset::Differences>(options.differences, levelset::difference_names).value();
  scheme.steps = value_from<levelset::Steps>(options.steps, levelset::step_names).value();
  scheme.with_error = !options.without_error;
  const auto solved = need(reach_study::solve_case(problem, {.name = options.name,
                                                             .output = output,
                                                             .scheme = scheme,
                                                             .memory_mib = options.memory_mib,
                                                             .display = here().display}),
                           was_interrupted);
  const auto summary = reach_study::summary_of(output, solved.solution, solved.seconds);
  tell(options.as_json, reach_study::json_of(summary), reach_study::text_of(summary));
}

CLI::Validator one_of_names(std::span<const std::string_view> names) {
  return one_of({names.begin(), names.end()});
}

void add_reach_solve(CLI::App& reach) {
  const auto [command, options] = add_command<SolveOptions>(
      reach, "solve", "Solve a case exactly and keep its values; goes on where it was interrupted",
      solve_case);
  add_needed(command, "case", options.name, "air3d, a name in data/reach, or a file");
  add(command, "--output", options.output, "HDF5 file; default: reach/CASE.h5");
  add(command, "--differences", options.differences, "upwind1, eno2, eno3 or weno5",
      one_of_names(levelset::difference_names));
  add(command, "--steps", options.steps, "Runge-Kutta: euler, rk2 or rk3",
      one_of_names(levelset::step_names));
  add(command, "--cfl", options.scheme.cfl, "Share of the longest stable step", within(0.01, 1.0));
  command.add_flag("--double", options.scheme.doubles, "In doubles; default: floats");
  add_threads(command, options.scheme.threads, "");
  add(command, "--memory-mib", options.memory_mib, "Refuse what takes more", within(0.001, 1e9));
  command.add_flag("--without-error", options.without_error,
                   "Do not solve on half as many points as well");
  add_json(command, options.as_json);
}

struct ShowReachOptions {
  std::string file;
  std::string output;
  std::optional<double> speed;   // [m/s]
  std::optional<double> course;  // [deg]
  std::optional<double> time;    // [s]
  std::optional<double> zoom;    // none: so that the danger can be seen
  std::vector<std::string> at;   // name=value, in the unit that is read
};

void show_value(const ShowReachOptions& options) {
  need_png_or_html(options.output);
  need_distinct({{"--output", options.output}}, {{"the values", options.file}});
  const auto at = need_of_line(reach_study::axis_values(options.course, options.speed, options.at));
  const auto solved = need(danger::read_solved(options.file));
  need_writable({options.output});
  const auto view =
      need(reach_study::view_of(solved, {at, options.time, options.zoom}, options.file));
  const bool as_picture = fs::path(options.output).extension() == ".png";
  write(options.output, need(as_picture ? reach_study::value_picture(solved, view)
                                        : report::value_report(report::value_json(solved, view))));
  app::print("{}: {}\n", options.output, reach_study::described(solved, view));
}

void add_reach_show(CLI::App& reach) {
  const auto [command, options] = add_command<ShowReachOptions>(
      reach, "show", "A solved value over x and y, or its first two coordinates, as PNG or HTML",
      show_value);
  add_needed(command, "FILE", options.file, "What saca reach solve left");
  add_needed(command, "--output", options.output,
             "A picture (.png), or a page with sliders (.html)");
  add(command, "--speed-mps", options.speed, "Default: the middle of the grid's");
  add(command, "--course-deg", options.course, "Default: 0");
  add(command, "--time-s", options.time, "A horizon that the file has; default: the longest");
  add(command, "--zoom", options.zoom,
      "Into the middle of the plane; 1: all of it; default: shows all danger", within(1.0, 8.0));
  add(command, "--at", options.at, "NAME=VALUE of another axis; angles in deg, else in SI units");
}

struct DangerTablesOptions {
  std::vector<std::string> scenarios;
  bool as_json = false;
};

void make_danger_tables(const DangerTablesOptions& options) {
  const auto all = need(danger_study::tables_of(here(), options.scenarios));
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [car, tables] : all.needed.by_car()) {
    for (const auto& [name, table] : tables) {
      const auto ready = need(reach_study::ready_table(table, all.stores.at(car)));
      need(ready.not_kept);
      list.push_back(reach_study::table_json(car, name, ready));
      tell_meanwhile(options.as_json, reach_study::table_line(car, name, ready));
    }
  }
  tell(options.as_json, list, "");
}

void add_reach_tables(CLI::App& reach) {
  const auto [command, options] = add_command<DangerTablesOptions>(
      reach, "tables",
      "Make the tables of danger that scenarios need, so that no run waits for them",
      make_danger_tables);
  add(command, "scenarios", options.scenarios,
      "Files, or names of shipped ones (default: all that are shipped)");
  add_json(command, options.as_json);
}

}  // namespace

void add_reach(CLI::App& line) {
  CLI::App& reach =
      add_group(line, "reach",
                "Which states can still be saved: solve, show and compare Hamilton-Jacobi values");
  add_reach_check(reach);
  add_reach_compare(reach);
  add_reach_solve(reach);
  add_reach_show(reach);
  add_reach_tables(reach);
}

}  // namespace saca::app
