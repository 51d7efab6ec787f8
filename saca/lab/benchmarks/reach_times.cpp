#include "saca/lab/benchmarks/reach_times.h"

#include <utility>

#include "saca/base/core/parallel.h"
#include "saca/lab/benchmarks/air3d_times.h"
#include "saca/lab/benchmarks/avoidance_times.h"
#include "saca/lab/benchmarks/look_up_times.h"
#include "saca/lab/benchmarks/memory_speed.h"
#include "saca/lab/benchmarks/risk_times.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::benchmarks {
namespace {

using nlohmann::json;

Result<json> air3d_on(const GameGrid& size, int repeats, const std::filesystem::path& root,
                      const Clock& clock, const Note& note) {
  const auto reference =
      air3d_reference(root / "data" / "reference" / "air3d_hj_reachability.json", size);
  return reference.has_value() ? air3d_times(size, reference.value(), repeats, clock, note)
                               : reference;
}

/// Of the parked car: its solution, and what is looked up in it.
Result<json> parked_car_times(const std::filesystem::path& root, const Clock& clock,
                              const Note& note) {
  const auto parked = parked_car_with_more_points(root / "data" / "reach" / "parked_car.toml");
  if (!parked.has_value()) {
    return parked.error();
  }
  const auto solved = avoidance_times(parked.value(), clock, note);
  if (!solved.has_value()) {
    return solved.error();
  }
  json figures = solved.value().figures;
  note("the memory's speed");
  figures.update(roofline(memory_speed(usual_threads(), clock),
                          figures.at("reach.avoid4d.ns_per_point_stage").get<double>()));
  note("look-ups");
  figures.update(look_up_times(solved.value().solved, clock));
  return figures;
}

}  // namespace

Result<json> coarse_air3d_times(const std::filesystem::path& root, const Clock& clock,
                                const Note& note) {
  return air3d_on(coarse_game, 2, root, clock, note);
}

Result<json> reach_times(const std::filesystem::path& root, const manoeuvre::Car& car,
                         const Clock& clock, const Note& note) {
  auto parked = parked_car_times(root, clock, note);
  if (!parked.has_value()) {
    return parked.error();
  }
  json figures = std::move(parked).value();
  const world::Footprint other{.length = 4.5, .width = 1.8};
  const auto model = model_of_two_tables(car, other, note);
  if (!model.has_value()) {
    return model.error();
  }
  figures.update(
      risk_times(model.value(), {.ego = manoeuvre::footprint(car), .other = other}, clock, note));
  const auto coarse = coarse_air3d_times(root, clock, note);
  if (!coarse.has_value()) {
    return coarse.error();
  }
  figures.update(coarse.value());
  const auto fine = air3d_on(fine_game, 1, root, clock, note);
  if (!fine.has_value()) {
    return fine.error();
  }
  figures.update(fine.value());
  return figures;
}

}  // namespace saca::benchmarks
