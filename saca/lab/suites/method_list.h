#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/imitator.h"
#include "saca/lab/suites/thinking_options.h"

namespace saca::suites {

/// nullopt: it is not among them.
[[nodiscard]] std::optional<std::size_t> index_of(const std::vector<std::string>& methods,
                                                  std::string_view method);

/// All in one, as commands and journals have them: "a,b,c".
[[nodiscard]] std::string joined(const std::vector<std::string>& methods);

/// The names of a list "a,b,c"; empty: all that there are with this memory, model and these
/// weights.
/// @param danger  file of weights, or empty
/// @return  an error where a name is none, comes twice, or needs or leaves out what was not given
[[nodiscard]] Result<std::vector<std::string>> methods_from(const std::string& list,
                                                            const ThinkingOptions& thinking,
                                                            const std::string& danger);

/// What a suite runs unless it is told: SACA, with what it was given and without each of it,
/// published rules and yardsticks.
[[nodiscard]] std::string usual_methods(const ThinkingOptions& thinking);

/// The shipped networks of those methods that imitate.
/// @param methods  names of eval::methods()
/// @param models   folder of what ships: holds imitator/
[[nodiscard]] Result<std::shared_ptr<const eval::Imitators>> imitators_of(
    const std::vector<std::string>& methods, const std::filesystem::path& models);

}  // namespace saca::suites
