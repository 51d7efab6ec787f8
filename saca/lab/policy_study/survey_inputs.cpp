#include "saca/lab/policy_study/survey_inputs.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/lab/prepare/car_file.h"

namespace saca::policy_study {

namespace fs = std::filesystem;

std::optional<Error> add_survey_inputs(const fs::path& root, const fs::path& car_file, Fnv& hash) {
  std::vector<fs::path> files{car_file,
                              prepare::tuning_path(car_file),
                              "/proc/self/exe",
                              root / "data" / "cues.toml",
                              root / "data" / "harm.toml",
                              root / "data" / "thinking_costs.toml",
                              root / "scenarios" / "splits.toml"};
  for (const auto& entry : fs::directory_iterator(root / "scenarios" / "families")) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    if (auto problem = read_file(file, [&](std::string_view bytes) { hash.add(bytes); })) {
      return problem;
    }
  }
  return std::nullopt;
}

}  // namespace saca::policy_study
