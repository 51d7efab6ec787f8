#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/cases/crash_case.h"
#include "saca/lab/cases/example_source.h"
#include "saca/lab/cases/reply_example.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/situation.h"

namespace saca::cases {

/// An example, and what its prompt is about.
struct DrawnExample {
  ReplyExample example;
  preview::Situation situation;
  std::optional<memory::Case> nearest;  ///< that the prompt tells of

  /// What a reply may say (language_model::reply_grammar).
  [[nodiscard]] std::string grammar(
      const std::optional<manoeuvre::PolicyId>& choice = std::nullopt) const;
};
/// Of one case and of its twin, where their triggers fire.
struct DrawnExamples {
  std::vector<DrawnExample> examples;
  std::string problem;  ///< why it could not be played; else empty
};
/// @param words  seed of the replies' words
[[nodiscard]] DrawnExamples drawn_examples(const CrashCase& one, const ExampleSource& source,
                                           std::uint64_t words);

}  // namespace saca::cases
