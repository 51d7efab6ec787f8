#include "saca/lab/suites/suite_thinking.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

namespace saca::suites {
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
Result<std::string> text_of_copies(const std::vector<memory::Store>& copies) {
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
                                                           const OpenModel& open_model,
                                                           const std::vector<memory::MadeWith>& car,
                                                           int threads, Clock& clock) {
  std::unique_ptr<SuiteThinking> thinking(new SuiteThinking());
  if (!options.memory.empty()) {
    if (auto problem = thinking->open_memory(options.memory, car, threads)) {
      return *std::move(problem);
    }
  }
  const auto open_shared = [&](const std::string& choice, const char* option,
                               std::unique_ptr<language_model::LanguageModel>& model,
                               std::unique_ptr<language_model::SharedModel>& shared) {
    auto opened = open_model(choice, option);
    if (!opened.has_value()) {
      return std::optional(opened.error());
    }
    model = std::move(opened).value();
    shared = std::make_unique<language_model::SharedModel>(*model, clock, thinking->interrupt());
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

std::optional<Error> SuiteThinking::open_memory(const std::string& file,
                                                const std::vector<memory::MadeWith>& car,
                                                int threads) {
  auto copies = copies_of(file, car, threads);
  if (!copies.has_value()) {
    return copies.error();
  }
  std::vector<memory::Store> stores = std::move(copies).value();
  auto text = text_of_copies(stores);
  if (!text.has_value()) {
    return text.error();
  }
  memory_text_ = std::move(text).value();
  experience_ = std::make_unique<const memory::Experience>(stores.front().experience());
  memories_ = std::make_unique<LendingPool<memory::Store>>(std::move(stores));
  return std::nullopt;
}

std::stop_token SuiteThinking::interrupt() {
  if (interrupt_ == nullptr) {
    long_work::watch_for_interrupt();
    interrupt_ = std::make_unique<long_work::InterruptStop>();
  }
  return interrupt_->token();
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

}  // namespace saca::suites
