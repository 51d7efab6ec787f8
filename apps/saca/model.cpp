#include "apps/saca/model.h"

#include <cstdlib>

#include "apps/saca/printing.h"

namespace saca::app {
namespace {

model_access::ModelSources sources_of(const Places& places) {
  const char* const key = std::getenv("SACA_LLM_KEY");
  return {.host = places.model_host,
          .choice = places.root / "third_party" / "models" / "choice.json",
          .harm = places.root / "data" / "harm.toml",
          .temperatures = places.root / "data" / "language_model.toml",
          .key = key == nullptr ? "" : key};
}

}  // namespace

Result<std::unique_ptr<language_model::ChildModel>> open_local_model(const Places& places,
                                                                     runtime::Pace pace,
                                                                     Clock& clock) {
  return model_access::open_local_model(sources_of(places), pace, clock);
}

Result<std::unique_ptr<language_model::LanguageModel>> open_needed_model(const Places& places,
                                                                         const std::string& choice,
                                                                         runtime::Pace pace,
                                                                         Clock& clock,
                                                                         std::string_view option) {
  return model_access::open_needed_model(sources_of(places), choice, pace, clock, option);
}

Result<model_access::ChosenModel> open_chosen_model(const Places& places, const std::string& choice,
                                                    const std::string& record, runtime::Pace pace,
                                                    Clock& clock) {
  auto chosen = model_access::ChosenModel::open(sources_of(places), choice, record, pace, clock);
  if (chosen.has_value() && chosen.value().missing()) {
    app::print(stderr, "saca: {}\nsaca: going on as with --llm off\n",
               chosen.value().missing()->message);
  }
  return chosen;
}

}  // namespace saca::app
