#include "saca/lab/danger_study/beside_exact.h"

#include <array>
#include <filesystem>

#include "saca/lab/learned_danger/net_inputs.h"
#include "saca/lab/report/beside_exact.h"
#include "saca/lab/report/value_map.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::danger_study {

Result<std::string> beside_exact_png(const learned_danger::Network& network,
                                     const learned_danger::ExactPointMass& exact,
                                     const BesideExactRequest& request) {
  const auto learnt = [&](const danger::State& at) {
    const std::array<learned_danger::SeenByNet, 1> seen{
        learned_danger::seen_by_net(exact.problem, at)};
    return danger::LookupResult{network.joint_value(seen), 0.0, true};
  };
  return report::beside_exact_png(
      {.exact_name = report::problem_name(exact.text).value_or(request.table),
       .other_name = std::filesystem::path(request.weights).filename().string(),
       .outline = report::obstacle_outline(exact.text),
       .speeds = request.speeds,
       .course = request.course},
      exact.value(), learnt);
}

}  // namespace saca::danger_study
