#include "saca/lab/reach_study/named_problem.h"

#include "saca/lab/installation/shipped_files.h"
#include "saca/thinking/danger/avoidance_case.h"

namespace saca::reach_study {

Result<levelset::Problem> named_problem(const installation::Installation& here,
                                        const std::string& name) {
  if (name == "air3d") {
    return levelset::air3d_problem(levelset::air3d_grid(101, 79, 100));
  }
  const auto file = installation::find_reach_case(here, name);
  if (!file.has_value()) {
    return Error{file.error().code, file.error().message + ", or air3d"};
  }
  const auto found = danger::read_avoidance_case(file.value());
  return found.has_value() ? levelset::avoidance_problem(found.value())
                           : Result<levelset::Problem>(found.error());
}

}  // namespace saca::reach_study
