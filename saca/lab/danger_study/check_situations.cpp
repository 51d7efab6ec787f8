#include "saca/lab/danger_study/check_situations.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iterator>

#include "saca/lab/danger_study/numbered_situations.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/onboard/manoeuvre/ego.h"

namespace saca::danger_study {

using learned_danger::CheckedCase;

Result<std::vector<CheckedCase>> checked_situations(const manoeuvre::Car& car,
                                                    const learned_danger::Network& network,
                                                    const SituationsTask& task) {
  constexpr int situations_at_once = 200;
  const NumberedSituations drawn{"check", task.seed, task.threads};
  const world::Footprint body = manoeuvre::footprint(car);
  SteadyClock clock;
  long_work::ProgressLine line("danger check", task.situations, clock, task.display);
  std::vector<CheckedCase> all;
  while (std::ssize(all) < task.situations) {
    const int done = static_cast<int>(all.size());
    const auto more = worked_out<CheckedCase>(
        drawn, done, std::min(situations_at_once, task.situations - done),
        [&](std::uint64_t seed) { return learned_danger::checked(car, body, network, seed); });
    all.insert(all.end(), more.begin(), more.end());
    line.show(static_cast<int>(all.size()), 0, " situations");
    if (long_work::interrupted()) {
      return Error{Error::Code::too_late,
                   "interrupted; nothing was kept: the same command begins anew"};
    }
  }
  return all;
}

double microseconds_of_value(const learned_danger::Network& network, const Clock& clock) {
  constexpr std::size_t count = learned_danger::Network::at_once;
  constexpr int times = 2'000;
  const std::vector<learned_danger::SeenByNet> seen(count);
  std::vector<double> v(count);
  const auto start = clock.now();
  for (int i = 0; i < times; ++i) {
    network.values(seen, v);
  }
  const std::chrono::duration<double, std::micro> taken = clock.now() - start;
  return taken.count() / (times * static_cast<double>(count));
}

}  // namespace saca::danger_study
