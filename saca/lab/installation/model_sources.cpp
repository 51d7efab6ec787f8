#include "saca/lab/installation/model_sources.h"

namespace saca::installation {

model_access::ModelSources model_sources(const Installation& here) {
  return {.host = here.model_host,
          .choice = here.root / "third_party" / "models" / "choice.json",
          .harm = here.root / "data" / "harm.toml",
          .temperatures = here.root / "data" / "language_model.toml",
          .key = here.model_key};
}

}  // namespace saca::installation
