#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "apps/saca/reach_commands.h"
#include "apps/saca/within.h"
#include "saca/base/core/file.h"
#include "saca/base/core/units.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/authors_page.h"
#include "saca/lab/verification/authors_comparison.h"
#include "saca/thinking/danger/avoidance_case.h"
#include "saca/thinking/danger/obstacle_frame.h"
#include "saca/thinking/danger/value_file.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using verification::Agreement;
using verification::AuthorsComparison;

struct CompareOptions {
  std::string file;
  std::string network;
  std::string output = "reach/authors_network.html";
  std::vector<double> speeds_mps;
  std::optional<double> course_deg;
  bool as_json = false;
};

/// The network knows of one obstacle and of no motion of it.
std::optional<Error> not_comparable(const std::string& file, const danger::Solution& solved) {
  const auto problem = danger::parse_avoidance_case(solved.problem, file);
  if (!problem.has_value()) {
    return Error{Error::Code::malformed,
                 file + ": want a solved case of avoidance; " + problem.error().message};
  }
  if (!solved.complete) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want a whole solution, got one that was stopped at {:.3g} s",
                             file, solved.times.back())};
  }
  if (danger::view_of(solved).value_or(danger::View::edge) == danger::View::edge) {
    std::string came;
    for (const danger::Axis& axis : solved.grid.axes) {
      came += (came.empty() ? "" : ", ") + axis.name;
    }
    return Error{Error::Code::malformed,
                 fmt::format("{}: want values over x, y, course, speed or, seen from the ego, "
                             "ahead, left, turned, speed, got {}",
                             file, came)};
  }
  const double speed = problem.value().system.obstacle_speed;
  if (speed != 0.0) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want an obstacle at rest, got one at {:g} m/s", file, speed)};
  }
  return std::nullopt;
}

std::vector<report::AuthorsView> views_asked_for(const CompareOptions& options) {
  if (!options.speeds_mps.empty() || options.course_deg) {
    std::vector<report::AuthorsView> views;
    for (const double speed : options.speeds_mps.empty() ? std::vector{10.0} : options.speeds_mps) {
      views.push_back({from_degrees(options.course_deg.value_or(0.0)), speed});
    }
    return views;
  }
  const double aslant = from_degrees(20.0);
  return {{0.0, 5.0}, {0.0, 10.0}, {0.0, 18.0}, {aslant, 5.0}, {aslant, 18.0}};
}

json agreement_figures(const AuthorsComparison& found) {
  const Agreement& all = found.all;
  json all_of_them{{"reach.authors_net.n", all.states},
                   {"reach.authors_net.n_unsafe", all.unsafe},
                   {"reach.authors_net.n_outside", found.outside},
                   {"reach.authors_net.sign_agreement", all.sign_agreement()},
                   {"reach.authors_net.false_safe", all.false_safe_share()},
                   {"reach.authors_net.false_alarm", all.false_alarm_share()}};
  for (const auto& one : found.by_speed) {
    const std::string at = fmt::format(".speed{:g}", one.speed);
    all_of_them["reach.authors_net.false_safe" + at] = one.agreement.false_safe_share();
    all_of_them["reach.authors_net.false_alarm" + at] = one.agreement.false_alarm_share();
  }
  return all_of_them;
}

void tell_agreement(const AuthorsComparison& found) {
  const auto line = [](const std::string& head, const Agreement& agreement) {
    app::print("{:>8} {:8} {:8} {:9.1f} % {:9.1f} % {:9.1f} %", head, agreement.states,
               agreement.unsafe, 100.0 * agreement.sign_agreement(),
               100.0 * agreement.false_safe_share(), 100.0 * agreement.false_alarm_share());
  };
  app::print("{:>8} {:>8} {:>8} {:>11} {:>11} {:>11}   mean value [m], solved and network\n", "m/s",
             "states", "unsafe", "same sign", "false safe", "false alarm");
  for (const auto& one : found.by_speed) {
    line(fmt::format("{:g}", one.speed), one.agreement);
    app::print("   {:6.1f} {:6.1f}\n", one.mean_solved, one.mean_network);
  }
  line("all", found.all);
  app::print("\n");
  if (found.outside > 0) {
    app::print("{} states of the network's range lie outside the solution\n", found.outside);
  }
}

int compare_values(const CompareOptions& options) {
  if (!is_png_or_html(options.output)) {
    return wrong_command_line;
  }
  const auto solved = danger::read_solved(options.file);
  if (!solved.has_value()) {
    return refused(solved.error());
  }
  if (const auto problem = not_comparable(options.file, solved.value())) {
    return refused(*problem);
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto network = verification::read_authors_network(options.network);
  if (!network.has_value()) {
    return refused(network.error());
  }
  const danger::ValueTable table(solved.value().grid,
                                 snapshot(solved.value(), solved.value().times.size() - 1));
  const danger::View view = danger::view_of(solved.value()).value_or(danger::View::obstacle);
  const danger::ValueAt value = in_obstacle_frame(table, view);
  const AuthorsComparison found = compare_with_authors(value, network.value());
  const std::string& text = solved.value().problem;
  const report::AuthorsPage page{.case_name = report::problem_name(text).value_or(options.file),
                                 .network_name = fs::path(options.network).filename().string(),
                                 .outline = report::obstacle_outline(text),
                                 .views = views_asked_for(options)};
  const auto made = fs::path(options.output).extension() == ".png"
                        ? authors_png(page, value, network.value())
                        : authors_page(page, value, network.value(), found);
  if (!made.has_value()) {
    return refused(made.error());
  }
  auto problem = long_work::write_output(options.output, made.value());
  if (problem) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print_json(agreement_figures(found));
    return success;
  }
  tell_agreement(found);
  app::print("Maps: {}\n", fs::absolute(options.output).string());
  return success;
}

}  // namespace

void add_reach_compare(CLI::App& reach, int& exit_code) {
  CLI::App* const command = reach.add_subcommand(
      "compare", "Hold the value network that the paper's authors published to a solved value");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("file", options->file, "Solved values beside an obstacle at rest (HDF5)")
      ->required();
  command->add_option("--network", options->network, "The published safe_value_params.npz")
      ->required();
  command->add_option("--output", options->output, "The page (.html), or its maps alone (.png)")
      ->capture_default_str();
  command
      ->add_option("--speed-mps", options->speeds_mps,
                   "Of the pairs of maps; default: some of each")
      ->check(within(0.0, 18.0));
  command->add_option("--course-deg", options->course_deg, "Likewise, one for all")
      ->check(within(-40.0, 40.0));
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = compare_values(*options); });
}

}  // namespace saca::app
