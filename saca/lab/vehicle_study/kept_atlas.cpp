#include "saca/lab/vehicle_study/kept_atlas.h"

#include <functional>
#include <string>
#include <system_error>
#include <utility>

#include "saca/base/core/clock.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/prepare/atlas_build.h"
#include "saca/onboard/atlas/atlas_file.h"

namespace saca::vehicle_study {

namespace fs = std::filesystem;

namespace {

/// Drives it and writes its file.
/// @param goes_on  asked now and then; false stops
/// @return         nullopt: stopped. Errors are the journal's.
Result<std::optional<KeptAtlas>> built(const manoeuvre::Car& car, const fs::path& file,
                                       const AtlasBuild& build, const fs::path& journal,
                                       const std::function<bool()>& goes_on) {
  SteadyClock clock;
  long_work::ProgressLine line("atlas", static_cast<int>(num_nodes(build.grid)), clock,
                               build.display);
  const auto nodes = prepare::build_atlas(
      car, build.grid, build.threads, journal, [&](const prepare::AtlasProgress& progress) {
        line.show(static_cast<int>(progress.done), static_cast<int>(progress.remembered),
                  " points");
        return goes_on();
      });
  if (!nodes.has_value()) {
    return nodes.error();
  }
  if (nodes.value() == nullptr) {
    return std::optional<KeptAtlas>();
  }
  const auto problem =
      long_work::write_output(file, atlas::atlas_bytes(car, build.grid, *nodes.value()));
  return std::optional(KeptAtlas{{build.grid, car.tuning.domain, nodes.value()}, problem});
}

}  // namespace

Result<std::optional<atlas::Atlas>> build_atlas_file(const manoeuvre::Car& car,
                                                     const fs::path& file,
                                                     const AtlasBuild& build) {
  if (auto problem = long_work::make_folder_of(file)) {
    return *std::move(problem);
  }
  const fs::path journal = file.string() + ".journal";
  long_work::watch_for_interrupt();
  const auto one = built(car, file, build, journal, [] { return !long_work::interrupted(); });
  if (!one.has_value()) {
    return one.error();
  }
  if (!one.value()) {
    return std::optional<atlas::Atlas>();
  }
  if (one.value()->not_kept) {
    return *one.value()->not_kept;
  }
  std::error_code ignored;
  fs::remove(journal, ignored);
  return std::optional(one.value()->atlas);
}

KeptAtlas read_or_build_atlas(const manoeuvre::Car& car, const fs::path& file,
                              const AtlasBuild& build) {
  const auto there = atlas::read_atlas(file, car);
  if (there.has_value()) {
    return {there.value(), std::nullopt};
  }
  const auto one = built(car, file, build, {}, [] { return true; });
  return *one.value();  // without a journal there is no error
}

std::filesystem::path atlas_place(const installation::Installation& here, const std::string& car) {
  return installation::kept_place(here, std::filesystem::path("atlases") / (car + ".atlas"));
}

atlas::Atlas usual_atlas(const installation::Installation& here,
                         const installation::Inputs& inputs) {
  const auto [atlas, not_kept] =
      read_or_build_atlas(inputs.car, atlas_place(here, inputs.car_name),
                          {.threads = usual_threads(), .display = here.display});
  if (not_kept) {
    here.notice(not_kept->message + "; the atlas is used, and built again next time");
  }
  return atlas;
}

}  // namespace saca::vehicle_study
