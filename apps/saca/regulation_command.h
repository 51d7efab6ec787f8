#pragma once

#include <filesystem>
#include <string>

#include "apps/saca/places.h"
#include "saca/base/core/parallel.h"

namespace saca::app {

/// How the tests of a regulation are run.
struct RegulationOptions {
  std::string name;  ///< of a file of data/protocols
  std::string methods = "saca,aeb,rss,beliefs_rolled_out";
  std::string cars = "compact_rwd_ev,small_fwd_car,midsize_suv,delivery_van";
  std::string rows;    ///< names of its rows, separated by commas; empty: all
  std::string output;  ///< the page; empty: runs/suite-NAME.html
  int threads = usual_threads();
  bool as_json = false;
};

/// Where the file of a regulation would be.
[[nodiscard]] std::filesystem::path regulation_path(const Places& places, const std::string& name);

/// `saca suite REGULATION`: runs its tests, prints what each method passes, leaves page and
/// figures.
/// @return  exit code
[[nodiscard]] int run_regulation(RegulationOptions options);

}  // namespace saca::app
