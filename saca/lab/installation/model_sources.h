#pragma once

#include "saca/lab/installation/installation.h"
#include "saca/lab/model_access/open_model.h"

namespace saca::installation {

/// With what language models are opened: the program's own files, and its key.
[[nodiscard]] model_access::ModelSources model_sources(const Installation& here);

}  // namespace saca::installation
