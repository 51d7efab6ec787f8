#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/saca/planes_making.h"
#include "saca/lab/cases/example_source.h"

namespace saca::app {

/// FILE, --memory, --car, --cues and --seed.
void add_example_options(CLI::App& command, cases::ExampleOptions& options);

/// What examples are made of, and the car that they are played with, to which they refer.
struct OpenExamples {
  std::unique_ptr<const PlanesOfCar> planes;
  cases::ExampleSource source;
};
/// @return  an error that names the file, or says that nothing in it can be an example
[[nodiscard]] Result<OpenExamples> open_examples(const cases::ExampleOptions& options);

}  // namespace saca::app
