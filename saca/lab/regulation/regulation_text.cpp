#include "saca/lab/regulation/regulation_text.h"

#include <fmt/core.h>

#include <optional>

#include "saca/lab/regulation/constant_in_words.h"

namespace saca::regulation {

std::string text_of(const RegulationRun& run) {
  std::string text = fmt::format("{}: {} tests with each of {} cars; tests passed\n\n{:22}",
                                 run.regulation.title, run.cells.size(), run.cars.size(), "row");
  for (const std::string& method : run.methods) {
    text += fmt::format(" {:>20}", method);
  }
  text += '\n';
  const auto line = [&](const std::string& name, std::optional<std::size_t> car,
                        std::optional<std::size_t> row) {
    text += fmt::format("{:22}", name);
    for (std::size_t m = 0; m < run.methods.size(); ++m) {
      const PassCount sum = passed_by(run, {.method = m, .car = car, .row = row});
      text += fmt::format(" {:>20}", fmt::format("{} of {}", sum.passed, sum.all));
    }
    text += '\n';
  };
  for (std::size_t r = 0; r < run.regulation.rows.size(); ++r) {
    line(run.regulation.rows[r].name, std::nullopt, r);
  }
  text += '\n';
  for (std::size_t k = 0; k < run.cars.size(); ++k) {
    line(run.cars[k], k, std::nullopt);
  }
  line("all", std::nullopt, std::nullopt);
  text += '\n';
  for (const std::string& sentence : constant_in_words(run)) {
    text += fmt::format("{}\n", sentence);
  }
  return text;
}

}  // namespace saca::regulation
