#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "saca/base/core/result.h"
#include "saca/lab/long_work/progress.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::vehicle_study {

/// How the laws of a car's controllers are made good at their trials (saca/lab/tune/trials.h).
struct TuningWork {
  std::string program;           ///< with its version; a journal of another one is refused
  std::string car;               ///< as it was named; likewise
  int swerve_evaluations = 0;    ///< at most, > 0
  int drift_evaluations = 0;     ///< at most, > 0
  unsigned long seed = 1;        ///< same seed, same tuning
  int threads = 1;               ///< they do not change it
  std::filesystem::path output;  ///< the tuning's file to be; journals stand beside it
  long_work::ProgressDisplay display = long_work::ProgressDisplay::shown;
};

/// What the laws cost at the end.
struct LawCosts {
  double swerve = 0.0;
  double drift = 0.0;
};

/// Finds the numbers of both laws, the lane change's first, and puts them into the car. Progress on
/// the error stream; the same call goes on where an interrupted one stopped.
/// @return  nullopt: interrupted. Errors are those of tune::minimise.
[[nodiscard]] Result<std::optional<LawCosts>> tune_laws(const TuningWork& work,
                                                        manoeuvre::Car& car);

/// tune_laws, and then the domain of the T-drift with them: where it ends as it should.
/// @param draws  of what the controllers do not know, at each speed and grip, > 0
/// @return       likewise
[[nodiscard]] Result<std::optional<LawCosts>> tune_car(const TuningWork& work, int draws,
                                                       manoeuvre::Car& car);

/// Once the tuning is written, its journals are of no use any more.
void remove_journals(const TuningWork& work);

/// The car with a tuning to begin with.
/// @param tuning_file  may be another car's
/// @return  Error::Code::unreadable, malformed, naming the file
[[nodiscard]] Result<manoeuvre::Car> read_start(const std::filesystem::path& car_file,
                                                const std::filesystem::path& tuning_file);

}  // namespace saca::vehicle_study
