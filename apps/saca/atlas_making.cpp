#include "apps/saca/atlas_making.h"

#include <fmt/core.h>

#include "apps/saca/places.h"
#include "apps/saca/settings.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/vehicle_study/kept_atlas.h"

namespace saca::app {

Result<std::optional<atlas::Atlas>> make_atlas(const Inputs& inputs,
                                               const std::filesystem::path& file, int threads) {
  auto atlas = vehicle_study::build_atlas_file(inputs.car, file,
                                               {.threads = threads, .display = progress_display()});
  if (atlas.has_value() && !atlas.value()) {
    complain(fmt::format(
        "interrupted; {} was not written. The same command goes on where this one stopped.",
        file.string()));
  }
  return atlas;
}

atlas::Atlas usual_atlas(const Inputs& inputs) {
  const auto [atlas, not_kept] = vehicle_study::read_or_build_atlas(
      inputs.car, atlas_place(inputs.places, inputs.car_name),
      {.threads = usual_threads(), .display = progress_display()});
  if (not_kept) {
    complain(not_kept->message + "; the atlas is used, and built again next time");
  }
  return atlas;
}

}  // namespace saca::app
