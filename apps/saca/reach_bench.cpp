#include "apps/saca/reach_bench.h"

#include <string>

#include "apps/saca/printing.h"
#include "apps/saca/settings.h"
#include "saca/lab/benchmarks/reach_times.h"

namespace saca::app {
namespace {

void note_bench(const std::string& what) {
  if (!settings().quiet) {
    app::print(stderr, "bench reach: {}\n", what);
  }
}

std::optional<Error> added(const Result<nlohmann::json>& times, nlohmann::json& figures) {
  if (!times.has_value()) {
    return times.error();
  }
  figures.update(times.value());
  return std::nullopt;
}

}  // namespace

std::optional<Error> bench_air3d(const std::filesystem::path& root, const Clock& clock,
                                 nlohmann::json& figures) {
  return added(benchmarks::coarse_air3d_times(root, clock, note_bench), figures);
}

std::optional<Error> bench_reach(const std::filesystem::path& root, const manoeuvre::Car& car,
                                 const Clock& clock, nlohmann::json& figures) {
  return added(benchmarks::reach_times(root, car, clock, note_bench), figures);
}

}  // namespace saca::app
