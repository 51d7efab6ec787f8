#include "saca/lab/family_samples/counted_law_text.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

namespace saca::family_samples {

using world::num_cue_kinds;

std::string counted_law_text(const intent::CueLaw& law, const eval::CueCounts& counts,
                             std::string_view suite) {
  const eval::CueCount all = eval::all_who_may_come(counts, law);
  intent::CueLaw counted = eval::counted_law(law, counts);
  std::array<std::string, num_cue_kinds> sources;
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    const eval::CueCount& one = counts.at(k);
    if (auto& unseen = counted.unseen.at(k)) {
      constexpr double fine = 1e4;  // more digits than a count of thousands has
      unseen->probability = std::ceil(fine * unseen->probability) / fine;
      sources.at(k) = one.there > 0
                          ? fmt::format("counted: {} of {} encounters of suite {}, tuning split",
                                        one.came, one.there, suite)
                          : fmt::format("assumption: as all who were counted together, {} of {}",
                                        all.came, all.there);
    }
  }
  return "# What cues of a scene stand for, as SACA reckons with it. Written by `saca cues -o`: "
         "who "
         "comes and how\n"
         "# is an assumption (scenarios/families/cues.toml), how often was counted.\n" +
         intent::cue_law_text(counted, sources);
}

}  // namespace saca::family_samples
