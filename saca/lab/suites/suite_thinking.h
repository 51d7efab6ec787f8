#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "saca/base/core/lending_pool.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/suites/thinking_options.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/language_model/shared_model.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/memory/store.h"

namespace saca::suites {

/// What SACA thinks with while many encounters are run on several threads: one language model for
/// all, one without fine-tuning where it is wanted, and for each thread a copy of the memory bank
/// as it was at the start. So a row depends neither on the rows before it nor on the threads:
/// nothing is learnt, and no two questions are put at once.
class SuiteThinking {
 public:
  /// Opens a model in lockstep.
  /// @param choice  as `--llm` takes it
  /// @param option  that named it, for messages
  using OpenModel = std::function<Result<std::unique_ptr<language_model::LanguageModel>>(
      const std::string& choice, const char* option)>;

  /// Where there is a model, signals are watched for from here on: an interrupt withdraws questions
  /// to it.
  /// @param clock    that models' deadlines are on; outlives this
  /// @param car      that asks memory (encounter::made_with)
  /// @param threads  that think at once at most, >= 1
  /// @return         an error where memory or model is not there: a row without it would be another
  [[nodiscard]] static Result<std::unique_ptr<SuiteThinking>> open(
      const ThinkingOptions& options, const OpenModel& open_model,
      const std::vector<memory::MadeWith>& car, int threads, Clock& clock);

  /// What one encounter is run with, until it is let go: `setup` with memory and model.
  struct Loan {
    LendingPool<memory::Store>::Loan memory;
    runtime::PlanesSetup setup;
  };
  [[nodiscard]] Loan lend(runtime::PlanesSetup setup);

  /// Of the memory bank; nullptr: without.
  [[nodiscard]] const memory::Experience* experience() const { return experience_.get(); }

  [[nodiscard]] bool has_model() const { return shared_ != nullptr || untuned_ != nullptr; }
  /// Why a model cannot be asked any more, and which: rows that were being run are then worth
  /// nothing.
  [[nodiscard]] std::optional<Error> failure() const;

  /// Number of cases and a digest of them; nullopt: without memory.
  [[nodiscard]] const std::optional<std::string>& memory_text() const { return memory_text_; }
  /// What the model says that it is; nullopt: without.
  [[nodiscard]] std::optional<std::string> model_text() const;

  /// The model without fine-tuning, to be asked by any thread; nullptr: none.
  [[nodiscard]] language_model::LanguageModel* untuned() const { return untuned_.get(); }

 private:
  SuiteThinking() = default;

  [[nodiscard]] std::optional<Error> open_memory(const std::string& file,
                                                 const std::vector<memory::MadeWith>& car,
                                                 int threads);
  /// The interrupt that withdraws questions, watched for from the first call on.
  [[nodiscard]] std::stop_token interrupt();

  std::unique_ptr<LendingPool<memory::Store>> memories_;
  std::unique_ptr<const memory::Experience> experience_;
  std::optional<std::string> memory_text_;
  std::unique_ptr<long_work::InterruptStop> interrupt_;
  std::unique_ptr<language_model::LanguageModel> model_;
  std::unique_ptr<language_model::SharedModel> shared_;
  std::unique_ptr<language_model::LanguageModel> untuned_model_;
  std::unique_ptr<language_model::SharedModel> untuned_;
};

}  // namespace saca::suites
