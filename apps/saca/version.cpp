#include "apps/saca/version.h"

namespace saca::app {

std::string version_text() {
  return std::string(SACA_VERSION) + " (commit " + built_from() + ")";
}

}  // namespace saca::app
