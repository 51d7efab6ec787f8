#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/parallel.h"
#include "saca/lab/installation/installation.h"
#include "saca/lab/regulation/regulation_run.h"

namespace saca::regulation {

/// Which tests of a regulation are run, and with what.
struct RegulationRequest {
  std::string name;  ///< of a file of data/protocols
  std::string methods = "saca,aeb,rss,beliefs_rolled_out";
  std::string cars = "compact_rwd_ev,small_fwd_car,midsize_suv,delivery_van";
  std::string rows;  ///< names of its rows, separated by commas; empty: all
  int threads = usual_threads();
};

/// Opens what the request names and plays it, with progress on the error stream.
/// @param methods  names of eval::methods(), in the order of tables: those of the request
/// @return         nullopt: interrupted
[[nodiscard]] Result<std::optional<RegulationRun>> run_regulation(
    const installation::Installation& here, const RegulationRequest& request,
    const std::vector<std::string>& methods);

}  // namespace saca::regulation
