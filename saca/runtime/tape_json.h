#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "saca/runtime/tape.h"
#include "saca/runtime/tape_header.h"

namespace saca::runtime {

constexpr std::string_view tape_schema = "saca.tape/6";

struct TapeFile {
  TapeHeader header;
  TapeContent content;
};

/// The file of docs/formats.md, schema saca.tape/6: a line of JSON each for the header, what was
/// there before, every step and the end. Numbers come back to the last bit.
[[nodiscard]] std::string tape_text(const TapeFile& tape);

// What is compared when a tape is replayed: all that there is in it, to the last bit.

[[nodiscard]] nlohmann::json verdict_json(const reflex::Verdict& verdict);
[[nodiscard]] nlohmann::json reflex_json(const reflex::Reflex& reflex);
[[nodiscard]] nlohmann::json decision_json(const reflex::Decision& decision);
[[nodiscard]] nlohmann::json switch_json(const reflex::Switch& change);
/// For each road user the probabilities of all intentions now, in 0.5 s and in 1 s, one after the
/// other.
[[nodiscard]] nlohmann::json beliefs_json(const intent::Beliefs& beliefs);

}  // namespace saca::runtime
