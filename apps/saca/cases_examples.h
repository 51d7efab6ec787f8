#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/saca/planes_making.h"
#include "saca/base/core/result.h"
#include "saca/lab/eval/crash_case.h"
#include "saca/lab/eval/reply_example.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/experience.h"

namespace saca::app {

/// What a file of cases gives examples of: it, and what is asked besides.
struct ExampleOptions {
  std::string file;
  std::string memory;  ///< a bank; empty: prompts tell of no case
  std::string car = "compact_rwd_ev";
  std::string cues;        ///< a suite whose cues the encounters have; empty: they have none
  std::uint64_t seed = 1;  ///< of the replies' words
};

/// FILE, --memory, --car, --cues and --seed.
void add_example_options(CLI::App& command, ExampleOptions& options);
/// All but FILE, as a command has them.
[[nodiscard]] std::string example_text(const ExampleOptions& options);

/// Cases that prompts tell of, as a run's memory would: asked by several threads.
class ToldCases {
 public:
  explicit ToldCases(std::vector<memory::Case> cases);

  [[nodiscard]] std::optional<eval::ToldCase> in(const world::Scene& scene) const;

 private:
  std::vector<memory::Case> cases_;
  memory::Experience experience_;
  std::unordered_map<match::CaseId, std::size_t> place_of_;
};

/// The cases that examples are made of, and what with.
struct ExampleSource {
  std::vector<eval::CrashCase> cases;  ///< drawn from families that training may see
  int recorded = 0;                    ///< left out: they cannot be drawn again
  int test_only = 0;                   ///< left out: of a family that only the test split has
  std::unique_ptr<const PlanesOfCar> planes;
  std::optional<ToldCases> told;
  std::optional<families::FamilyCues>
      cues;                  ///< that the encounters have, with the law of what comes
  std::uint64_t digest = 0;  ///< of all that examples depend on, but for the options
};
/// @return  an error that names the file, or says that nothing in it can be an example
[[nodiscard]] Result<ExampleSource> open_examples(const ExampleOptions& options);

/// An example, and what its prompt is about.
struct DrawnExample {
  eval::ReplyExample example;
  preview::Situation situation;
};
/// Of one case and of its twin, where their triggers fire.
struct DrawnExamples {
  std::vector<DrawnExample> examples;
  std::string problem;  ///< why it could not be played; else empty
};
[[nodiscard]] DrawnExamples drawn_examples(const eval::CrashCase& one, const ExampleSource& source,
                                           const ExampleOptions& options);

}  // namespace saca::app
