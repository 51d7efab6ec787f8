#include "apps/saca/regulation_command.h"

#include <fmt/core.h>

#include <memory>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "apps/saca/json_output.h"
#include "apps/saca/planes_making.h"
#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "apps/saca/suite_running.h"
#include "saca/lab/eval/regulation_file.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/regulation/regulation_json.h"
#include "saca/lab/regulation/regulation_page.h"
#include "saca/lab/regulation/regulation_text.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using regulation::RegulationRun;

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) {
    words.push_back(word);
  }
  return words;
}

/// @return  nullopt: interrupted
Result<std::optional<RegulationRun>> play(const RegulationOptions& options,
                                          const std::vector<std::string>& methods) {
  const auto places = find_places();
  if (!places.has_value()) {
    return places.error();
  }
  auto file = eval::load_regulation(regulation_path(places.value(), options.name));
  if (!file.has_value()) {
    return file.error();
  }
  const auto imitators = suites::imitators_of(methods, places.value().root / "models");
  if (!imitators.has_value()) {
    return imitators.error();
  }
  auto chosen = regulation::with_rows(std::move(file).value(), words_of(options.rows));
  if (!chosen.has_value()) {
    return Error{chosen.error().code, "--rows: " + chosen.error().message};
  }
  RegulationRun run =
      regulation::tests_of(std::move(chosen).value(), words_of(options.cars), methods);
  run.meta = {{"meta.command",
               fmt::format("saca suite {} --methods {} --car {}{}", options.name, options.methods,
                           options.cars, options.rows.empty() ? "" : " --rows " + options.rows)},
              {"meta.n", std::to_string(run.cars.size() * run.cells.size())},
              {"meta.source", run.regulation.source},
              {"meta.version", SACA_VERSION}};
  std::vector<std::unique_ptr<const PlanesOfCar>> planes;
  std::vector<regulation::TestedCar> cars;
  for (const std::string& name : run.cars) {
    auto car = open_planes(name);
    if (!car.has_value()) {
      return car.error();
    }
    planes.push_back(std::move(car).value());
    const PlanesOfCar& of_car = *planes.back();
    cars.push_back({&of_car.inputs.car, &of_car.setup, &of_car.inputs.intent});
  }
  return regulation::played(std::move(run), cars,
                            {imitators.value(), options.threads, progress_display()});
}

}  // namespace

fs::path regulation_path(const Places& places, const std::string& name) {
  return places.root / "data" / "protocols" / (name + ".toml");
}

int run_regulation(RegulationOptions options) {
  const auto methods = methods_from(options.methods == "all" ? "" : options.methods, {}, "");
  if (!methods.has_value()) {
    complain(methods.error().message);
    return wrong_command_line;
  }
  if (options.output.empty()) {
    options.output = fmt::format("runs/suite-{}.html", options.name);
  }
  if (fs::path(options.output).extension() != ".html") {
    complain("--output: want a name that ends in .html, got \"" + options.output + "\"");
    return wrong_command_line;
  }
  if (const auto problem = long_work::why_outputs_unwritable({options.output})) {
    return refused(*problem);
  }
  const auto ran = play(options, methods.value());
  if (!ran.has_value()) {
    return refused(ran.error());
  }
  if (!ran.value()) {
    complain("interrupted");
    return was_interrupted;
  }
  const RegulationRun& run = *ran.value();
  const std::string text = json_text(json_of(run)) + "\n";
  auto problem = long_work::write_output(options.output, report::suite_page(page_of(run)));
  if (!problem) {
    problem = long_work::write_output(fs::path(options.output).replace_extension(".json"), text);
  }
  if (problem) {
    return refused(*problem);
  }
  if (options.as_json) {
    app::print("{}", text);
  } else {
    app::print("{}\npage: {}\n", text_of(run), options.output);
  }
  return has_faults(run) ? some_failed : success;
}

}  // namespace saca::app
