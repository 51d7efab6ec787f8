#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/lab/cases/example_sets.h"
#include "saca/lab/cases/example_source.h"
#include "saca/lab/cases/reply_score.h"
#include "saca/lab/vehicle_study/car_planes.h"

namespace saca::cases {

/// What examples are made of, and the car that they are played with, to which they refer.
struct OpenedExamples {
  std::shared_ptr<const vehicle_study::PlanesOfCar> planes;
  ExampleSource source;
};
/// @return  an error that names the file, or says that nothing in it can be an example
[[nodiscard]] Result<OpenedExamples> open_examples(const installation::Installation& here,
                                                   const ExampleOptions& options);

/// Sets to teach a language model with (`saca cases export`).
struct ExportRequest {
  ExampleOptions examples;
  std::string format = "local";
  std::string output = "runs/reply_sets";  ///< folder
  int threads = usual_threads();
};
/// What asks for the same again, without the program's name.
[[nodiscard]] std::string command_text(const ExportRequest& request);

/// What is in the sets.
struct ExportedSets {
  OpenedExamples examples;
  SetTallies tallies;
  std::vector<std::string> problems;  ///< why cases could not be played; noticed already
};
/// Works out and writes the sets, with progress on the error stream, from where the journal ends
/// on.
/// @return  nullopt: interrupted
[[nodiscard]] Result<std::optional<ExportedSets>> export_sets(
    const installation::Installation& here, const ExportRequest& request);

/// Which cases a model is asked about (`saca cases eval`).
struct EvalRequest {
  ExampleOptions examples;
  std::string model = "local";
  std::string set = "test";
  std::optional<std::size_t> count;  ///< at most so many cases; nullopt: all of the set
  std::string output = "runs/replies.jsonl";
  bool unconstrained = false;  ///< replies are not held to what is true while they are written
};
[[nodiscard]] std::string command_text(const EvalRequest& request);

/// What it replied, in the order of the file.
struct EvaluatedReplies {
  std::vector<ExampleReply> replies;
  std::vector<std::string> problems;  ///< what could not be asked
  std::string model;                  ///< as it describes itself
};
/// Likewise.
[[nodiscard]] Result<std::optional<EvaluatedReplies>> evaluate_model(
    const installation::Installation& here, const EvalRequest& request);

}  // namespace saca::cases
