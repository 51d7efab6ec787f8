#include "saca/lab/suites/thinking_options.h"

namespace saca::suites {

std::string thinking_text(const ThinkingOptions& thinking) {
  return (thinking.memory.empty() ? "" : " --memory " + thinking.memory) +
         (thinking.model == "off" ? "" : " --llm " + thinking.model) +
         (thinking.untuned.empty() ? "" : " --untuned " + thinking.untuned);
}

}  // namespace saca::suites
