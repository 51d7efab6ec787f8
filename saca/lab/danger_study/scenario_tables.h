#pragma once

#include <map>
#include <string>
#include <vector>

#include "saca/lab/installation/installation.h"
#include "saca/lab/reach_study/danger_tables.h"
#include "saca/lab/reach_study/needed_tables.h"

namespace saca::danger_study {

/// What scenarios need, and of each car's tables where they are kept.
struct ScenarioTables {
  reach_study::NeededTables needed;
  std::map<std::string, reach_study::TableStore> stores;  ///< by the cars' names
};

/// @param scenarios  files, or names of shipped ones; empty: all that are shipped
[[nodiscard]] Result<ScenarioTables> tables_of(const installation::Installation& here,
                                               const std::vector<std::string>& scenarios);

}  // namespace saca::danger_study
