#include "apps/saca/thinking_options.h"

namespace saca::app {

void add_thinking_options(CLI::App& command, ThinkingOptions& options) {
  command
      .add_option(
          "--llm", options.model,
          "local: the language model of `make model`; local:FILE: other weights, GGUF; off: "
          "none; replay:FILE: recorded replies; MODEL@URL: a server with /v1/chat/completions, key "
          "in SACA_LLM_KEY")
      ->capture_default_str();
  command.add_option("--memory", options.memory, "The memory bank")->capture_default_str();
}

void add_untuned_option(CLI::App& command, ThinkingOptions& options) {
  command.add_option("--untuned", options.untuned,
                     "As --llm: a model without fine-tuning, for the methods ..._untuned");
}

}  // namespace saca::app
