#include "saca/lab/benchmarks/chosen_times.h"

#include <algorithm>
#include <string_view>

#include "saca/lab/benchmarks/atlas_times.h"
#include "saca/lab/benchmarks/decision_times.h"
#include "saca/lab/benchmarks/reach_times.h"
#include "saca/lab/benchmarks/vehicle_times.h"
#include "saca/lab/installation/inputs.h"
#include "saca/lab/vehicle_study/kept_atlas.h"

namespace saca::benchmarks {

Result<nlohmann::json> chosen_times(const installation::Installation& here,
                                    const TimesRequest& request, const Clock& clock,
                                    const std::function<void(const std::string& what)>& note) {
  const auto read = installation::read_inputs(here, "compact_rwd_ev");
  if (!read.has_value()) {
    return read.error();
  }
  const installation::Inputs& inputs = read.value();
  nlohmann::json figures = nlohmann::json::object();
  const auto asked = [&](std::string_view what) {
    return request.what == "all" || request.what == what;
  };
  if (asked("vehicle")) {
    figures.update(vehicle_times(inputs.car, clock));
  }
  if (asked("reach") || asked("air3d")) {
    const auto times = asked("reach") ? reach_times(here.root, inputs.car, clock, note)
                                      : coarse_air3d_times(here.root, clock, note);
    if (!times.has_value()) {
      return times.error();
    }
    figures.update(times.value());
  }
  if (asked("decide") || asked("atlas")) {
    const atlas::Atlas atlas = vehicle_study::usual_atlas(here, inputs);
    if (asked("decide")) {
      figures.update(decision_times({&inputs.car, &inputs.harm, &inputs.intent, &atlas}, clock,
                                    request.calls));
    }
    if (asked("atlas")) {
      figures.update(
          atlas_times(inputs.car, atlas, inputs.harm, clock, std::min(request.calls, 10'000)));
    }
  }
  return figures;
}

}  // namespace saca::benchmarks
