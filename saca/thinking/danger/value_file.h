#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/thinking/danger/grid.h"

namespace saca::danger {

/// Values at one or more times.   (times x num_cells)
template <class Real>
using Snapshots = std::vector<std::vector<Real>>;

/// What a solver has found, and for what; its last snapshot is enough to go on from, by the same
/// scheme.
struct Solution {
  Grid grid;
  std::string problem;    ///< TOML text of the case that it answers
  std::string scheme;     ///< by which it was solved (`described` in `solve.h`); empty: not told
  bool complete = false;  ///< false: stopped before its horizon
  std::vector<double> times;  ///< tau of each snapshot [s], >= 0, increasing; at least one
  std::variant<Snapshots<float>, Snapshots<double>> values;
  std::vector<float> error;  ///< of the last snapshot, per cell, >= 0; empty: not known

  [[nodiscard]] bool doubles() const { return values.index() == 1; }
};

/// One snapshot's values as float, whatever the precision kept.
/// @param time  number of the snapshot
/// @throws ContractViolation  if there is no such snapshot
[[nodiscard]] std::vector<float> snapshot(const Solution& solved, std::size_t time);

/// The snapshot nearest to a time [s].
[[nodiscard]] std::size_t nearest_snapshot(const Solution& solved, double time);

/// Puts it into an HDF5 file (docs/formats.md), in one step: readers see the old file or the whole
/// new one, also after a kill. The file's first 512 bytes hold a check sum of the rest.
///
/// Takes as many bytes as the values and errors have, and some 3 % more.
/// @return  nullopt when it is on the disk, else the reason
/// @throws ContractViolation  if the grid breaks a rule, sizes do not fit, times do not increase or
///                            a number is not finite
[[nodiscard]] std::optional<Error> write_solved(const std::filesystem::path& path,
                                                const Solution& solved);

/// Reads it back, the same bits. Damage of any kind is found by the check sum before HDF5 sees the
/// file; all that the file says is checked all the same.
///
/// @return  unreadable, or malformed: one line with the file, the part, what was wanted, what came
[[nodiscard]] Result<Solution> read_solved(const std::filesystem::path& path);

}  // namespace saca::danger
