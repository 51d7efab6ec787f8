#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/reach_study/danger_tables.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::reach_study {

/// The tables that the scenario's actors need beside this car.
/// @return  an error naming the car where it is beyond what a table may hold
[[nodiscard]] Result<std::vector<danger::DangerCase>> tables_for(
    const prepare::NamedCar& car, const scenario::Scenario& scenario);

/// The tables that several scenarios need, each once for each car.
class NeededTables {
 public:
  /// @return  likewise
  [[nodiscard]] std::optional<Error> add(const prepare::NamedCar& car,
                                         const scenario::Scenario& scenario);

  /// By their names.
  using Tables = std::map<std::string, danger::DangerCase>;
  /// By the cars' names.
  [[nodiscard]] const std::map<std::string, Tables>& by_car() const { return cars_; }

 private:
  std::map<std::string, Tables> cars_;
};

/// A table that is ready, for people.
[[nodiscard]] std::string table_line(const std::string& car, const std::string& table,
                                     const ReadyTable& ready);

/// Likewise for programs (docs/formats.md).
[[nodiscard]] nlohmann::json table_json(const std::string& car, const std::string& table,
                                        const ReadyTable& ready);

}  // namespace saca::reach_study
