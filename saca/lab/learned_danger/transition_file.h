#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/learned_danger/transitions.h"

namespace saca::learned_danger {

/// One part of a data set: where its transitions come from, and they.
struct Part {
  std::string car;         ///< its name
  std::uint64_t seed = 0;  ///< of this part
  Mixture mixture;
  Transitions transitions;
};

/// Writes a part as HDF5 with a seal, in the layout of the DSRL data sets for safe offline
/// reinforcement learning (Liu and co-workers, 2023): `observations`, `next_observations`,
/// `actions`, `rewards` (minus the size of the demand), `costs` (1 where h >= 0), `terminals`
/// (settled), `timeouts` (cut off), and of our own `h`, `next_h` and `drives`. All are 32-bit
/// floats; what the numbers of an observation are is the text `features`.
/// @return  nullopt when it is on the disk, else the reason; Error::Code::out_of_range of a part
///          without a transition
[[nodiscard]] std::optional<Error> write_part(const std::filesystem::path& path, const Part& part);

/// @return  Error::Code::unreadable or ::malformed, naming file, part and what is wanted, where the
///          seal does not hold or a number is not finite
[[nodiscard]] Result<Part> read_part(const std::filesystem::path& path);

/// Likewise, of this car: what other parts are of.
/// @return  Error::Code::malformed as well where it is of another
[[nodiscard]] Result<Part> read_part_of(const std::filesystem::path& path, const std::string& car);

/// The parts in a folder, by name.
/// @return  Error::Code::unreadable where there are none
[[nodiscard]] Result<std::vector<std::filesystem::path>> part_files(
    const std::filesystem::path& folder);

}  // namespace saca::learned_danger
