#include "saca/lab/danger_study/danger_requests.h"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/base/core/file.h"
#include "saca/base/formats/tensors.h"
#include "saca/lab/danger_study/check_situations.h"
#include "saca/lab/danger_study/margin_count.h"
#include "saca/lab/danger_study/usual_danger.h"
#include "saca/lab/learned_danger/margins.h"
#include "saca/lab/learned_danger/transition_file.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::danger_study {

using installation::Installation;

namespace {

SituationsTask task_of(const Installation& here, const SituationsRequest& request) {
  return {request.situations, request.seed, request.threads, here.display};
}

}  // namespace

Result<CheckedWeights> check_weights(const Installation& here, const SituationsRequest& request) {
  const auto read = read_danger_weights(here, request.weights);
  if (!read.has_value()) {
    return read.error();
  }
  const DangerWeights& weights = read.value();
  const auto margins = learned_danger::Margins::from(weights.network.words(), request.weights);
  if (!margins.has_value()) {
    return margins.error();
  }
  const auto all = checked_situations(weights.inputs.car, weights.network, task_of(here, request));
  if (!all.has_value()) {
    return all.error();
  }
  const SteadyClock clock;
  return CheckedWeights{
      check_report(all.value(), margins.value(), microseconds_of_value(weights.network, clock)),
      weights.car_name};
}

Result<MarginReport> fit_margins(const Installation& here, const SituationsRequest& request,
                                 const std::string& output) {
  const auto read = read_danger_weights(here, request.weights);
  if (!read.has_value()) {
    return read.error();
  }
  const DangerWeights& weights = read.value();
  const std::string file = output.empty() ? request.weights : output;
  const std::string state = file + ".margins.json";
  if (auto problem = long_work::why_outputs_unwritable({file, state})) {
    return *std::move(problem);
  }
  const std::string of = margin_count_of(weights.network, request.seed);
  const auto begun = read_margin_count(state, of);
  if (!begun.has_value()) {
    return begun.error();
  }
  const auto count = counted_on(begun.value(), of, state, weights.inputs.car, weights.network,
                                task_of(here, request));
  if (!count.has_value()) {
    return count.error();
  }
  MarginReport report = margin_report(count.value());
  if (auto problem =
          write_file(file, formats::tensor_bytes(with_margins(weights.tensors, report)))) {
    return *std::move(problem);
  }
  std::filesystem::remove(state);
  return report;
}

Result<DataSetCoverage> coverage_in(const Installation& here, const CoverageTask& task) {
  const auto files = learned_danger::part_files(task.folder);
  if (!files.has_value()) {
    return files.error();
  }
  const auto first = learned_danger::read_part(files.value().front());
  if (!first.has_value()) {
    return first.error();
  }
  const auto inputs = installation::read_inputs(here, first.value().car);
  if (!inputs.has_value()) {
    return inputs.error();
  }
  const auto model = model_of_drawn(danger_sources(here, inputs.value()), TableUse::solved);
  if (!model.has_value()) {
    return model.error();
  }
  auto bins = coverage_of(first.value(), files.value(), inputs.value().car, model.value(), task);
  return bins.has_value()
             ? Result(DataSetCoverage{std::move(bins).value(), inputs.value().car_name})
             : bins.error();
}

Result<std::optional<learned_danger::Network>> network_by(const Installation& here,
                                                          const std::string& path,
                                                          const std::string& car) {
  if (path.empty()) {
    return std::optional<learned_danger::Network>();
  }
  auto weights = read_danger_weights(here, path);
  if (!weights.has_value()) {
    return weights.error();
  }
  if (weights.value().inputs.car_name != car) {
    return Error{Error::Code::malformed, fmt::format("{}: want weights of the car {}, got of {}",
                                                     path, car, weights.value().car_name)};
  }
  return std::optional(std::move(weights).value().network);
}

}  // namespace saca::danger_study
