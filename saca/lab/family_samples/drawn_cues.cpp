#include "saca/lab/family_samples/drawn_cues.h"

#include <cstdint>

namespace saca::family_samples {

using eval::DrawnCues;

Result<std::vector<DrawnCues>> drawn_cues(const eval::SuiteSource& source, const std::string& suite,
                                          int count) {
  std::vector<DrawnCues> all;
  for (int k = 0; k < count; ++k) {
    const auto sample = source.sample(static_cast<std::uint64_t>(k));
    if (!sample.has_value()) {
      return sample.error();
    }
    all.push_back(sample.value().cues);
  }
  if (all.front().empty()) {
    return Error{Error::Code::out_of_range, suite + ": want a suite with cues, got one without"};
  }
  return all;
}

}  // namespace saca::family_samples
