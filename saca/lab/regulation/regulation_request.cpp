#include "saca/lab/regulation/regulation_request.h"

#include <fmt/core.h>

#include <memory>
#include <string_view>
#include <utility>

#include "saca/base/core/csv.h"
#include "saca/lab/eval/regulation_file.h"
#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/suites/method_list.h"
#include "saca/lab/vehicle_study/car_planes.h"

namespace saca::regulation {

namespace {

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string_view> words = fields_of(list, ',');
  if (words.back().empty()) {  // behind the last comma, or of an empty list
    words.pop_back();
  }
  return {words.begin(), words.end()};
}

}  // namespace

Result<std::optional<RegulationRun>> run_regulation(const installation::Installation& here,
                                                    const RegulationRequest& request,
                                                    const std::vector<std::string>& methods) {
  auto file = eval::load_regulation(installation::regulation_place(here, request.name));
  if (!file.has_value()) {
    return file.error();
  }
  const auto imitators = suites::imitators_of(methods, here.root / "models");
  if (!imitators.has_value()) {
    return imitators.error();
  }
  auto chosen = with_rows(std::move(file).value(), words_of(request.rows));
  if (!chosen.has_value()) {
    return Error{chosen.error().code, "--rows: " + chosen.error().message};
  }
  RegulationRun run = tests_of(std::move(chosen).value(), words_of(request.cars), methods);
  run.meta = {{"meta.command",
               fmt::format("saca suite {} --methods {} --car {}{}", request.name, request.methods,
                           request.cars, request.rows.empty() ? "" : " --rows " + request.rows)},
              {"meta.n", std::to_string(run.cars.size() * run.cells.size())},
              {"meta.source", run.regulation.source},
              {"meta.version", here.version}};
  std::vector<std::shared_ptr<const vehicle_study::PlanesOfCar>> planes;
  std::vector<TestedCar> cars;
  for (const std::string& name : run.cars) {
    auto car = vehicle_study::open_planes(here, name);
    if (!car.has_value()) {
      return car.error();
    }
    planes.push_back(std::move(car).value());
    const vehicle_study::PlanesOfCar& of_car = *planes.back();
    cars.push_back({&of_car.inputs.car, &of_car.setup, &of_car.inputs.intent});
  }
  return played(std::move(run), cars, {imitators.value(), request.threads, here.display});
}

}  // namespace saca::regulation
