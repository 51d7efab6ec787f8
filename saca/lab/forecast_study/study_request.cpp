#include "saca/lab/forecast_study/study_request.h"

#include <fmt/core.h>

#include <limits>

#include "saca/lab/eval/forecast_fan.h"
#include "saca/lab/forecast_study/fan_picture.h"
#include "saca/lab/forecast_study/suite_forecasts.h"
#include "saca/lab/forecast_study/traffic_forecasts.h"
#include "saca/lab/suites/opened_suite.h"
#include "saca/lab/suites/played_encounter.h"

namespace saca::forecast_study {

using installation::Inputs;
using installation::Installation;
using suites::SuiteRequest;

namespace {

/// Refers to the inputs.
suites::Perceiver perceiver_of(const Inputs& inputs) {
  return {.car = &inputs.car, .harm = &inputs.harm, .intent = &inputs.intent};
}

Result<ForecastStudy> study_suite(const Installation& here, const SuiteRequest& request) {
  const auto opened = suites::open_encounters(here, request, "forecast eval");
  if (!opened.has_value()) {
    return opened.error();
  }
  const auto mixture = read_places_model(here.root / "models", "model");
  if (!mixture.has_value()) {
    return mixture.error();
  }
  const suites::SuiteEncounters& encounters = opened.value();
  return suite_forecasts({.at = encounters.at,
                          .count = static_cast<std::size_t>(encounters.count),
                          .perceiver = perceiver_of(encounters.inputs),
                          .mixture = &mixture.value(),
                          .play = {.seed = request.seed, .exact = request.exact},
                          .threads = request.threads});
}

Result<ForecastStudy> study_traffic(const Installation& here, const SuiteRequest& request) {
  if (request.data.empty()) {
    return Error{Error::Code::out_of_range,
                 "--data: want folders with CommonRoad files (*.xml), got none"};
  }
  const auto inputs = installation::read_inputs(here, request.car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  return traffic_forecasts({.folders = {request.data.begin(), request.data.end()},
                            .most = static_cast<std::size_t>(request.count),
                            .models = here.root / "models",
                            .car = &inputs.value().car,
                            .harm = &inputs.value().harm,
                            .play = {.seed = request.seed, .exact = request.exact},
                            .threads = request.threads});
}

}  // namespace

std::string command_text(const SuiteRequest& request) {
  return fmt::format("forecast eval {} --count {} --split {} --car {} --seed {}{}{}", request.name,
                     request.count, request.split, request.car, request.seed,
                     request.exact ? " --exact" : "", request.data.empty() ? "" : " --data FOLDER");
}

Result<ForecastStudy> study_of(const Installation& here, const SuiteRequest& request) {
  return request.name == "traffic" ? study_traffic(here, request) : study_suite(here, request);
}

Result<std::string> picture_of(const Installation& here, const FanRequest& request) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  if (request.encounter >= most) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want an encounter below {}, got {}", request.from.name, most,
                             request.encounter)};
  }
  SuiteRequest from = request.from;
  from.count = static_cast<int>(request.encounter) + 1;
  const auto encounters = suites::open_encounters(here, from, "forecast show");
  if (!encounters.has_value()) {
    return encounters.error();
  }
  const int count = encounters.value().count;
  if (request.encounter >= static_cast<std::uint64_t>(count)) {
    return Error{Error::Code::out_of_range, fmt::format("{}: want an encounter below {}, got {}",
                                                        from.name, count, request.encounter)};
  }
  const auto played = suites::played_encounter(
      encounters.value().at, {.seed = from.seed, .exact = from.exact}, request.encounter);
  if (!played.has_value()) {
    return played.error();
  }
  const std::string name = fmt::format("{} {}", played.value().family, request.encounter);
  const auto fan = eval::forecast_fan(played.value().stage(perceiver_of(encounters.value().inputs)),
                                      request.who, request.at);
  return fan.has_value() ? Result(fan_picture(fan.value(), request.who, name))
                         : Error{fan.error().code, name + ": " + fan.error().message};
}

}  // namespace saca::forecast_study
