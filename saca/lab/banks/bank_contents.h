#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/thinking/memory/case.h"

namespace saca::banks {

/// What `saca memory list --json` prints: a list with the figures of each case, without its scene.
[[nodiscard]] nlohmann::json list_json(std::span<const memory::Case> cases);

/// The same for people, a line for each case.
/// @param name  of the bank, which is said where there is none
[[nodiscard]] std::string list_text(std::span<const memory::Case> cases, const std::string& name);

/// How many cases of which kind a bank holds.
struct BankContents {
  std::string name;
  std::size_t cases = 0;
  std::string digest;                  ///< memory::Store::digest, 16 hexadecimal digits
  std::map<std::string, int> origins;  ///< by memory::Origin
  std::map<std::string, int> trust;    ///< by memory::Trust
  std::map<std::string, int> best;     ///< by the policy that was best in hindsight
};

/// @return  what keeps the bank from being digested
[[nodiscard]] Result<BankContents> contents_of(const ReadBank& bank);

/// What `saca memory verify` prints: schema "saca.memory_bank/1", and for people.
[[nodiscard]] nlohmann::json json_of(const BankContents& contents);
[[nodiscard]] std::string text_of(const BankContents& contents);

}  // namespace saca::banks
