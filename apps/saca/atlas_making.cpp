#include "apps/saca/atlas_making.h"

#include <fmt/core.h>

#include <string>
#include <system_error>

#include "apps/saca/places.h"
#include "apps/saca/settings.h"
#include "saca/base/core/clock.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/progress.h"
#include "saca/lab/prepare/atlas_build.h"
#include "saca/onboard/atlas/atlas_file.h"

namespace saca::app {

namespace fs = std::filesystem;

namespace {

struct NewAtlas {
  atlas::Atlas atlas;
  std::optional<Error> not_written;
};

/// nullopt: interrupted, which it is only when that is watched for. Errors are the journal's.
Result<std::optional<NewAtlas>> made(const Inputs& inputs, const fs::path& file, int threads,
                                     const fs::path& journal) {
  SteadyClock clock;
  const auto grid = atlas::default_atlas_grid();
  long_work::ProgressLine line("atlas", static_cast<int>(num_nodes(grid)), clock,
                               progress_display());
  const auto nodes = prepare::build_atlas(
      inputs.car, grid, threads, journal, [&](const prepare::AtlasProgress& progress) {
        line.show(static_cast<int>(progress.done), static_cast<int>(progress.remembered),
                  " points");
        return !long_work::interrupted();
      });
  if (!nodes.has_value()) {
    return nodes.error();
  }
  if (nodes.value() == nullptr) {
    return std::optional<NewAtlas>();
  }
  auto problem = long_work::make_folder_of(file);
  if (!problem) {
    problem = write_file(file, atlas::atlas_bytes(inputs.car, grid, *nodes.value()));
  }
  return std::optional(NewAtlas{{grid, inputs.car.tuning.domain, nodes.value()}, problem});
}

}  // namespace

Result<std::optional<atlas::Atlas>> make_atlas(const Inputs& inputs, const fs::path& file,
                                               int threads) {
  if (auto problem = long_work::make_folder_of(file)) {
    return *problem;
  }
  const fs::path journal = file.string() + ".journal";
  long_work::watch_for_interrupt();
  const auto one = made(inputs, file, threads, journal);
  if (!one.has_value()) {
    return one.error();
  }
  if (!one.value()) {
    complain(fmt::format(
        "interrupted; {} was not written. The same command goes on where this one stopped.",
        file.string()));
    return std::optional<atlas::Atlas>();
  }
  if (one.value()->not_written) {
    return *one.value()->not_written;
  }
  std::error_code ignored;
  fs::remove(journal, ignored);
  return std::optional(one.value()->atlas);
}

atlas::Atlas usual_atlas(const Inputs& inputs) {
  const fs::path file = atlas_place(inputs.places, inputs.car_name);
  const auto there = atlas::read_atlas(file, inputs.car);
  if (there.has_value()) {
    return there.value();
  }
  const auto one = made(inputs, file, usual_threads(), {}).value();  // no journal, no error
  if (one->not_written) {
    complain(one->not_written->message + "; the atlas is used, and built again next time");
  }
  return one->atlas;
}

}  // namespace saca::app
