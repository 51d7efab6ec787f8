#pragma once

#include <filesystem>
#include <optional>

#include "apps/saca/inputs.h"
#include "saca/base/core/result.h"
#include "saca/onboard/atlas/atlas.h"

namespace saca::app {

/// Builds the atlas of the inputs' car into a file, with progress on the error stream; an
/// interrupted build goes on where it stopped.
/// @return  nullopt: interrupted, and told so
[[nodiscard]] Result<std::optional<atlas::Atlas>> make_atlas(const Inputs& inputs,
                                                             const std::filesystem::path& file,
                                                             int threads);

/// The one at `atlas_place`. Where there is none that is right for this car and this program, it is
/// built, in seconds, and kept there if it can be.
[[nodiscard]] atlas::Atlas usual_atlas(const Inputs& inputs);

}  // namespace saca::app
