#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "saca/lab/eval/oracle.h"

namespace saca::policy_study {

/// What an oracle was asked.
struct OracleQuestion {
  std::string scenario;  ///< its name
  int draws = 0;         ///< 0: as written
  std::uint64_t seed = 1;
};

/// The document of `saca oracle --json`, schema saca.oracle/1: docs/formats.md.
[[nodiscard]] nlohmann::json json_of(const eval::Oracle& oracle, const OracleQuestion& question);

/// The same for people: the policies that can be driven, best first, with the best plan of each;
/// why the others cannot; and by how much the best is alone.
[[nodiscard]] std::string text_of(const eval::Oracle& oracle, const OracleQuestion& question);

}  // namespace saca::policy_study
