#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/intention_scoring/sequence.h"

namespace saca::intention_scoring {

/// Sequences, and what each is for: "train", "tune", "test" or another word.
struct SequenceSet {
  std::vector<Sequence> sequences;  ///< names are unique
  std::vector<std::string> splits;  ///< one per sequence
};

/// The first rule of a set that is broken, in words: parts that do not fit together, names twice or
/// empty, labels that are none, numbers that cannot be; nullopt when it can be used.
[[nodiscard]] std::optional<std::string> broken_rule(const SequenceSet& set);

/// Puts a set into an HDF5 file of format saca.sequences/1 (docs/formats.md), in one step. The same
/// set makes the same bytes.
///
/// @return  nullopt when it is on the disk, else the reason
/// @throws ContractViolation  if the set is empty or breaks a rule
[[nodiscard]] std::optional<Error> write_sequences(const std::filesystem::path& path,
                                                   const SequenceSet& set);

/// Reads it back, the same bits. Damage is found by a check sum before HDF5 sees the file; all that
/// the file says is checked all the same.
/// @return  unreadable, or malformed: one line with the file, the part, what was wanted, what came
[[nodiscard]] Result<SequenceSet> read_sequences(const std::filesystem::path& path);

}  // namespace saca::intention_scoring
