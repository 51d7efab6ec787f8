#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/installation/inputs.h"
#include "saca/lab/long_work/progress.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::vehicle_study {

/// How an atlas is driven.
struct AtlasBuild {
  atlas::AtlasGrid grid = atlas::default_atlas_grid();
  int threads = 1;  ///< they do not change the atlas
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// Builds the atlas of a car into a file, with progress on the error stream. What is done stands
/// beside it in FILE.journal until all is: an interrupted build goes on where it stopped.
/// @return  nullopt: interrupted. Errors are the journal's, and Error::Code::unwritable
[[nodiscard]] Result<std::optional<atlas::Atlas>> build_atlas_file(
    const manoeuvre::Car& car, const std::filesystem::path& file, const AtlasBuild& build);

/// An atlas that can be used, whether it could be kept or not.
struct KeptAtlas {
  atlas::Atlas atlas;
  std::optional<Error> not_kept;  ///< why its file could not be written
};

/// The one in a file. Where there is none that is right for this car and this program, it is built
/// and kept there if it can be. An interrupt that is watched for elsewhere does not stop it.
[[nodiscard]] KeptAtlas read_or_build_atlas(const manoeuvre::Car& car,
                                            const std::filesystem::path& file,
                                            const AtlasBuild& build);

/// Where the atlas of a car is looked for, and built (installation::kept_place).
/// @param car  its name
[[nodiscard]] std::filesystem::path atlas_place(const installation::Installation& here,
                                                const std::string& car);

/// The one that lies there (read_or_build_atlas); that it could not be kept is noticed.
[[nodiscard]] atlas::Atlas usual_atlas(const installation::Installation& here,
                                       const installation::Inputs& inputs);

}  // namespace saca::vehicle_study
