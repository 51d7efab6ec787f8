#include "saca/lab/banks/scale_calibration.h"

#include <fmt/core.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "saca/lab/long_work/interrupt.h"
#include "saca/onboard/match/similarity.h"

namespace saca::banks {
namespace {

/// Every so many, so that not more than `most` are left.
std::vector<memory::Case> thinned_out(const std::vector<memory::Case>& cases, int most) {
  const std::size_t step =
      (cases.size() + static_cast<std::size_t>(most) - 1) / static_cast<std::size_t>(most);
  std::vector<memory::Case> some;
  some.reserve(cases.size() / step + 1);
  for (std::size_t i = 0; i < cases.size(); i += step) {
    some.push_back(cases[i]);
  }
  return some;
}

}  // namespace

Result<ScaleCalibration> calibrate_scales(const CalibrationCases& cases,
                                          const ScaleFitOptions& options,
                                          long_work::ProgressLine& progress) {
  auto fit = eval::fit_scales(cases.cases, thinned_out(cases.cases, options.scenes), {},
                              options.threads, [&](int count, double error) {
                                progress.show(count, 0, fmt::format(" tries, error {:.5f}", error));
                                return !long_work::interrupted();
                              });
  if (!fit) {
    return Error{Error::Code::malformed, cases.file +
                                             ": want cases that tell what every policy was "
                                             "expected to harm, got none"};
  }
  ScaleCalibration calibration{.fit = *std::move(fit), .check = std::nullopt};
  const auto shipped = eval::scale_error(cases.cases, cases.check_cases, {}, options.threads);
  const auto fitted =
      eval::scale_error(cases.cases, cases.check_cases, calibration.fit.scales, options.threads);
  if (shipped && fitted) {
    calibration.check = CheckError{*shipped, *fitted};
  }
  return calibration;
}

nlohmann::json json_of(const ScaleCalibration& calibration, const std::string& version) {
  const eval::ScaleFit& fit = calibration.fit;
  nlohmann::json out{{"meta.command", "saca memory calibrate CASES --fit"},
                     {"meta.version", version},
                     {"memory.scales.is_done", fit.is_done},
                     {"memory.scales.error.shipped", fit.error_before},
                     {"memory.scales.error.fitted", fit.error}};
  for (const eval::FittedScale& one : eval::fitted_scales) {
    out[fmt::format("memory.scales.{}.shipped", one.name)] = match::Scales{}.*one.value;
    out[fmt::format("memory.scales.{}.fitted", one.name)] = fit.scales.*one.value;
  }
  if (calibration.check) {
    out["memory.scales.check_error.shipped"] = calibration.check->shipped;
    out["memory.scales.check_error.fitted"] = calibration.check->fitted;
  }
  return out;
}

std::string text_of(const ScaleCalibration& calibration) {
  const eval::ScaleFit& fit = calibration.fit;
  std::string text = fmt::format("\n{:14} {:>8} {:>8}\n", "scale", "shipped", "fitted");
  for (const eval::FittedScale& one : eval::fitted_scales) {
    text += fmt::format("{:14} {:8.3f} {:8.3f}\n", one.name, match::Scales{}.*one.value,
                        fit.scales.*one.value);
  }
  text += fmt::format("error of the harm predicted by like cases: {:.4f}, fitted {:.4f}\n",
                      fit.error_before, fit.error);
  return calibration.check
             ? text + fmt::format("in the cases to check: {:.4f}, fitted {:.4f}\n",
                                  calibration.check->shipped, calibration.check->fitted)
             : text;
}

}  // namespace saca::banks
