#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::encounter {

/// One thing that a record depends on: as it was recorded, and as it is here.
struct Dependency {
  std::string what;
  std::string name;
  nlohmann::json recorded;
  nlohmann::json here;  ///< null: it is not here
  std::string lacks;    ///< why not

  [[nodiscard]] bool is_same() const { return recorded == here; }
};

/// What a run reads, as a record's `made` names it.
struct RecordedInputs {
  std::string car;  ///< its name or file; empty: none is named
  bool with_atlas = false;
};

/// @param made  of a record
/// @throws nlohmann::json::exception  if it is not whole
[[nodiscard]] RecordedInputs recorded_inputs(const nlohmann::json& made);

/// What is here of what a record names.
struct InputsHere {
  Result<nlohmann::json> inputs;  ///< as inputs_json has them, or why they cannot be read
  /// Of a scenario by its name or file, or why there is none.
  std::function<Result<std::string>(const std::string& scenario)> digest_of;
};

/// A record held against itself and against what it was made from.
struct RecordCheck {
  nlohmann::json made;  ///< of the record
  std::string content;  ///< digest of what is in it now
  std::vector<Dependency> inputs;

  [[nodiscard]] bool is_unchanged() const;  ///< it is as it was written
  [[nodiscard]] bool is_same() const;       ///< and all that it depends on is the same here
};

/// @param record  with its `made`
/// @throws nlohmann::json::exception  if `made` is not whole
[[nodiscard]] RecordCheck check_record(const nlohmann::json& record, const InputsHere& here);

/// The document of `saca verify --json`, schema saca.verification/1: docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const RecordCheck& check);

/// The same for people: who made it, and a line for the content and for each input.
[[nodiscard]] std::string text_of(const RecordCheck& check);

}  // namespace saca::encounter
