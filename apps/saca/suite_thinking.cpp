#include "apps/saca/suite_thinking.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "apps/saca/model.h"
#include "saca/lab/long_work/interrupt.h"

namespace saca::app {
namespace {

Result<std::vector<memory::Store>> copies_of(const std::string& file,
                                             const std::vector<memory::MadeWith>& car, int count) {
  std::vector<memory::Store> copies;
  for (int i = 0; i < count; ++i) {
    auto copy = memory::Store::snapshot(file, car);
    if (!copy.has_value()) {
      return Error{copy.error().code, "--memory: " + copy.error().message};
    }
    copies.push_back(std::move(copy).value());
  }
  return copies;
}

/// Differs between copies that somebody wrote between.
Result<std::string> text_of(const std::vector<memory::Store>& copies) {
  std::vector<std::uint64_t> digests;
  for (const memory::Store& copy : copies) {
    const auto digest = copy.digest();
    if (!digest.has_value()) {
      return digest.error();
    }
    if (!digests.empty() && digest.value() != digests.front()) {
      return Error{Error::Code::unreadable,
                   "--memory: " + copy.name() + ": another program writes to it"};
    }
    digests.push_back(digest.value());
  }
  return fmt::format("{} cases ({:016x})", copies.front().size(), digests.front());
}

}  // namespace

Result<std::unique_ptr<SuiteThinking>> SuiteThinking::open(const ThinkingOptions& options,
                                                           const Places& places,
                                                           const std::vector<memory::MadeWith>& car,
                                                           int threads, Clock& clock) {
  std::unique_ptr<SuiteThinking> thinking(new SuiteThinking());
  if (!options.memory.empty()) {
    auto copies = copies_of(options.memory, car, threads);
    if (!copies.has_value()) {
      return copies.error();
    }
    std::vector<memory::Store> stores = std::move(copies).value();
    auto text = text_of(stores);
    if (!text.has_value()) {
      return text.error();
    }
    thinking->memory_text_ = std::move(text).value();
    thinking->experience_ = std::make_unique<const memory::Experience>(stores.front().experience());
    thinking->memories_ = std::make_unique<LendingPool<memory::Store>>(std::move(stores));
  }
  const auto open_shared = [&](const std::string& choice, const char* option,
                               std::unique_ptr<language_model::LanguageModel>& model,
                               std::unique_ptr<language_model::SharedModel>& shared) {
    auto opened = open_needed_model(places, choice, runtime::Pace::lockstep, clock, option);
    if (!opened.has_value()) {
      return std::optional(opened.error());
    }
    if (thinking->interrupt_ == nullptr) {
      long_work::watch_for_interrupt();
      thinking->interrupt_ = std::make_unique<long_work::InterruptStop>();
    }
    model = std::move(opened).value();
    shared =
        std::make_unique<language_model::SharedModel>(*model, clock, thinking->interrupt_->token());
    return std::optional<Error>();
  };
  if (options.model != "off") {
    if (auto problem = open_shared(options.model, "--llm", thinking->model_, thinking->shared_)) {
      return *std::move(problem);
    }
  }
  if (!options.untuned.empty()) {
    if (auto problem = open_shared(options.untuned, "--untuned", thinking->untuned_model_,
                                   thinking->untuned_)) {
      return *std::move(problem);
    }
  }
  return thinking;
}

SuiteThinking::Loan SuiteThinking::lend(runtime::PlanesSetup setup) {
  Loan loan{.memory = memories_ ? memories_->lend() : LendingPool<memory::Store>::Loan(),
            .setup = std::move(setup)};
  loan.setup.memory = loan.memory.get();
  loan.setup.model = shared_.get();
  return loan;
}

std::optional<Error> SuiteThinking::failure() const {
  const auto failure_of = [](const std::unique_ptr<language_model::SharedModel>& model,
                             const char* option) -> std::optional<Error> {
    const auto failure = model ? model->failure() : std::nullopt;
    return failure ? std::optional(
                         Error{failure->code, fmt::format("{}: {}", option, failure->message)})
                   : std::nullopt;
  };
  const auto failure = failure_of(shared_, "--llm");
  return failure ? failure : failure_of(untuned_, "--untuned");
}

std::optional<std::string> SuiteThinking::model_text() const {
  return shared_ ? std::optional(shared_->description()) : std::nullopt;
}

}  // namespace saca::app
