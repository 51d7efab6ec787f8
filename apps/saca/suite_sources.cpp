#include "apps/saca/suite_sources.h"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "apps/saca/surveying.h"
#include "saca/base/core/fnv.h"
#include "saca/lab/eval/paper_tables.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using suites::EncounterSource;

/// What is no suite: recordings, a folder of scenarios, a table of the paper.
Result<EncounterSource> open_source(const suites::SuiteRequest& options, const Inputs& inputs,
                                    suites::Twins twins) {
  const suites::EncounterDraw draw{
      .car_name = inputs.car_name, .car = &inputs.car, .count = options.count};
  if (eval::find_paper_table(options.name) != nullptr) {
    Fnv hash;
    if (auto problem = add_inputs(inputs.places, options.car, hash)) {
      return *problem;
    }
    return suites::paper_table_source(options.name, inputs.places.root / "scenarios", draw, twins,
                                      hash);
  }
  return options.name == "100car" ? suites::hundred_car_source(options.data, draw)
                                  : suites::folder_source(options.name, draw);
}

std::vector<std::string> names_beside_suites() {
  const auto places = find_places();
  return places.has_value()
             ? suites::names_beside_suites(places.value().root / "data" / "protocols")
             : std::vector<std::string>();
}

}  // namespace

Result<SuiteEncounters> open_encounters(const suites::SuiteRequest& options,
                                        const std::string& command) {
  const suites::Twins twins = options.no_twins ? suites::Twins::left_out : suites::Twins::played;
  if (options.name == "100car" || eval::find_paper_table(options.name) != nullptr ||
      fs::is_directory(options.name)) {
    auto inputs = read_inputs(options.car);
    if (!inputs.has_value()) {
      return inputs.error();
    }
    auto source = open_source(options, inputs.value(), twins);
    if (!source.has_value()) {
      return source.error();
    }
    return SuiteEncounters{std::move(source).value(), std::move(inputs).value()};
  }
  auto suite = open_suite({.suite = options.name,
                           .car = options.car,
                           .count = options.count,
                           .split = options.split,
                           .test_log = options.test_log,
                           .other_names = names_beside_suites()},
                          command);
  if (!suite.has_value()) {
    return suite.error();
  }
  DrawnSuite drawn = std::move(suite).value();
  return SuiteEncounters{suites::drawn_source(std::move(drawn.source),
                                              fmt::format("{}, {} split ({:016x})", options.name,
                                                          options.split, drawn.digest),
                                              options.count, twins),
                         std::move(drawn.inputs)};
}

}  // namespace saca::app
