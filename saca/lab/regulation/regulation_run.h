#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/eval/imitator.h"
#include "saca/lab/eval/regulation.h"
#include "saca/lab/eval/suite.h"
#include "saca/lab/long_work/progress.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/intent/model.h"

namespace saca::regulation {

// How cars and methods do in the tests of a regulation (`saca suite fmvss127`, `saca suite r152`).

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
  std::vector<RegulationRun> elsewhere;   ///< "aeb" on each further surface, if it is a method

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

/// Whether a method threw in any test of the run's own surface.
[[nodiscard]] bool has_faults(const RegulationRun& run);

/// Index of a method; nullopt: it was not run.
[[nodiscard]] std::optional<std::size_t> index_of(const RegulationRun& run,
                                                  const std::string& method);

/// Only these rows, in this order; all where none is named.
/// @return  Error::Code::out_of_range where one is not there, with the name that was likely meant
[[nodiscard]] Result<eval::Regulation> with_rows(eval::Regulation regulation,
                                                 const std::vector<std::string>& names);

/// The tests before any is played: as many cells with each car, and results without meaning yet.
/// @param methods  names of eval::methods(), in the order of tables
[[nodiscard]] RegulationRun tests_of(eval::Regulation regulation, std::vector<std::string> cars,
                                     std::vector<std::string> methods);

/// A car that is tested, and what methods are run with in it. What it points to outlives the run.
struct TestedCar {
  const manoeuvre::Car* car = nullptr;
  const runtime::PlanesSetup* setup = nullptr;
  const intent::Model* intent = nullptr;
};

/// How the tests are played.
struct PlayOptions {
  std::shared_ptr<const eval::Imitators> imitators;  ///< those that methods need; may be empty
  int threads = 1;                                   ///< they do not change the results
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// Plays all cells with all cars and methods, and where "aeb" is among these with it on each
/// further surface, with progress on the error stream.
/// @param cars  as `run` names them
/// @return      nullopt: interrupted
[[nodiscard]] std::optional<RegulationRun> played(RegulationRun run,
                                                  std::span<const TestedCar> cars,
                                                  const PlayOptions& options);

}  // namespace saca::regulation
