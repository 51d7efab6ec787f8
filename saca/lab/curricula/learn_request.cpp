#include "saca/lab/curricula/learn_request.h"

#include <fmt/core.h>

#include <filesystem>

#include "saca/lab/suites/thinking_options.h"

namespace saca::curricula {

std::string suite_of(const LearnRequest& request) {
  return std::filesystem::path(request.from.name).filename().string();
}

std::string usual_folder(const LearnRequest& request) {
  return fmt::format("runs/learn-{}-{}", suite_of(request), request.from.split);
}

std::string command_text(const LearnRequest& request) {
  const suites::SuiteRequest& from = request.from;
  return fmt::format(
      "learn {} --count {} --seeds {} --split {} --car {} --seed {} --lies {}{}{}{}{}", from.name,
      from.count, request.seeds, from.split, from.car, from.seed, request.lies,
      from.exact ? " --exact" : "", from.no_twins ? " --no-twins" : "",
      request.empty_memory ? " --empty-memory" : "", suites::thinking_text(from.thinking));
}

}  // namespace saca::curricula
