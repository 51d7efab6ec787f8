#include "apps/saca/traffic_suite.h"

#include <fmt/core.h>

#include <filesystem>

#include "apps/saca/json_output.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/suites/traffic_json.h"
#include "saca/lab/suites/traffic_page.h"
#include "saca/lab/suites/traffic_text.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;

int write_and_print(const suites::WatchedTraffic& traffic, const suites::TrafficWatch& watch,
                    const suites::WatchTools& tools, bool as_json) {
  const nlohmann::json figures = suites::traffic_json(traffic, watch, SACA_VERSION);
  const std::string text = json_text(figures);
  const fs::path page = fs::path(watch.output).replace_extension(".html");
  const fs::path beside = fs::path(watch.output).replace_extension(".json");
  auto problem = long_work::write_output(
      page, report::suite_page(suites::traffic_page(traffic, tools, figures)));
  if (!problem) {
    problem = long_work::write_output(beside, text + "\n");
  }
  if (problem) {
    return refused(*problem);
  }
  if (as_json) {
    app::print("{}\n", text);
  } else {
    app::print("{}page: {}, figures: {}\n", suites::traffic_text(traffic), page.string(),
               beside.string());
  }
  return success;
}

}  // namespace

int run_traffic_suite(const suites::TrafficWatch& watch, bool as_json) {
  if (const auto problem = long_work::why_outputs_unwritable({watch.output})) {
    return refused(*problem);
  }
  const auto planes = open_planes(watch.car, watch.thresholds);
  if (!planes.has_value()) {
    return refused(planes.error());
  }
  const PlanesOfCar& of_car = *planes.value();
  const suites::WatchTools tools{
      .car = &of_car.inputs.car, .intent = &of_car.inputs.intent, .saca = &of_car.setup};
  const auto watched = suites::watch_traffic(watch, tools, SACA_VERSION, progress_display());
  if (!watched.has_value()) {
    return refused(watched.error());
  }
  if (!watched.value()) {
    complain("interrupted; the same command goes on where this one stopped");
    return was_interrupted;
  }
  const suites::WatchedTraffic& traffic = *watched.value();
  if (suites::shadow_figures(traffic.rows, "").drives == 0) {
    complain(fmt::format("{}: want drives that can be watched, got none of {}: {}",
                         watch.folders.front(), traffic.rows.size(),
                         traffic.rows.front().left_out));
    return bad_input;
  }
  return write_and_print(traffic, watch, tools, as_json);
}

}  // namespace saca::app
