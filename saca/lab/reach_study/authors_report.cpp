#include "saca/lab/reach_study/authors_report.h"

#include <fmt/core.h>

#include <utility>

#include "saca/base/core/units.h"
#include "saca/lab/report/value_map.h"
#include "saca/thinking/danger/avoidance_case.h"
#include "saca/thinking/danger/obstacle_frame.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::reach_study {

using verification::Agreement;
using verification::AuthorsComparison;

std::optional<Error> why_not_comparable(const danger::Solution& solved, const std::string& file) {
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

std::vector<report::AuthorsView> authors_views(const std::vector<double>& speeds,
                                               std::optional<double> course) {
  if (!speeds.empty() || course) {
    std::vector<report::AuthorsView> views;
    for (const double speed : speeds.empty() ? std::vector{10.0} : speeds) {
      views.push_back({from_degrees(course.value_or(0.0)), speed});
    }
    return views;
  }
  const double aslant = from_degrees(20.0);
  return {{0.0, 5.0}, {0.0, 10.0}, {0.0, 18.0}, {aslant, 5.0}, {aslant, 18.0}};
}

Result<AuthorsReport> authors_report(const danger::Solution& solved,
                                     const verification::AuthorsNetwork& network,
                                     const AuthorsRequest& request) {
  const danger::ValueTable table(solved.grid, snapshot(solved, solved.times.size() - 1));
  const danger::View view = danger::view_of(solved).value_or(danger::View::obstacle);
  const danger::ValueAt value = in_obstacle_frame(table, view);
  AuthorsComparison found = compare_with_authors(value, network);
  const std::string& text = solved.problem;
  const report::AuthorsPage page{.case_name = report::problem_name(text).value_or(request.file),
                                 .network_name = request.network_name,
                                 .outline = report::obstacle_outline(text),
                                 .views = request.views};
  auto drawn = request.format == AuthorsRequest::Format::picture
                   ? authors_png(page, value, network)
                   : authors_page(page, value, network, found);
  if (!drawn.has_value()) {
    return drawn.error();
  }
  return AuthorsReport{std::move(found), std::move(drawn).value()};
}

nlohmann::json json_of(const AuthorsComparison& found) {
  const Agreement& all = found.all;
  nlohmann::json figures{{"reach.authors_net.n", all.states},
                         {"reach.authors_net.n_unsafe", all.unsafe},
                         {"reach.authors_net.n_outside", found.outside},
                         {"reach.authors_net.sign_agreement", all.sign_agreement()},
                         {"reach.authors_net.false_safe", all.false_safe_share()},
                         {"reach.authors_net.false_alarm", all.false_alarm_share()}};
  for (const auto& one : found.by_speed) {
    const std::string at = fmt::format(".speed{:g}", one.speed);
    figures["reach.authors_net.false_safe" + at] = one.agreement.false_safe_share();
    figures["reach.authors_net.false_alarm" + at] = one.agreement.false_alarm_share();
  }
  return figures;
}

std::string text_of(const AuthorsComparison& found) {
  const auto line = [](const std::string& head, const Agreement& agreement) {
    return fmt::format("{:>8} {:8} {:8} {:9.1f} % {:9.1f} % {:9.1f} %", head, agreement.states,
                       agreement.unsafe, 100.0 * agreement.sign_agreement(),
                       100.0 * agreement.false_safe_share(), 100.0 * agreement.false_alarm_share());
  };
  std::string text =
      fmt::format("{:>8} {:>8} {:>8} {:>11} {:>11} {:>11}   mean value [m], solved and network\n",
                  "m/s", "states", "unsafe", "same sign", "false safe", "false alarm");
  for (const auto& one : found.by_speed) {
    text += line(fmt::format("{:g}", one.speed), one.agreement) +
            fmt::format("   {:6.1f} {:6.1f}\n", one.mean_solved, one.mean_network);
  }
  text += line("all", found.all) + "\n";
  if (found.outside > 0) {
    text +=
        fmt::format("{} states of the network's range lie outside the solution\n", found.outside);
  }
  return text;
}

}  // namespace saca::reach_study
