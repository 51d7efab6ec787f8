#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/places.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/imitator.h"
#include "saca/lab/eval/regulation_file.h"

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

/// What one method did in one cell with one car.
struct RegulationResult {
  eval::CellResult judged;
  std::optional<manoeuvre::Plan> plan;  ///< with what it first intervened
  std::optional<double> acted_at;       ///< [s]
  std::string fault;                    ///< why it failed, or the cell could not be played
};

struct RegulationRun {
  eval::Regulation regulation;
  std::vector<eval::RegulationCell> cells;
  std::vector<std::string> cars;
  std::vector<std::string> methods;
  std::vector<RegulationResult> results;  ///< by car, cell and method, the last running fastest
  nlohmann::json meta;                    ///< "meta.command" and so on
  std::shared_ptr<const eval::Imitators> imitators;  ///< those that methods need
  std::vector<RegulationRun> elsewhere;  ///< "aeb" on each further surface, if it is a method

  [[nodiscard]] const RegulationResult& at(std::size_t car, std::size_t cell,
                                           std::size_t method) const {
    return results[(car * cells.size() + cell) * methods.size() + method];
  }
  [[nodiscard]] const eval::RegulationRow& row_of(std::size_t cell) const {
    return regulation.rows[cells[cell].row];
  }
};

/// Which tests are counted; what is not given is all.
struct TestSelection {
  std::size_t method = 0;
  std::optional<std::size_t> car;
  std::optional<std::size_t> row;
  std::optional<bool> manual_braking;  ///< the text lets the driver brake too
};

/// How many of them were passed.
struct PassCount {
  int passed = 0;
  int all = 0;
  int faults = 0;
  double worst = 0.0;  ///< largest impact speed of those that were failed [m/s]

  [[nodiscard]] int failed() const { return all - passed; }
};
[[nodiscard]] PassCount passed_by(const RegulationRun& run, const TestSelection& chosen);

/// Where the file of a regulation would be.
[[nodiscard]] std::filesystem::path regulation_path(const Places& places, const std::string& name);

/// Index of a method; nullopt: it was not run.
[[nodiscard]] std::optional<std::size_t> index_of(const RegulationRun& run,
                                                  const std::string& method);

/// Runs all cells with all cars and methods, with progress on the error stream.
/// @param methods  names of eval::methods(), in the order of tables
/// @return         nullopt: interrupted
[[nodiscard]] Result<std::optional<RegulationRun>> run_cells(
    const RegulationOptions& options, const std::vector<std::string>& methods);

}  // namespace saca::app
