#include "apps/saca/example_options.h"

#include <utility>

namespace saca::app {

void add_example_options(CLI::App& command, cases::ExampleOptions& options) {
  command.add_option("FILE", options.file, "What `build` wrote")->required();
  command.add_option("--memory", options.memory,
                     "A bank whose most alike case prompts tell of; without, they tell of none");
  command.add_option("--car", options.car, "That the cases were made with")->capture_default_str();
  command.add_option("--cues", options.cues,
                     "Other encounters of the same cases, with the cues of this suite");
  command.add_option("--seed", options.seed, "Of the replies' words: same seed, same bytes")
      ->capture_default_str();
}

Result<OpenExamples> open_examples(const cases::ExampleOptions& options) {
  auto file = cases::read_cases(options.file);
  if (!file.has_value()) {
    return file.error();
  }
  auto planes = open_planes(options.car);
  if (!planes.has_value()) {
    return planes.error();
  }
  const Inputs& inputs = planes.value()->inputs;
  auto source = cases::open_examples(std::move(file).value(), options,
                                     {.car_name = inputs.car_name,
                                      .forecast = planes.value()->setup.forecast,
                                      .intent = &inputs.intent},
                                     inputs.places.root / "scenarios");
  if (!source.has_value()) {
    return source.error();
  }
  return OpenExamples{.planes = std::move(planes).value(), .source = std::move(source).value()};
}

}  // namespace saca::app
