#pragma once

#include <filesystem>
#include <optional>

/// A language model as a command line names it, opened.
namespace saca::model_access {

/// What `make model` measured to be fastest on this processor.
struct LocalChoice {
  std::optional<std::filesystem::path> weights;  ///< nullopt: none are there
  bool flash_attention = false;
};

/// @param file  its `choice.json`; the weights lie beside it
/// @return      no weights where the file is missing, damaged, or names none that are there
[[nodiscard]] LocalChoice local_choice(const std::filesystem::path& file);

}  // namespace saca::model_access
