#include "apps/saca/model.h"

#include "saca/reason/prompt.h"

namespace saca::app {

Result<std::unique_ptr<reason::ChildModel>> open_local_model(const Places& places, Clock& clock) {
  (void)places; (void)clock;
  return Error{Error::Code::unreadable, "stub"};
}

Result<std::unique_ptr<reason::LanguageModel>> open_model(const Places& places,
                                                          const std::string& choice, Clock& clock) {
  (void)places; (void)clock; (void)choice;
  return std::unique_ptr<reason::LanguageModel>();
}

}  // namespace saca::app
